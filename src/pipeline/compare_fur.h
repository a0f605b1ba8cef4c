// Ways of growing fur on meshes beside one another, all scored against the same traced strands.
#pragma once

#include "core/progress.h"
#include "fur/coat.h"
#include "fur/fur_modes.h"
#include "fur/painted_comb.h"
#include "report/fur_comparison.h"

#include <filesystem>
#include <string>
#include <vector>

namespace relievo {

struct CompareFurSettings {
    std::vector<std::filesystem::path> meshes;  // files
    std::vector<FurKind> modes;
    std::vector<CoatPreset> presets;
    CombPaint comb;       // painted on every mesh; its picture is read here
    int layers = 0;       // of every mode; 0: what each chooses by itself
    int width = 640, height = 400;
    int passes = 16;      // averaged into each picture
    int samples = 16;     // rays a pixel of the traced strands
    std::string device;
    int threads = 0;
    std::filesystem::path out;  // folder for index.html, results.json, results.csv and the pictures; made where it is missing
    std::string command;        // for the page
};

// A mesh on which nothing grows, or which the paint does not fit, is named in `refused`. Throws Error where nothing grows on any, and for what cannot be written or drawn.
FurComparison compare_fur(const CompareFurSettings& settings, const Progress& progress = {});

}  // namespace relievo
