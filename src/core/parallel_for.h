// A loop over [0, count) on several threads. Results must not depend on which thread does what; ours never do.
#pragma once

#include "core/progress.h"

#include <functional>

namespace relievo {

// Threads to use when a setting is 0: one per core this process may run on.
int default_threads();

// Calls body(begin, end) for blocks of at most `grain` indices, each once, in any order, on `threads` threads (0: all cores): the caller's and helpers, which stay for
// the next loop. Loops may be called in loops and from several threads; a caller goes on alone while the helpers are busy elsewhere.
// The first exception of a body, or of `progress` (called from the calling thread only), stops the loop and is rethrown.
void parallel_for(int count, int grain, int threads, const std::function<void(int begin, int end)>& body,
                  const Progress& progress = {}, std::string_view stage = {});

}  // namespace relievo
