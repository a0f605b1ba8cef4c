// The relaxed cone map: over each texel the widest upward cone inside which no ray from its axis leaves the solid.
#pragma once

#include "core/height_field.h"
#include "core/progress.h"

namespace relievo {

// Two channels: the height h_x of the texel, and the ratio c (UV radius per unit of height, in (0, 1]), the largest c <= 1 such that
// no ray that starts on the cone's axis, above the surface, and goes down in any direction leaves the solid below the bilinear
// surface H (all repeats) inside the cone. Such a ray may enter the solid inside the cone, at most once, and is then still in it
// where it crosses the cone's wall: a search that leaps from wall to wall brackets the first hit as soon as a leap ends in the solid
// (Policarpo & Oliveira 2007, "Relaxed Cone Stepping for Relief Mapping").
//
// A ray that descends by s per unit of distance leaves the solid at p exactly where H falls outward, seen from x, faster than s;
// every s > 0 occurs (from just above H(p), almost level). So p limits the cone if H(p) > h_x and H falls at p along the ray from
// x through p, to
//   c (H(p) - h_x) <= |p - x|,
// and the ratio is the least over all those points and their limits. Policarpo & Oliveira let rays start at height 1 only; those
// cones are wider, and a ray that arrives at grazing angles can pass through the solid inside them.
//
// On a ray through a cell the points that fall begin where the ray enters the cell, or at a crest inside it, and the slope to x
// is largest there. The near edges of a cell are therefore searched where H falls into the cell, in closed form (conservative_cone.h).
// Inside, with H - h_x = C + gx X + gy Y - D X Y, the crest is gx X + gy Y = 2 D X Y, D > 0: one arc, on which with t = Y / X,
// m = gx + gy t the slope is (m^2 + 4 C D t) / (2 m sqrt(1 + t^2)), and is largest at the arc's ends or at a root of the cubic
//   m^2 (gy - gx t) + 4 C D (gx - gy t^3).
// Exact, and then lowered by at most 2^-19 of itself; a surface that is level along a ray to 2^-20 of its steps counts as falling.
//
// Independent of the number of threads (0: all cores). Heights are finite and in [0,1]. `progress` may throw Cancelled.
ImageF relaxed_cone(const HeightField& field, int threads = 0, const Progress& progress = {});

}  // namespace relievo
