// What may be turned on any technique of the height-field family: the values of the choices, and the numbers that go with them.
// Ids, ranges, help and papers stand in techniques/modifiers.h.
#ifndef RELIEVO_SHARED_DRAW_OPTIONS_H
#define RELIEVO_SHARED_DRAW_OPTIONS_H

const int shadow_none = 0;
const int shadow_hard = 1;
const int shadow_soft = 2;
const int shadow_tatarchuk = 3;
const int shadow_horizon = 4;
const int shadow_area = 5;

// After ReliefUniforms in the block of a draw.
struct DrawNumbers {
    float light_radius;      // of the key light's disc, as seen from the surface, radians
    float shadow_depth;      // penetration at which a soft shadow is black, in heights
    float shadow_softening;  // factor on the blocking that the eight samples see
    int shadow_samples;      // heights along a light ray, or rays to an area light
};

#endif
