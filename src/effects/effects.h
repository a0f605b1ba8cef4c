// The four effects by which the field tells techniques apart, each measured on a scene in which it can only be there or not.
#pragma once

#include "techniques/technique.h"

#include <span>
#include <string_view>

namespace relievo {

// How much of an effect a technique shows: 1 is all of it, 0 none. Deterministic; on the CPU, with the technique's default knobs.

// Of the shift that a plateau above or below the polygon has, seen 60 degrees above it from four sides.
struct Parallax {
    double least = 0;     // worst of the views
    double most = 0;
    double sideways = 0;  // largest shift across the line of sight, in UV; there should be none
};
Parallax measured_parallax(const Technique& technique);

// Of the floor that a wall hides, seen 25 degrees above it, the share that is indeed never seen.
double measured_occlusion(const Technique& technique);

// Of the floor in that wall's shadow, the share found dark, less the share found dark of floor and wall in the light.
double measured_shadow(const Technique& technique);

// Of the rays that pass beyond the chart's border inside the slab, the share that finds no surface there.
double measured_silhouette(const Technique& technique);

// One effect: what is looked at, and from where on it counts as there. Nothing may lie between `absent_to` and `present_from`: a
// technique in the gap needs a better scene or a better claim.
struct EffectKind {
    std::string_view id;
    std::string_view title;
    std::string_view scene;   // what can only be there or not
    std::string_view number;  // what is measured, as a share
    double present_from;
    double absent_to;
    bool Effects::*claim;     // the row of the catalogue
    double (*measure)(const Technique&);
};

inline constexpr int effect_count = 4;
std::span<const EffectKind> effect_kinds();  // in the order in which published tables have them

}  // namespace relievo
