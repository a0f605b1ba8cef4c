// One picture of one technique, as a file.
#pragma once

#include "core/measurement.h"
#include "core/progress.h"
#include "pipeline/material_source.h"
#include "render/gpu_renderer.h"
#include "scenes/view.h"

#include <optional>
#include <string>

namespace relievo {

struct RenderSettings {
    MaterialSource material;
    const Technique* technique = nullptr;  // null: the exact reference
    MarchParams params{};
    View view;
    PictureSettings picture;
    std::string mesh;     // a mesh that carries the relief (mesh_relief_picture.h); empty: the flat square
    double repeats = 1;   // of the material over the mesh's [0,1]^2 of UV
    std::string device;
    std::string out;  // .png: the picture; .exr: every plane of the Frame
    bool use_cache = true;
};

// Of a picture on a mesh: the first surface under each pixel, against the exact answer to the same rays.
struct MeshFacts {
    std::size_t faces = 0;
    std::size_t charts = 0;
    std::size_t judged = 0;        // pixels whose exact ray has a hit
    std::size_t holes = 0;         // pixels that the exact relief leaves open at the edge of a chart
    std::size_t holes_filled = 0;  // of these, pixels where the technique found something
    Measured<double> missed_first_hit, early_hit;
    Measured<Percentiles> uv_error_texels;
};

struct RenderedPicture {
    std::string source;          // device, driver, or "reference"
    double mean_fetches = 0;
    std::vector<std::string> notes;  // of the material
    std::optional<MeshFacts> mesh;
};

RenderedPicture render_picture(const RenderSettings& settings, const Progress& progress);

}  // namespace relievo
