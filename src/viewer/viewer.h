// The window: one material, every technique and knob of the tables, beside the exact reference.
#pragma once

#include "pipeline/material_source.h"
#include "scenes/view.h"
#include "techniques/technique.h"

#include <string>

namespace relievo {

struct ViewerSettings {
    MaterialSource material;
    const Technique* technique = nullptr;
    View view;
    std::string device;
    int width = 1280;
    int height = 720;
    int frames = 0;           // close after this many; 0: when the user does
    std::string screenshot;   // PNG of the last frame, if not empty
    bool split = false;
    bool validation = false;
};

// Returns when the window is closed. Throws Error when there is no display or no device that can present.
void run_viewer(const ViewerSettings& settings);

}  // namespace relievo
