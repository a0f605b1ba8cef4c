// What is asked of everything that draws fur, and what it returns.
#pragma once

#include "core/image.h"
#include "render/mesh_renderer.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

namespace relievo {

struct FurView {
    MeshView camera;
    Vec3d to_key{-0.45, 0.75, 0.55};  // toward the key light, of any length
    Vec3d to_rim{0.6, 0.35, -0.8};
    int layers = 16;  // at least 1
    float last_layer = 1;  // of shells, how far the last of them has come in, above 0 and at most 1: their number grows by degrees (shaders/fur/layer_top.glsl)
    int passes = 8;   // frames with their pixels' samples moved, averaged; at least 1
};

// The number of layers as one that grows by degrees: 6.25 are seven, the last of which has come in by a quarter.
inline double layers_of(const FurView& view) { return view.layers - 1 + static_cast<double>(view.last_layer); }
inline FurView with_layers(FurView view, double layers) {
    view.layers = static_cast<int>(std::ceil(layers));
    view.last_layer = static_cast<float>(layers - (view.layers - 1));
    return view;
}

// Milliseconds of a frame's steps on the device. Light and growing take none where what they made could be kept.
struct FurStages {
    double light = 0, skin = 0, grow = 0, plot = 0, shade = 0, copy = 0;
};

struct FurFrames {
    ImageF colour;    // 3 channels, linear light, premultiplied by coverage: the backdrop is missing
    ImageF coverage;  // 1 channel, share of the pixel's samples that fur or skin covers
    std::vector<double> frame_ms;  // of each pass, from its submission to its picture in memory
    std::vector<FurStages> stages;  // of each pass, where strands are plotted
};

// Adds one of `passes` pictures, RGBA as the device wrote it: colours sRGB-encoded and premultiplied by alpha. Frames begin as zeros.
void add_pass(FurFrames& frames, std::span<const std::uint8_t> rgba, int passes);

}  // namespace relievo
