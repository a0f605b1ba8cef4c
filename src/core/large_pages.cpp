#include "core/large_pages.h"

#include <sys/mman.h>

#include <algorithm>
#include <cstdint>
#include <memory>

namespace relievo {

void prefer_large_pages(void* data, std::size_t bytes) {
    constexpr std::uintptr_t page = 2 << 20;  // of x86-64, and of 64-bit ARM with pages of 4 KiB
    const auto begin = (reinterpret_cast<std::uintptr_t>(data) + page - 1) / page * page;
    const auto end = (reinterpret_cast<std::uintptr_t>(data) + bytes) / page * page;
    if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

void touch_memory(std::size_t bytes, const std::function<bool()>& idle) {
    constexpr std::size_t piece = std::size_t{2} << 20, page = 4096;
    const auto memory = std::make_unique_for_overwrite<volatile std::byte[]>(bytes);
    for (std::size_t from = 0; from < bytes && idle(); from += piece)
        for (std::size_t at = from; at < std::min(from + piece, bytes); at += page) memory[at] = std::byte{0};
}

}  // namespace relievo
