// Progress on standard error: a bar with the time left on a terminal, plain lines elsewhere.
#pragma once

#include "core/progress.h"

namespace relievo {

// A Progress that shows itself (unless quiet) and throws Cancelled after Ctrl-C.
Progress progress_display(bool quiet);

}  // namespace relievo
