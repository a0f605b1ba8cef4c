// Memory touched ahead: as much as was asked for, no more once there is better to do, and at hand for whoever comes next.
#include "core/warm_memory.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <vector>

// As jemalloc has it; no symbol where a sanitizer brings its own allocator.
extern "C" int mallctl(const char* name, void* old_value, std::size_t* old_bytes, void* new_value, std::size_t new_bytes) __attribute__((weak));

namespace relievo {
namespace {

constexpr std::size_t mega = std::size_t{1} << 20;
const auto always = [] { return true; };

TEST(WarmMemory, HoldsAsMuchAsItIsTold) {
    EXPECT_EQ(WarmMemory(0, always).bytes(), 0u);
    EXPECT_EQ(WarmMemory(1, always).bytes(), 2 * mega);
    WarmMemory warm(7 * mega, always);
    EXPECT_EQ(warm.bytes(), 8 * mega);
    warm.hand_over();
    EXPECT_EQ(warm.bytes(), 0u);
}

TEST(WarmMemory, StopsWhenThereIsBetterToDo) {
    int left = 3;
    EXPECT_EQ(WarmMemory(100 * mega, [&] { return left-- > 0; }).bytes(), 6 * mega);
    EXPECT_EQ(WarmMemory(100 * mega, [] { return false; }).bytes(), 0u);
}

std::size_t statistic(const char* name) {
    std::uint64_t epoch = 1;
    std::size_t value = 0, size = sizeof value, epoch_size = sizeof epoch;
    mallctl("epoch", &epoch, &epoch_size, &epoch, sizeof epoch);
    EXPECT_EQ(mallctl(name, &value, &size, nullptr, 0), 0) << name;
    return value;
}
std::size_t kept_bytes() { return statistic("stats.arenas.0.pdirty") * statistic("arenas.page"); }

TEST(WarmMemory, ServesRequestsOfAnySizeWhileItLives) {
    if (!mallctl) GTEST_SKIP() << "built with sanitizers, which bring their own allocator";
    if (std::getenv("MALLOC_CONF")) GTEST_SKIP() << "MALLOC_CONF is set and says otherwise";
    if (mallctl("arena.0.oversize_threshold", nullptr, nullptr, nullptr, 0) != 0) GTEST_SKIP() << "this jemalloc gives back what is larger than 8 MiB whatever it is told";
    constexpr std::size_t bytes = 64 * mega;
    const auto filled = [](std::size_t piece) {
        std::vector<std::vector<char>> pieces;
        for (std::size_t done = 0; done + piece <= bytes; done += piece) pieces.emplace_back(piece, 1);
        return pieces;
    };
    {
        WarmMemory warm(bytes, always);
        warm.hand_over();
        EXPECT_GE(kept_bytes(), bytes / 10 * 9);
        for (const std::size_t piece : {bytes / 32, bytes / 200, bytes / 1000}) {
            const std::size_t before = statistic("stats.mapped");
            const auto pieces = filled(piece);
            EXPECT_LE(statistic("stats.mapped"), before + bytes / 2) << piece << " bytes a piece";
        }
    }
    // Afterwards large pieces go back at once.
    mallctl("arena.0.purge", nullptr, nullptr, nullptr, 0);
    filled(bytes / 32);
    EXPECT_LE(kept_bytes(), bytes / 10 * 7);
}

}  // namespace
}  // namespace relievo
