// How the programs allocate. They are linked with jemalloc, which reads this before main. Libraries of ours that others link do not come with it.
//
// A page of 4 KiB that a process touches for the first time can cost it more than computing what goes in: 14 us on one virtual machine, so that 64 MB of a map took
// 230 ms to be there and 4 ms to be written. One of 2 MiB costs little more than one of 4 KiB, but the system gives it only to who asks, and the C library asks only if a
// variable of the environment told it to before the program started. Here it is asked for by
//   thp: all of it;
//   narenas: one pool for all threads. What one frees should serve the others, and they seldom allocate inside loops.
//   lg_extent_max_active_fit: a request may be served from a free piece a million times as large (jemalloc: 64 times), as what core/warm_memory.h hands over is.
// What is freed is given back after seconds, pieces above 8 MiB at once, as jemalloc does by itself. Keeping all for good (dirty_decay_ms:-1) made comparisons of fur grow by
// 200 MB a second; keeping large pieces for seconds made one end at 1.17 GB instead of 0.97.
// MALLOC_CONF in the environment adds to this.
extern "C" {
extern const char* malloc_conf;
const char* malloc_conf = "thp:always,narenas:1,lg_extent_max_active_fit:20";
}
