// The window: one material, every technique and knob of the tables, beside the exact reference.
#pragma once

#include "core/progress.h"
#include "pipeline/material_source.h"
#include "scenes/view.h"
#include "techniques/technique.h"

#include <functional>
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
    std::string screenshot;   // PNG of the last frame, controls included, if not empty; after `frames` its reference is whole
    bool split = false;       // begin with the exact reference beside the technique
    bool validation = false;  // a message of the validation layers is an error
    Progress progress = {};   // of loading and baking
    std::function<void()> poll = {};  // called before each frame; may throw Cancelled, and nothing is written then
};

// Returns when the window is closed. Throws Error when there is no display or no device that can present.
void run_viewer(const ViewerSettings& settings);

}  // namespace relievo
