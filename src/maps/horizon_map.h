// Max's horizon map: for each texel and 32 directions of the plane, the elevation under which the repeated surface hides the sky
// (Max 1988, Horizon Mapping: Shadows for Bump-Mapped Surfaces).
#pragma once

#include "core/height_field.h"
#include "core/map_set.h"
#include "core/progress.h"
#include "core/vec.h"

#include <numbers>

namespace relievo {

// Direction k as a step of the grid of texels, counter-clockwise from +u: (4,0), (4,1) ... (4,4), (3,4) ... (0,4) ... Steps on the grid
// instead of even angles, because lines along them pass from texel to texel and cross cell walls at the same few places: one
// sweep along a line then serves every texel on it.
Vec2i horizon_step(int direction);

// What is stored: the angle of a slope of the field, in heights per unit of UV, drawn at a height_scale of 0.1, over 90 degrees. An
// angle, because slopes have no bound and blend badly; at a fixed scale, so that one map serves all.
inline float horizon_code(double slope) { return std::atan(static_cast<float>(0.1 * slope)) * (2 / std::numbers::pi_v<float>); }
inline double horizon_slope(double code) { return std::tan(code * (std::numbers::pi / 2)) / 0.1; }

// A channel for each direction. Conservative: at texel centres never below the steepest slope to any point of the bilinear surface in that direction,
// and above it only where the surface bulges between the points that stand for it, by at most a 64th of the cell's twist
// |h00 - h10 - h01 + h11| in height (tests/maps/horizon_map_test.cpp measures both). Each line is swept once round, with the upper
// hull of what lies ahead (Timonen and Westerholm 2010, Scalable Height Field Self-Shadowing), so the time does
// not depend on the heights. The result does not depend on the number of threads (0: all cores). `progress` may throw Cancelled.
ImageF horizon_map(const HeightField& field, int threads = 0, const Progress& progress = {});

}  // namespace relievo
