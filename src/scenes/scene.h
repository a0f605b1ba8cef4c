// The table of named scenes (a procedural material, its base and its light), and the stage that any material is put on.
#pragma once

#include "core/camera.h"
#include "core/frame.h"
#include "core/lighting.h"
#include "scenes/view.h"

#include <span>
#include <string_view>

namespace relievo {

// A square polygon in the plane z = 0, centred on the origin; one world unit is one repeat of the texture, u along +x, v along +y.
struct Quad {
    float periods = 3.0f;  // edge length, in repeats; UV runs from 0 to periods
};

struct Stage {
    Quad base;
    Camera camera;
    Lighting lighting;
};

struct Scene {
    std::string_view id;        // also the id of the procedural material it shows (textures/)
    std::string_view title;
    std::string_view summary;   // which weakness it is there to show
    float height_scale;
};

std::span<const Scene> scenes();
const Scene* find_scene(std::string_view id);

// The stage on which a material is shown from a view: the camera framed on the quad, a warm key light low enough that relief
// reads, a weak cool fill. From behind the stage is mirrored in the polygon (core/camera.h), and the lights stay on the eye's side; the
// material to put on it is the back (maps/back_side.h).
Stage stage_for(const View& view);

// The rays of a picture of the stage's quad, in double from the camera alone; `offset` shifts the sample inside the pixel, from
// its centre, in pixels. The GPU's own rays agree with these to float precision.
RayField quad_rays(const Stage& stage, int width, int height, Vec2d offset);

}  // namespace relievo
