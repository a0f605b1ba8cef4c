// What may be turned on any technique of the height-field family: the values of the choices, and the numbers that go with them.
// Ids, ranges, help and papers stand in techniques/modifiers.h.
#ifndef RELIEVO_SHARED_DRAW_OPTIONS_H
#define RELIEVO_SHARED_DRAW_OPTIONS_H

// One value for each modifier.
struct DrawModes {
    int shadow;
    int edge;
    int steps;
    int scale;
    int border;
    int fade;
    int mip;
    int shading;
    int sheet;
};

const int shadow_none = 0;
const int shadow_hard = 1;
const int shadow_soft = 2;
const int shadow_tatarchuk = 3;
const int shadow_horizon = 4;
const int shadow_area = 5;

const int edge_none = 0;
const int edge_behind_mode = 1;
const int edge_passed_mode = 2;
const int edge_covered_mode = 3;

const int steps_fixed = 0;
const int steps_cosine = 1;
const int steps_texel = 2;

const int scale_fixed = 0;
const int scale_cosine = 1;
const int scale_power = 2;

const int border_repeat = 0;
const int border_clip = 1;
const int border_chart = 2;

const int fade_none = 0;
const int fade_footprint = 1;

const int mip_polygon = 0;
const int mip_hit = 1;
const int mip_finest = 2;

const int shading_phong = 0;
const int shading_blinn_phong = 1;
const int shading_ggx = 2;
const int shading_gouraud = 3;
const int shading_flat = 4;

const int sheet_none = 0;
const int sheet_polygon = 1;
const int sheet_relief = 2;

// After ReliefUniforms in the block of a draw.
struct DrawNumbers {
    float light_radius;      // of the key light's disc, as seen from the surface, radians
    float shadow_depth;      // penetration at which a soft shadow is black, in heights
    float shadow_softening;  // factor on the blocking that the eight samples see
    int shadow_samples;      // heights along a light ray, or rays to an area light
    float edge_width;        // gap at which an edge that was passed leaves the pixel, in heights
    int edge_samples;        // heights along the view ray that look for edges
    int least_steps;         // seen from above
    float least_scale;       // share of the amplitude at the horizon
    float scale_exponent;    // k of 1 - (1 - cos alpha)^k
    float fade_near;         // texels a pixel covers, where the relief begins to flatten
    float fade_far;          // and where it is flat
    float roughness;         // perceptual: its square is GGX's alpha
    float metallic;
    int facets;              // flat faces, or vertices that are lit, along a repeat
    float sheet_level;       // of a level sheet that the relief meets, in heights
    float chart;             // edge of the square of UV beyond which there is nothing; 0: it repeats. Follows from `border`
};

#endif
