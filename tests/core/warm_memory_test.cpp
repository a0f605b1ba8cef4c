// Memory touched ahead: as much as was asked for, and no more once there is better to do.
#include "core/warm_memory.h"

#include <gtest/gtest.h>

namespace relievo {
namespace {

constexpr std::size_t mega = std::size_t{1} << 20;

TEST(WarmMemory, TouchesAsMuchAsItIsToldInPieces) {
    EXPECT_TRUE(warm_memory(0, [] { return true; }).empty());
    EXPECT_EQ(warm_memory(1, [] { return true; }).size(), 1u);
    const WarmMemory warm = warm_memory(7 * mega, [] { return true; });
    EXPECT_EQ(warm.size(), 4u);  // of two each
    for (const auto& piece : warm)
        for (std::size_t at = 0; at < 2 * mega; at += 4096) EXPECT_TRUE(piece[at] == std::byte{0});
}

TEST(WarmMemory, StopsWhenThereIsBetterToDo) {
    int left = 3;
    EXPECT_EQ(warm_memory(100 * mega, [&] { return left-- > 0; }).size(), 3u);
    EXPECT_TRUE(warm_memory(100 * mega, [] { return false; }).empty());
}

}  // namespace
}  // namespace relievo
