// One ray of one material, searched by several techniques with every step noted, as numbers and as a figure.
#pragma once

#include "core/progress.h"
#include "explain/search.h"
#include "figure/drawing.h"
#include "pipeline/material_source.h"
#include "scenes/view.h"

#include <optional>
#include <string>
#include <vector>

namespace relievo {

struct ExplainSettings {
    struct Asked {
        const Technique* technique = nullptr;
        MarchParams params{};
    };
    MaterialSource material;
    std::vector<Asked> techniques;

    // Either a pixel of a view of the stage, or a ray by itself.
    View view;
    int width = 1280, height = 720;    // of the whole picture
    std::optional<Vec2i> pixel;        // from the top left corner; none: the middle
    std::optional<Vec2d> uv;           // where the ray meets the polygon; with it, view and pixel are not asked
    double elevation_deg = 30, azimuth_deg = 0;  // of the eye, as in View

    std::string out;                   // .svg or .png; empty: no figure
    Paper paper = Paper::either;
    double scale = 2;                  // pixels of the PNG to one of the figure, whose width is 1000
    bool use_cache = true;
};

struct Explained {
    Section section;
    std::vector<Search> searches;      // in the order asked
    std::vector<std::string> notes;    // of the material
    std::string where;                 // the ray, in words
};

Explained explain_ray(const ExplainSettings& settings, const Progress& progress);

}  // namespace relievo
