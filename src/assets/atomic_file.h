// Files that appear whole or not at all: written under a temporary name in the same folder, then renamed over the target.
#pragma once

#include <filesystem>
#include <string_view>

namespace relievo {

// Owns a temporary file until commit(). Destroyed without it (an error, an interruption), it removes the temporary file and
// leaves whatever stood at the target untouched. The folder must exist.
class AtomicFile {
public:
    // Creates the temporary file, so that an unwritable target is known before the work is done. Throws Error.
    explicit AtomicFile(std::filesystem::path target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    const std::filesystem::path& target() const { return target_; }
    const std::filesystem::path& temporary() const { return temporary_; }  // write here; its ending is not the target's

    // The temporary file becomes the target, replacing a file that stood there. Throws Error.
    void commit();

private:
    std::filesystem::path target_;
    std::filesystem::path temporary_;
    bool committed_ = false;
};

// Writes the bytes of `text` as the whole file. Throws Error.
void write_file_atomically(const std::filesystem::path& target, std::string_view text);

}  // namespace relievo
