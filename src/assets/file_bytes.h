// The bytes of a file as one stretch of memory: mapped where they lie, or inflated if the file is gzip-compressed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace relievo {

// Bytes a compressed file may inflate to. Deflate reaches 1032 : 1, so that a few megabytes could otherwise fill the memory.
inline constexpr std::uint64_t max_inflated_bytes = std::uint64_t{4} << 30;

class FileBytes {
public:
    // Throws Error for what is no plain file, cannot be opened, is empty, or is gzip but damaged, cut short or larger than
    // `max_bytes`. A mapped file must not be truncated by others while it is in use.
    static FileBytes open(const std::filesystem::path& file, std::uint64_t max_bytes = max_inflated_bytes);

    // The same for compressed bytes in memory.
    static FileBytes inflate(std::string_view packed, const std::string& file, std::uint64_t max_bytes = max_inflated_bytes);

    FileBytes(FileBytes&& other) noexcept;
    FileBytes& operator=(FileBytes&&) = delete;
    ~FileBytes();

    std::string_view view() const { return {data_, size_}; }
    bool inflated() const { return !mapped_; }

    // Gives back the memory of a part of view() that will hardly be read again, as far as it is whole pages of a mapped file. Its bytes
    // stay readable: they come from the file again. From any thread.
    void forget(std::string_view part) const;

private:
    FileBytes() = default;

    char* data_ = nullptr;
    std::size_t size_ = 0;
    bool mapped_ = false;
};

bool is_gzip(std::string_view bytes);

// The bytes as a gzip file of one member.
std::string gzip(std::string_view bytes);

}  // namespace relievo
