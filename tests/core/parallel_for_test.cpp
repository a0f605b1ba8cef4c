// Loops on several threads: every index once, whoever calls from wherever, and what goes wrong in one comes back from it.
#include "core/parallel_for.h"

#include "core/progress.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <fstream>
#include <future>
#include <mutex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace relievo {
namespace {

// How often each index of a loop was visited.
std::vector<int> visits(int count, int grain, int threads) {
    std::vector<std::atomic<int>> seen(static_cast<std::size_t>(count));
    parallel_for(count, grain, threads, [&](int begin, int end) {
        EXPECT_LE(end - begin, grain);
        for (int i = begin; i < end; ++i) ++seen[static_cast<std::size_t>(i)];
    });
    return {seen.begin(), seen.end()};
}

TEST(ParallelFor, VisitsEveryIndexOnce) {
    for (const int threads : {0, 1, 2, 3, 8, 33})
        for (const int count : {0, 1, 7, 1000})
            for (const int grain : {1, 3, 1000}) EXPECT_EQ(visits(count, grain, threads), std::vector<int>(static_cast<std::size_t>(count), 1)) << threads << ' ' << count << ' ' << grain;
}

int threads_of_process() {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("Threads:")) return std::stoi(line.substr(8));
    return 0;
}

TEST(ParallelFor, UsesAsManyThreadsAsItIsToldAndKeepsThem) {
    const auto used = [](int threads) {
        std::mutex lock;
        std::set<std::thread::id> ids;
        std::atomic<int> inside{0};
        parallel_for(threads, 1, threads, [&](int, int) {
            // Nobody leaves before all are there, for ten seconds at most.
            ++inside;
            for (const auto start = std::chrono::steady_clock::now(); inside < threads && std::chrono::steady_clock::now() - start < std::chrono::seconds(10);) std::this_thread::yield();
            const std::lock_guard guard(lock);
            ids.insert(std::this_thread::get_id());
        });
        EXPECT_TRUE(ids.contains(std::this_thread::get_id()));
        return ids.size();
    };
    EXPECT_EQ(used(40), 40u);
    const int threads = threads_of_process();
    EXPECT_GE(threads, 40);  // sanitizers have threads of their own
    for (int round = 0; round < 10; ++round) EXPECT_EQ(used(4), 4u);
    EXPECT_EQ(threads_of_process(), threads);
}

TEST(ParallelFor, LoopsInLoopsAndOnOtherThreadsComeToAnEnd) {
    std::atomic<int> sum{0};
    const auto nested = [&] {
        parallel_for(8, 1, 4, [&](int, int) {
            parallel_for(8, 1, 4, [&](int, int) { parallel_for(8, 1, 4, [&](int begin, int end) { sum += end - begin; }); });
        });
    };
    std::vector<std::future<void>> callers;
    for (int k = 0; k < 6; ++k) callers.push_back(std::async(std::launch::async, nested));
    for (std::future<void>& c : callers) c.get();
    EXPECT_EQ(sum, 6 * 8 * 8 * 8);
}

TEST(ParallelFor, BringsBackWhatWasThrownAndGoesOn) {
    for (int round = 0; round < 20; ++round) {
        EXPECT_THROW(parallel_for(100, 1, 4, [](int begin, int) { if (begin == 37) throw std::runtime_error("a body"); }), std::runtime_error);
        EXPECT_THROW(parallel_for(100, 1, 4, [](int, int) {}, [](std::string_view, double) { throw std::logic_error("cancelled"); }, "stage"), std::logic_error);
        EXPECT_EQ(visits(50, 1, 4), std::vector<int>(50, 1));
    }
}

TEST(ParallelFor, WorksInAProcessThatWasForked) {
    EXPECT_EQ(visits(50, 1, 4), std::vector<int>(50, 1));
    const pid_t child = ::fork();
    // Its helpers stayed behind.
    if (child == 0) ::_exit(visits(50, 1, 4) == std::vector<int>(50, 1) ? 0 : 1);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

}  // namespace
}  // namespace relievo
