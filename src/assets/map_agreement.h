// Whether a height map and a normal map describe the same surface: the height's gradient against the normals' slope.
#pragma once

#include "core/height_field.h"
#include "core/image.h"

namespace relievo {

// What the two maps say of each other. With heights white-high and green up both correlations are positive:
//   the slope of a normal (n.x, n.y) / n.z is -height_scale * (dh/du, dh/dv).
struct MapAgreement {
    double x = 0;   // correlation of -dh/du with n.x / n.z, in [-1,1], at the scale where the two agree most clearly;
    double y = 0;   // likewise -dh/dv with n.y / n.z; 0 where one of them has no slope along that axis
    int width = 0;  // size at which the maps were compared; 0: too small to compare
    int height = 0;
    double height_scale = 0;  // amplitude of the relief the two imply together, UV units; means something where they agree
};

MapAgreement compare_maps(const HeightField& height, const ImageF& normal);

// How the two maps of a material are to be read.
struct MapReading {
    bool polarity_decided = false;
    bool inverted = false;  // white is low: the height reads as depth
    bool green_decided = false;
    bool green_down = false;  // the normals' green points along -v
};

// Maps that belong together agree by this much at least, root mean square over the axes that have slope at all: over the 30 real
// sets this was tuned on, 0.57 and up; unrelated maps reached 0.35 (boards on planks: real likeness), 0.12 in nine cases of ten.
inline constexpr double decisive_agreement = 0.4;
// ... and a single axis, once they do, tells its sign from this on.
inline constexpr double decisive_correlation = 0.15;

// x decides the polarity, since every convention has red along +u; y then decides the green. Where the surface has no slope in x
// the polarity stays undecided and y is read with white high.
MapReading read_agreement(const MapAgreement& agreement);

}  // namespace relievo
