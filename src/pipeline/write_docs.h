// The part of the documentation that the program knows better than any hand: a chapter per technique with its listing, figure and
// measured errors, and the tables of techniques, maps and knobs.
#pragma once

#include "core/progress.h"

#include <string>

namespace relievo {

struct DocsSettings {
    std::string out;      // folder; techniques/ and figures/ are made in it
    std::string device;   // as GpuRenderer takes it; draws the figures
    bool figures = true;  // false: texts only, which needs no device
    int threads = 0;
};

// The texts between "<!-- measured -->" marks hold numbers of this machine's CPU; all else is the same everywhere.
void write_docs(const DocsSettings& settings, const Progress& progress);

}  // namespace relievo
