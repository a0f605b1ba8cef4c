// The conservative cone map: over each texel the widest upward cone that no point of the declared surface enters.
#pragma once

#include "core/height_field.h"
#include "core/progress.h"

namespace relievo {

// Two channels: the height h_x of the texel, and the ratio c (UV radius per unit of height, in (0, 1]), the largest c <= 1 with
//   c (H(p) - h_x) <= |p - x|   for every point p of the bilinear surface H, in all repeats.
// Exact, and then lowered by at most 2^-19 of itself, so that rounding never makes a cone too wide.
//
// Along a straight line at distance E from x the relative height is a + b y, and (a + b y) / sqrt(E^2 + y^2) is largest at
// y = b E^2 / a, or at the end nearest to that: so much for the edges of a cell. Its inside can be steeper still. With
// H - h_x = C + gx X + gy Y + d X Y about x, in the quadrant where X, Y >= 0, the slope along a ray of direction t is
// C / r + A(t) + B(t) r, which has a largest value inside the cell only where C < 0 and d < 0, at X Y = C / d: on one arc of a
// hyperbola. With w = sqrt(Y / X), k = 2 sqrt(C d), the slope on it is (gx + gy w^2 - k w) / sqrt(1 + w^4), and its derivative
// has the sign of k w^4 - 2 gx w^3 + 2 gy w - k: negative at 0, positive far out, and by Descartes' rule with at most three positive
// roots, so that there is at most one largest value off the edges. It is found by bisection between the quartic's largest value
// up to its inflection gx / k and its least value after it. In the four cells around x its limit is the gradient at x itself, where
// both components rise and d < 0.
//
// Independent of the number of threads (0: all cores). Heights are finite and in [0,1]. `progress` may throw Cancelled.
// Ban & Valasek 2022-2024 found that sampled cones are too wide between texels; the closed forms here are ours.
ImageF conservative_cone(const HeightField& field, int threads = 0, const Progress& progress = {});

}  // namespace relievo
