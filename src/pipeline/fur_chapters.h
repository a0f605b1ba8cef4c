// A chapter for every mode of fur: what it is, a figure, what it shows, its budgets beside what was measured, where it fails.
#pragma once

#include "core/progress.h"

#include <filesystem>
#include <string>

namespace relievo {

struct FurChaptersSettings {
    std::filesystem::path out;  // fur/ID.md and figures/fur-mode-ID.png are written here; both folders exist
    bool drawn = true;          // with the figures and all that a device measures; else the texts alone
    std::string device;
    int threads = 0;
};

// The part of the page of effects that is about fur. Throws Error.
std::string write_fur_chapters(const FurChaptersSettings& settings, const Progress& progress = {});

}  // namespace relievo
