// How the programs allocate. They are linked with jemalloc, which reads this before main. Libraries of ours that others link do not come with it.
//
// A page of 4 KiB that a process touches for the first time can cost it more than computing what goes in: 14 us on one virtual machine, so that 64 MB of a map took
// 230 ms to be there and 4 ms to be written. One of 2 MiB costs little more than one of 4 KiB, but the system gives it only to who asks, and the C library asks only if a
// variable of the environment told it to before the program started. Here it is asked for by
//   thp: all of it;
//   narenas: one pool for all threads. Those of parallel_for live for one loop, and what they free should serve the next; they seldom allocate inside it.
// What is freed is given back after seconds, as jemalloc does by itself, and until then serves the next request:
//   lg_extent_max_active_fit: a request may be served from a piece a million times as large (jemalloc: 64 times), as the pieces of one picture grow together to such;
//   oversize_threshold: pieces above 8 MiB are treated like others, where jemalloc gives them back at once. Its option says so to all pools but the first, to which
//   begin_allocating does.
// Keeping it for good (dirty_decay_ms:-1) made comparisons of fur grow by 200 MB a second.
// MALLOC_CONF in the environment adds to this.
#include <cstddef>

extern "C" {
extern const char* malloc_conf;
const char* malloc_conf = "thp:always,narenas:1,oversize_threshold:1099511627776,lg_extent_max_active_fit:20";

// Of jemalloc; not there where a sanitizer brings its own allocator.
int mallctl(const char* name, void* old_value, std::size_t* old_bytes, void* new_value, std::size_t new_bytes) __attribute__((weak));
}

namespace {

__attribute__((constructor)) void begin_allocating() {
    std::size_t terabyte = std::size_t{1} << 40;
    // Versions before 5.3 know nothing of it, and go on as they do by themselves.
    if (mallctl) mallctl("arena.0.oversize_threshold", nullptr, nullptr, &terabyte, sizeof terabyte);
}

}  // namespace
