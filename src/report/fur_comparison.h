// Ways of growing fur on meshes beside one another, as one value, and its texts: JSON (all of it), CSV (a line per row), a table for the
// terminal and a page that opens from disk.
#pragma once

#include "fur/fur_errors.h"

#include <cstddef>
#include <string>
#include <vector>

namespace relievo {

// One mode on one mesh in one coat.
struct FurRow {
    std::string mesh = {}, preset = {}, mode = {};
    std::size_t faces = 0, strands = 0;
    int layers = 0;
    FurErrors errors;                         // against the traced strands of the coat
    FurErrors budget;                         // of the mode
    double shared_texel_area = 0;             // share
    double first_frame_ms = 0, frame_ms = 0;  // from the loaded mesh; median
    std::string picture = {}, reference = {}; // files beside the page
};

struct FurComparison {
    std::string version, command, device;
    int width = 0, height = 0, passes = 0, samples = 0;
    std::vector<FurRow> rows;           // those of one mesh and coat follow each other
    std::vector<std::string> refused;   // meshes on which nothing grows, with the reason
};

std::string fur_comparison_json(const FurComparison& comparison);
std::string fur_comparison_csv(const FurComparison& comparison);
std::string fur_comparison_text(const FurComparison& comparison);
std::string fur_comparison_page(const FurComparison& comparison);

}  // namespace relievo
