// The programs' allocator is the one that src/allocator sets up, and large arrays come in large pages.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/resource.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <vector>

// As jemalloc has it; no symbol where a sanitizer brings its own allocator.
extern "C" int mallctl(const char* name, void* old_value, std::size_t* old_bytes, void* new_value, std::size_t new_bytes) __attribute__((weak));

namespace {

const char* option(const char* name) {
    const char* value = nullptr;
    std::size_t bytes = sizeof value;
    return mallctl(name, &value, &bytes, nullptr, 0) == 0 && value ? value : "";
}

long first_touches() {
    rusage used;
    getrusage(RUSAGE_SELF, &used);
    return used.ru_minflt;
}

constexpr std::size_t bytes = std::size_t{64} << 20;  // 16,384 pages of 4 KiB, 32 of 2 MiB

TEST(Allocator, IsToldToAskForLargePages) {
    if (!mallctl) GTEST_SKIP() << "built with sanitizers, which bring their own allocator";
    if (std::getenv("MALLOC_CONF")) GTEST_SKIP() << "MALLOC_CONF is set and says otherwise";
    EXPECT_STREQ(option("opt.thp"), "always");
}

TEST(Allocator, LargeArraysTakeFewFirstTouches) {
    if (!mallctl) GTEST_SKIP() << "built with sanitizers, which bring their own allocator";
    // What the system gives to who asks by hand.
    void* asked = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    ASSERT_NE(asked, MAP_FAILED);
    madvise(asked, bytes, MADV_HUGEPAGE);
    long before = first_touches();
    std::memset(asked, 1, bytes);
    const long by_hand = first_touches() - before;
    munmap(asked, bytes);
    if (by_hand > 2048) GTEST_SKIP() << "this system has no large pages to give: " << by_hand << " first touches";

    before = first_touches();
    const std::vector<char> array(bytes, 1);
    EXPECT_EQ(array[bytes / 2], 1);
    EXPECT_LT(first_touches() - before, 4096);
}

}  // namespace
