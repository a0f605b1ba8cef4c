#include "core/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <sched.h>
#include <thread>
#include <vector>

namespace relievo {

int default_threads() {
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    if (sched_getaffinity(0, sizeof allowed, &allowed) == 0) return std::max(1, CPU_COUNT(&allowed));
    return std::max(1u, std::thread::hardware_concurrency());
}

void parallel_for(int count, int grain, int threads, const std::function<void(int, int)>& body,
                  const Progress& progress, std::string_view stage) {
    if (count <= 0) return;
    grain = std::max(1, grain);
    const int blocks = (count + grain - 1) / grain;
    threads = std::min(threads > 0 ? threads : default_threads(), blocks);

    std::atomic<int> next{0};
    std::atomic<int> done{0};
    std::atomic<bool> stop{false};
    std::exception_ptr failure;
    std::mutex failure_lock;

    const auto work = [&](bool reports) {
        try {
            for (int block = next++; block < blocks && !stop; block = next++) {
                body(block * grain, std::min(count, (block + 1) * grain));
                ++done;
                if (reports) report(progress, stage, static_cast<double>(done) / blocks);
            }
        } catch (...) {
            const std::lock_guard lock(failure_lock);
            if (!failure) failure = std::current_exception();
            stop = true;
        }
    };

    std::vector<std::jthread> helpers;
    for (int t = 1; t < threads; ++t) helpers.emplace_back(work, false);
    work(true);
    helpers.clear();
    if (failure) std::rethrow_exception(failure);
    report(progress, stage, 1.0);
}

}  // namespace relievo
