#include "core/warm_memory.h"

// Of jemalloc, where it is.
extern "C" int mallctl(const char* name, void* old_value, std::size_t* old_bytes, void* new_value, std::size_t new_bytes) __attribute__((weak));

namespace relievo {

namespace {

constexpr std::size_t piece_bytes = std::size_t{2} << 20, page_bytes = 4096;

// Larger pieces are given back as soon as they are free. jemalloc before 5.3 cannot be told and goes on as it does.
void keep_pieces_up_to(std::size_t bytes) {
    if (mallctl) mallctl("arena.0.oversize_threshold", nullptr, nullptr, &bytes, sizeof bytes);
}

}  // namespace

WarmMemory::WarmMemory(std::size_t bytes, const std::function<bool()>& idle) {
    keep_pieces_up_to(std::size_t{1} << 40);
    for (std::size_t warm = 0; warm < bytes && idle(); warm += piece_bytes) {
        pieces_.push_back(std::make_unique_for_overwrite<volatile std::byte[]>(piece_bytes));
        for (std::size_t at = 0; at < piece_bytes; at += page_bytes) pieces_.back()[at] = std::byte{0};
    }
}

WarmMemory::~WarmMemory() { keep_pieces_up_to(std::size_t{8} << 20); }  // as it is by itself

std::size_t WarmMemory::bytes() const { return pieces_.size() * piece_bytes; }

void WarmMemory::hand_over() { pieces_.clear(); }

}  // namespace relievo
