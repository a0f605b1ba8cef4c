#include "core/large_pages.h"

#include <sys/mman.h>

#include <cstdint>

namespace relievo {

void prefer_large_pages(void* data, std::size_t bytes) {
    constexpr std::uintptr_t page = 2 << 20;  // of x86-64, and of 64-bit ARM with pages of 4 KiB
    const auto begin = (reinterpret_cast<std::uintptr_t>(data) + page - 1) / page * page;
    const auto end = (reinterpret_cast<std::uintptr_t>(data) + bytes) / page * page;
    if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

}  // namespace relievo
