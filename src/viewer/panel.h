// The panel at the left of the window, made by walking the tables of techniques, knobs and views.
#pragma once

#include "viewer/controls.h"

#include <span>
#include <string>

struct ImFont;

namespace relievo {

// What the panel says besides what can be turned.
struct PanelFacts {
    std::string material;                // name and size of the maps
    std::span<const std::string> notes;  // what loading assumed
    std::string device;
    std::span<const float> technique_ms;  // GPU time of the technique's pass, the last frames, the newest last
    double frame_ms = 0;                  // of the CPU, to prepare and record a frame, waiting excluded
    double mean_fetches = 0;
    double reference_share = 0;  // of the reference picture that is finished
};

struct PanelSettings {
    float width = 0;   // points
    float height = 0;  // points
    ImFont* heading = nullptr;
};

// True once the relief's amplitude was let go of, so that normals can be made for it.
bool draw_panel(Controls& controls, const PanelFacts& facts, const PanelSettings& settings);

// Width of the panel in a window this wide, in points, at this scale of the text: at most half of it, and 0 (no panel) where that
// would be too narrow to read.
float panel_width(float window_width, float text_scale);

}  // namespace relievo
