// fuzz_mesh FORMAT|all SECONDS [SEED]: changed files of a format, as many as the time allows, each parsed under the eyes of whatever
// sanitizers the build has. Deterministic for a seed, needs no fuzzing engine. An input is kept in fuzz-FORMAT.input until it is
// parsed, so that a crash leaves it there; `fuzz_mesh FORMAT FILE` tries one again. Built with -DRELIEVO_LIBFUZZER and clang's
// -fsanitize=fuzzer it is a libFuzzer target instead (environment: RELIEVO_FUZZ_FORMAT).
#include "core/error.h"
#include "fuzz/mesh_seeds.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#ifdef RELIEVO_LIBFUZZER

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const std::string format = std::getenv("RELIEVO_FUZZ_FORMAT") ? std::getenv("RELIEVO_FUZZ_FORMAT") : "obj";
    relievo::fuzz::try_mesh(format, {reinterpret_cast<const char*>(data), size});
    return 0;
}

#else

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/time.h>

#include <csignal>
#include <cstring>
#include <fcntl.h>
#include <unistd.h>

namespace {

using namespace relievo;

// What is being parsed, written to a file by the handler below when the parser does not come back.
const std::string* current = nullptr;
std::string input_file;

void keep_input() {
    const int file = ::open(input_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    if (file < 0 || !current) return;
    [[maybe_unused]] const auto written = ::write(file, current->data(), current->size());
    ::close(file);
}

extern "C" void on_signal(int signal) {
    keep_input();
    const char text[] = "fuzz_mesh: the input that did this was kept\n";
    [[maybe_unused]] const auto written = ::write(2, text, sizeof text - 1);
    ::signal(signal, SIG_DFL);
    ::raise(signal);
}

#if defined(__SANITIZE_ADDRESS__)
extern "C" void __asan_on_error() { keep_input(); }
#endif

// SIGPROF after so many seconds of computing, which a busy machine does not stretch; 0: none.
void allow(long seconds) {
    const itimerval timer{{0, 0}, {seconds, 0}};
    ::setitimer(ITIMER_PROF, &timer, nullptr);
}

void run(const std::string& format, double seconds, std::uint64_t seed) {
    input_file = "fuzz-" + format + ".input";
    const std::vector<std::string> seeds = fuzz::seeds(format);
    for (const int signal : {SIGABRT, SIGSEGV, SIGBUS, SIGFPE, SIGPROF}) ::signal(signal, on_signal);
    std::mt19937_64 random(seed);
    std::vector<std::string> pool = seeds;  // grows by some of what was accepted, so that changes pile up
    std::uint64_t runs = 0, accepted = 0, bytes = 0;
    double slowest = 0;
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    const auto since = [](Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); };
    for (const std::string& file : seeds) fuzz::try_mesh(format, file);
    while (since(start) < seconds) {
        std::string input = fuzz::mutated(pool[random() % pool.size()], seeds[random() % seeds.size()], random);
        current = &input;
        allow(30);  // a parser that computes longer over 64 KiB hangs
        const auto begin = Clock::now();
        const bool good = fuzz::try_mesh(format, input);
        accepted += good;
        slowest = std::max(slowest, since(begin));
        allow(0);
        ++runs;
        bytes += input.size();
        if (good && random() % 16 == 0) {
            if (pool.size() < 256)
                pool.push_back(std::move(input));
            else
                pool[seeds.size() + random() % (pool.size() - seeds.size())] = std::move(input);
        }
        current = nullptr;
    }
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    const double cpu = static_cast<double>(usage.ru_utime.tv_sec + usage.ru_stime.tv_sec);
    std::printf("%s: %llu inputs (%llu read as meshes), %.1f MB, %.0f s, %.0f s of them computing, slowest %.1f ms, at most %ld MB of memory, no fault\n",
                format.c_str(), static_cast<unsigned long long>(runs), static_cast<unsigned long long>(accepted), static_cast<double>(bytes) / 1e6,
                since(start), cpu, 1e3 * slowest, usage.ru_maxrss / 1024);
}

}  // namespace

int main(int count, char** arguments) {
    const std::string format = count > 1 ? arguments[1] : "";
    const bool all = format == "all";
    if (count < 3 || (!all && std::find(fuzz::formats.begin(), fuzz::formats.end(), format) == fuzz::formats.end())) {
        std::fputs("fuzz_mesh FORMAT|all SECONDS [SEED]\nfuzz_mesh FORMAT FILE\nformats:", stderr);
        for (const std::string& f : fuzz::formats) std::fprintf(stderr, " %s", f.c_str());
        std::fputs("\n", stderr);
        return 2;
    }
    char* end = nullptr;
    const double seconds = std::strtod(arguments[2], &end);
    if (*end == '\0') {
        const std::uint64_t seed = count > 3 ? std::strtoull(arguments[3], nullptr, 10) : 1;
        for (const std::string& f : fuzz::formats)
            if (all || f == format) run(f, seconds, seed);
        return 0;
    }
    std::ifstream in(arguments[2], std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    std::puts(fuzz::try_mesh(format, bytes) ? "read as a mesh, no fault" : "refused, no fault");
    return 0;
}

#endif
