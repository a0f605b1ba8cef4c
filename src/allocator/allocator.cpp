// How the programs allocate. They are linked with jemalloc, which reads this before main. Libraries of ours that others link do not come with it.
//
// A page of 4 KiB that a process touches for the first time can cost it more than computing what goes in: 14 us on one virtual machine, so that 64 MB of a map took
// 230 ms to be there and 4 ms to be written. One of 2 MiB costs little more than one of 4 KiB, but the system gives it only to who asks, and the C library asks only if a
// variable of the environment told it to before the program started. Here it is asked for by
//   thp: all of it;
//   narenas: one pool for all threads. Those of parallel_for live for one loop, and what they free should serve the next; they seldom allocate inside it.
// What is freed is given back after seconds, as jemalloc does by itself. Keeping it (dirty_decay_ms:-1) saved a tenth of a short run, but a comparison of fur
// then grew by 200 MB a second, as new requests were not served from much larger pieces.
// MALLOC_CONF in the environment adds to this.
extern "C" {
extern const char* malloc_conf;
const char* malloc_conf = "thp:always,narenas:1";
}
