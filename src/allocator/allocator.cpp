// How the programs allocate. They are linked with jemalloc, which reads this before main. Libraries of ours that others link do not come with it.
//
// A page of 4 KiB that a process touches for the first time can cost it more than computing what goes in: 14 us on one virtual machine, so that 64 MB of a map took
// 230 ms to be there and 4 ms to be written. One of 2 MiB costs little more than one of 4 KiB, but the system gives it only to who asks, and the C library asks only if a
// variable of the environment told it to before the program started. Here it is asked for by
//   thp: all of it;
//   narenas: one pool for all threads. Those of parallel_for live for one loop, and what they free should serve the next; they seldom allocate inside it;
//   oversize_threshold, dirty_decay_ms: what is freed is kept for what comes next, however large. Given back it would have to be cleared anew, and on a virtual
//   machine may have to be found anew: up to 1.5 ms a megabyte.
// MALLOC_CONF in the environment adds to this.
extern "C" {
extern const char* malloc_conf;
const char* malloc_conf = "thp:always,narenas:1,oversize_threshold:0,dirty_decay_ms:-1";
}
