// Ctrl-C and SIGTERM as a question that long work asks itself.
#pragma once

namespace relievo {

// From now on the first SIGINT or SIGTERM only sets a flag; the second one ends the process at once.
void catch_interrupts();

// Throws Cancelled once a signal came.
void stop_if_interrupted();

}  // namespace relievo
