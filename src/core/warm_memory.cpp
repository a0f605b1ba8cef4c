#include "core/warm_memory.h"

namespace relievo {

WarmMemory warm_memory(std::size_t bytes, const std::function<bool()>& idle) {
    constexpr std::size_t piece = std::size_t{2} << 20, page = 4096;
    WarmMemory pieces;
    for (std::size_t warm = 0; warm < bytes && idle(); warm += piece) {
        pieces.push_back(std::make_unique_for_overwrite<volatile std::byte[]>(piece));
        for (std::size_t at = 0; at < piece; at += page) pieces.back()[at] = std::byte{0};
    }
    return pieces;
}

}  // namespace relievo
