#include "effects/effects_table.h"

namespace relievo {

namespace {

constexpr PublishedEffects table[] = {
    {"displacement_mapping", "Displacement mapping", {.motion_parallax = true, .self_occlusion = true, .self_shadow = false, .silhouette = true}},
    {"bump_mapping", "Bump mapping", {}},
    {"normal_mapping", "Normal mapping", {}},
    {"parallax_mapping", "Parallax mapping", {.motion_parallax = true}},
    {"parallax_offset_limiting", "Parallax mapping with offset limiting", {.motion_parallax = true}},
    {"parallax_slope", "Parallax mapping with slope", {.motion_parallax = true}},
    {"parallax_iterative", "Iterative parallax mapping", {.motion_parallax = true}},
    {"linear_search", "Linear search", {.motion_parallax = true, .self_occlusion = true, .self_shadow = true}},
    {"binary_search", "Binary search", {.motion_parallax = true, .self_occlusion = true}},
    {"relief_mapping", "Relief mapping", {.motion_parallax = true, .self_occlusion = true, .self_shadow = true}},
    {"parallax_occlusion_mapping", "Parallax occlusion mapping", {.motion_parallax = true, .self_occlusion = true, .self_shadow = true}},
    {"cone_step_mapping", "Cone step mapping", {.motion_parallax = true, .self_occlusion = true, .self_shadow = true}},
    {"distance_mapping", "Displacement with distance functions", {.motion_parallax = true, .self_occlusion = true, .self_shadow = true}},
    {"relaxed_cone_stepping", "Relaxed cone stepping", {.motion_parallax = true, .self_occlusion = true, .self_shadow = true}},
    {"four_layer", "Relief mapping of non-height-field detail", {.motion_parallax = true, .self_occlusion = true, .self_shadow = true, .silhouette = true}},
    {"tessellated_displacement", "Tessellation", {.motion_parallax = true, .self_occlusion = true, .self_shadow = false, .silhouette = true}},
};

constexpr EffectDifference differences[] = {
    {"binary_search", "self_occlusion",
     "it finds some crossing, not the first: where the ray meets the surface three times it is as likely to answer the one behind the wall, so half of what "
     "the wall hides is shown"},
    {"binary_search", "self_shadow",
     "a shadow only needs some crossing between point and lamp, which bisection can find: it finds the wall from more than half of its shadow, never a wall "
     "that is not there; a patchy shadow, but one that was not to be had by the published table"},
};

}  // namespace

std::span<const PublishedEffects> published_effects() { return table; }
std::span<const EffectDifference> known_differences() { return differences; }

}  // namespace relievo
