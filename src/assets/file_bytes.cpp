#include "assets/file_bytes.h"

#include "core/error.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <string>
#include <utility>

namespace relievo {

namespace {

struct Free {
    void operator()(void* memory) const { std::free(memory); }
};
using Buffer = std::unique_ptr<char, Free>;

void grow(Buffer& buffer, std::size_t size) {
    void* larger = std::realloc(buffer.get(), size);
    if (!larger) throw std::bad_alloc();
    static_cast<void>(buffer.release());
    buffer.reset(static_cast<char*>(larger));
}

// All members of a gzip file (RFC 1952), one after the other.
std::pair<Buffer, std::size_t> inflate_all(std::string_view packed, const std::string& file, std::uint64_t max_bytes) {
    z_stream stream{};
    if (inflateInit2(&stream, 15 + 16) != Z_OK) throw std::bad_alloc();  // 16: gzip header and checksum
    struct End {
        z_stream* stream;
        ~End() { inflateEnd(stream); }
    } const end{&stream};

    // The last four bytes promise the size modulo 2^32. They are a hint and nothing more: no block holds more than deflate can.
    std::uint32_t promised = 0;
    if (packed.size() >= 18) std::memcpy(&promised, packed.data() + packed.size() - 4, 4);
    std::size_t capacity = std::min<std::uint64_t>({promised + std::uint64_t{64}, packed.size() * std::uint64_t{1032} + 64, max_bytes + 1});
    Buffer buffer;
    grow(buffer, capacity);
    std::size_t size = 0, read = 0;
    for (;;) {
        if (size == capacity) {
            if (size > max_bytes)
                throw Error("read", file, "byte " + std::to_string(read) + ": it inflates to more than " + std::to_string(max_bytes >> 20) + " MiB", "decompress it yourself if you trust it");
            capacity = static_cast<std::size_t>(std::min<std::uint64_t>(capacity + capacity / 2 + 4096, max_bytes + 1));
            grow(buffer, capacity);
        }
        // zlib counts in 32 bits.
        const auto in = static_cast<uInt>(std::min<std::size_t>(packed.size() - read, 1u << 30));
        const auto out = static_cast<uInt>(std::min<std::size_t>(capacity - size, 1u << 30));
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + read));
        stream.avail_in = in;
        stream.next_out = reinterpret_cast<Bytef*>(buffer.get() + size);
        stream.avail_out = out;
        const int result = ::inflate(&stream, Z_NO_FLUSH);
        read += in - stream.avail_in;
        size += out - stream.avail_out;
        if (result == Z_STREAM_END) {
            if (!is_gzip(packed.substr(read))) break;  // what follows, padding say, is no member
            inflateReset(&stream);
            continue;
        }
        if (result == Z_OK && (stream.avail_out == 0 || read < packed.size())) continue;
        if (result == Z_OK || result == Z_BUF_ERROR) {
            if (size == capacity) continue;
            throw Error("read", file, "the compressed data ends at byte " + std::to_string(read) + ", before its end mark", "copy the file again");
        }
        throw Error("read", file, "the compressed data is damaged near byte " + std::to_string(read) + (stream.msg ? std::string(" (") + stream.msg + ")" : ""),
                    "copy the file again");
    }
    if (size > max_bytes)
        throw Error("read", file, "byte " + std::to_string(read) + ": it inflates to more than " + std::to_string(max_bytes >> 20) + " MiB", "decompress it yourself if you trust it");
    if (size == 0) throw Error("read", file, "byte " + std::to_string(read) + ", its end: it is compressed and holds nothing");
    return {std::move(buffer), size};
}

}  // namespace

bool is_gzip(std::string_view bytes) { return bytes.size() >= 18 && bytes.substr(0, 3) == "\x1f\x8b\x08"; }

std::string gzip(std::string_view bytes) {
    z_stream stream{};
    // Level 6 is zlib's compromise; 16: gzip header and checksum; 8: its usual memory.
    if (deflateInit2(&stream, 6, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK) throw std::bad_alloc();
    std::string packed(deflateBound(&stream, static_cast<uLong>(bytes.size())), '\0');
    std::size_t read = 0, size = 0;
    for (int result = Z_OK; result != Z_STREAM_END;) {
        // zlib counts in 32 bits.
        const auto in = static_cast<uInt>(std::min<std::size_t>(bytes.size() - read, 1u << 30));
        const auto out = static_cast<uInt>(std::min<std::size_t>(packed.size() - size, 1u << 30));
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + read));
        stream.avail_in = in;
        stream.next_out = reinterpret_cast<Bytef*>(packed.data() + size);
        stream.avail_out = out;
        result = ::deflate(&stream, read + in == bytes.size() ? Z_FINISH : Z_NO_FLUSH);
        read += in - stream.avail_in;
        size += out - stream.avail_out;
    }
    deflateEnd(&stream);
    packed.resize(size);
    return packed;
}

FileBytes FileBytes::open(const std::filesystem::path& file, std::uint64_t max_bytes) {
    const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);  // a pipe would keep us waiting
    if (descriptor < 0) throw Error("read", file.string(), std::strerror(errno));
    struct Close {
        int descriptor;
        ~Close() { ::close(descriptor); }
    } const close{descriptor};
    struct stat status {};
    if (::fstat(descriptor, &status) != 0) throw Error("read", file.string(), std::strerror(errno));
    if (S_ISDIR(status.st_mode)) throw Error("read", file.string(), "it is a folder", "name a file");
    if (!S_ISREG(status.st_mode)) throw Error("read", file.string(), "it is not a plain file", "save it to a file first");
    if (status.st_size == 0) throw Error("read", file.string(), "byte 0: the file is empty");

    FileBytes bytes;
    void* const mapped = ::mmap(nullptr, static_cast<std::size_t>(status.st_size), PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (mapped == MAP_FAILED) throw Error("read", file.string(), std::strerror(errno));
    bytes.data_ = static_cast<char*>(mapped);
    bytes.size_ = static_cast<std::size_t>(status.st_size);
    bytes.mapped_ = true;
    if (!is_gzip(bytes.view())) return bytes;

    return inflate(bytes.view(), file.string(), max_bytes);
}

FileBytes FileBytes::inflate(std::string_view packed, const std::string& file, std::uint64_t max_bytes) {
    auto [buffer, size] = inflate_all(packed, file, max_bytes);
    FileBytes plain;
    plain.data_ = buffer.release();
    plain.size_ = size;
    return plain;
}

FileBytes::FileBytes(FileBytes&& other) noexcept
    : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)), mapped_(other.mapped_) {}

void FileBytes::forget(std::string_view part) const {
    if (!mapped_) return;
    static const auto page = static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
    const auto begin = static_cast<std::size_t>(part.data() - data_);
    const std::size_t first = (begin + page - 1) / page * page, last = (begin + part.size()) / page * page;
    if (first < last) ::madvise(data_ + first, last - first, MADV_DONTNEED);
}

FileBytes::~FileBytes() {
    if (!data_) return;
    if (mapped_)
        ::munmap(data_, size_);
    else
        std::free(data_);
}

}  // namespace relievo
