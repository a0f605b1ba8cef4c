#include "core/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <pthread.h>
#include <sched.h>
#include <system_error>
#include <thread>
#include <vector>

namespace relievo {

namespace {

// Threads that stay, because starting one takes as long as many a loop: docs/measured.md has figures.
class Helpers {
public:
    // Runs work() on the calling thread and on up to `count` others, as many as are free before the caller is done: the caller never waits for one that has not begun.
    // Callers on several threads, and in the work of others, share the helpers.
    template <class Work>
    void run(int count, const Work& work) {
        const std::function<void()> helped = [&] { work(false); };
        Job job{.work = &helped, .wanted = count};
        const auto place = offer(job);
        work(true);
        std::unique_lock lock(lock_);
        jobs_.erase(place);
        done_.wait(lock, [&] { return job.busy == 0; });
    }

private:
    struct Job {
        const std::function<void()>* work;
        int wanted = 0, busy = 0;
    };
    std::mutex lock_;
    std::condition_variable offered_, done_;
    std::list<Job*> jobs_;
    std::vector<std::thread> threads_;

    std::list<Job*>::iterator offer(Job& job) {
        const std::lock_guard lock(lock_);
        try {
            while (static_cast<int>(threads_.size()) < job.wanted) threads_.emplace_back([this] { serve(); });
        } catch (const std::system_error&) {
            // The system gives no more threads: those that are there do.
        }
        for (int k = 0; k < job.wanted; ++k) offered_.notify_one();
        return jobs_.insert(jobs_.end(), &job);
    }

    void serve() {
        std::unique_lock lock(lock_);
        for (;;) {
            const auto at = std::ranges::find_if(jobs_, [](const Job* j) { return j->wanted > 0; });
            if (at == jobs_.end()) {
                offered_.wait(lock);
                continue;
            }
            Job& job = **at;
            --job.wanted;
            ++job.busy;
            lock.unlock();
            (*job.work)();
            lock.lock();
            if (--job.busy == 0) done_.notify_all();
        }
    }
};

// Never destroyed: threads that wait end with the process. One that was forked has none of its parent's and begins anew.
Helpers& helpers() {
    static std::atomic<Helpers*> all{nullptr};
    [[maybe_unused]] static const int told = pthread_atfork(nullptr, nullptr, [] { all = nullptr; });
    Helpers* mine = all;
    if (!mine) {
        auto made = std::make_unique<Helpers>();
        if (all.compare_exchange_strong(mine, made.get())) mine = made.release();
    }
    return *mine;
}

}  // namespace

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

    if (threads > 1) helpers().run(threads - 1, work);
    else work(true);
    if (failure) std::rethrow_exception(failure);
    report(progress, stage, 1.0);
}

}  // namespace relievo
