// Includes the file RELIEVO_LANES_CODE once for every kind of machine that this program may meet, with RELIEVO_MACHINE a namespace of its
// own and RELIEVO_LANES the floats of its widest register, and compiled for it. That file has no include guard, and includes nothing
// itself: what it needs is included before, for the plain machine. Calls go through RELIEVO_BEST_MACHINE(function), which chooses
// when the program runs. To be included from .cpp files only.
#define RELIEVO_MACHINE plain
#define RELIEVO_LANES 4
#include RELIEVO_LANES_CODE
#undef RELIEVO_MACHINE
#undef RELIEVO_LANES

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)

#pragma GCC push_options
#pragma GCC target("avx2")
#define RELIEVO_MACHINE avx2
#define RELIEVO_LANES 8
#include RELIEVO_LANES_CODE
#undef RELIEVO_MACHINE
#undef RELIEVO_LANES
#pragma GCC pop_options

#pragma GCC push_options
#pragma GCC target("avx512f,avx512bw,avx512dq,avx512vl")
#define RELIEVO_MACHINE avx512
#define RELIEVO_LANES 16
#include RELIEVO_LANES_CODE
#undef RELIEVO_MACHINE
#undef RELIEVO_LANES
#pragma GCC pop_options

#define RELIEVO_BEST_MACHINE(scope, function)                                                              \
    (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512dq") && \
             __builtin_cpu_supports("avx512vl")                                                             \
         ? &scope::avx512::function                                                                         \
     : __builtin_cpu_supports("avx2") ? &scope::avx2::function                                              \
                                      : &scope::plain::function)
#else
#define RELIEVO_BEST_MACHINE(scope, function) (&scope::plain::function)
#endif
