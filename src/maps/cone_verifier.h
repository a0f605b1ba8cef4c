// Proves of cones over a height field, one by one, that they keep their promise on the declared surface, or shows where they break it.
// Independent of the bakers: no code, no pyramid and no formula is shared with them.
#pragma once

#include "core/height_field.h"
#include "core/progress.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relievo {

struct ConeApex {
    double x, y;    // in texels from the first texel's centre
    double height;  // [0,1]
    double ratio;   // UV radius per unit of height, [0,1]
};

// conservative: no point of the bilinear surface, in any repeat, lies inside the cone.
// relaxed: none lies inside it at which the surface falls outward, seen from the apex (maps/relaxed_cone.h).
enum class ConePromise { conservative, relaxed };

struct Verification {
    std::uint64_t cones = 0;
    std::uint64_t pairs = 0;      // (cone, cell of the 3x3 repeats around it) that were decided, most of them many at once
    std::uint64_t checks = 0;     // bounds that were evaluated for it
    std::uint64_t violated = 0;   // cones with a point in them that they promised to be free of
    std::uint64_t undecided = 0;  // cones that were neither proven nor broken to 2^-40 of a cell
    double deepest = 0;           // largest of the intrusions met, as a share of the cone's radius at that height; not a maximum over all points
    ConeApex first{};             // a violated cone, the first in the order given, if there is one
};

// A cone is decided by bounds over nodes of a pyramid, then over cells and parts of cells. Over a part, with s = |p - x| - c (H(p) - z)
// at its centre, distance is convex and H a plane plus a twist, so that with half sizes a, b and gradients of |p - x| and H at the centre
//   s(p) >= s - |d|x| - c H_x| a - |d|y| - c H_y| b - c |H_xy| a b,
// and where only falling points matter, the same with a multiple of the radial derivative's own bound added (weak duality): both
// of second order, so that parts stay large beside a cone that touches. All in double; every quantity is below 4 and stands for
// fewer than 64 roundings, and a bound counts only beyond that. Beside the apex, where s vanishes, s / |p - x| is bounded instead.
// Cones reach no further than one UV unit (ratio and heights at most 1), so that 3x3 repeats are all there is.
// Throws Error for ratios or heights outside their range, and what `progress` throws. threads: 0 means all cores.
Verification verify_cones(const HeightField& field, std::span<const ConeApex> cones, ConePromise promise, int threads = 0,
                          const Progress& progress = {});

// The cones of a map whose first channels are height and ratio, at its texels' centres.
std::vector<ConeApex> texel_cones(const ImageF& map);

// One cone for each texel of a map, at a random place of the texel's square and on the surface there, with the texel's ratio: what a
// search meets that reads ratios with the nearest texel. The same for equal seeds.
std::vector<ConeApex> scattered_cones(const HeightField& field, const ImageF& map, std::uint32_t seed);

}  // namespace relievo
