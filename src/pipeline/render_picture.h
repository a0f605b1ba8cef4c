// One picture of one technique, as a file.
#pragma once

#include "core/progress.h"
#include "pipeline/material_source.h"
#include "render/gpu_renderer.h"
#include "scenes/view.h"

#include <string>

namespace relievo {

struct RenderSettings {
    MaterialSource material;
    const Technique* technique = nullptr;  // null: the exact reference
    MarchParams params{};
    View view;
    PictureSettings picture;
    std::string device;
    std::string out;  // .png: the picture; .exr: every plane of the Frame
    bool use_cache = true;
};

struct RenderedPicture {
    std::string source;          // device, driver, or "reference"
    double mean_fetches = 0;
    std::vector<std::string> notes;  // of the material
};

RenderedPicture render_picture(const RenderSettings& settings, const Progress& progress);

}  // namespace relievo
