#include "assets/atomic_file.h"

#include "core/error.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <string>
#include <system_error>

namespace relievo {

namespace {

std::string advice_for(int error) {
    switch (error) {
        case ENOENT:
            return "create the folder first, or choose another place";
        case EACCES:
        case EPERM:
        case EROFS:
            return "choose a folder you may write to";
        case ENOSPC:
        case EDQUOT:
            return "free some space, or choose another disk";
        default:
            return {};
    }
}

}  // namespace

AtomicFile::AtomicFile(std::filesystem::path target) : target_(std::move(target)) {
    std::error_code ignored;
    const auto status = std::filesystem::status(target_, ignored);
    if (target_.filename().empty() || std::filesystem::is_directory(status))
        throw Error("write", target_.string(), "it names a folder", "name a file");
    // A rename would replace a device or a pipe by a plain file, for everybody.
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        throw Error("write", target_.string(), "it exists and is not a plain file", "name another file");

    static std::atomic<unsigned> counter{0};
    std::filesystem::path folder = target_.parent_path();
    if (folder.empty()) folder = ".";
    for (;;) {
        // Hidden, so that a picture folder under construction lists only finished pictures; the name is kept short because
        // target names may be as long as the file system allows.
        temporary_ = folder / (".relievo-" + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".tmp");
        const int file = ::open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (file >= 0) {
            ::close(file);
            return;
        }
        if (errno == EEXIST) continue;  // left by a killed process that had our number
        throw Error("write", target_.string(), std::strerror(errno), advice_for(errno));
    }
}

AtomicFile::~AtomicFile() {
    std::error_code ignored;
    if (!committed_) std::filesystem::remove(temporary_, ignored);
}

void AtomicFile::commit() {
    std::error_code error;
    std::filesystem::rename(temporary_, target_, error);
    if (error) throw Error("write", target_.string(), error.message(), advice_for(error.value()));
    committed_ = true;
}

void write_file_atomically(const std::filesystem::path& target, std::string_view text) {
    AtomicFile file(target);
    std::FILE* out = std::fopen(file.temporary().c_str(), "wb");
    bool whole = out != nullptr && std::fwrite(text.data(), 1, text.size(), out) == text.size();
    int error = whole ? 0 : errno;
    if (out && std::fclose(out) != 0 && whole) {
        whole = false;  // buffered bytes did not reach the disk
        error = errno;
    }
    if (!whole) throw Error("write", target.string(), std::strerror(error), advice_for(error));
    file.commit();
}

}  // namespace relievo
