// A coarse grid laid over the relief, to see what shading per face or per vertex does to it: `facets` square cells along a repeat.
#ifndef RELIEVO_SHADING_FACETS
#define RELIEVO_SHADING_FACETS

#include "../surface/maps.glsl"

// Lower left corner of the cell that a point is in, in UV, and the point's place inside it.
vec2 facet_corner(vec2 uv, float facets) { return floor(uv * facets) * (1.0f / facets); }
vec2 facet_inside(vec2 uv, float facets) { return uv * facets - floor(uv * facets); }

// The one normal of a cell: of the plane that fits its four corners best.
vec3 facet_normal(vec2 uv, float facets, float height_scale) {
    vec2 corner = facet_corner(uv, facets);
    float side = 1.0f / facets;
    float h00 = height_at(corner);
    float h10 = height_at(corner + vec2(side, 0.0f));
    float h01 = height_at(corner + vec2(0.0f, side));
    float h11 = height_at(corner + vec2(side, side));
    float slope = 0.5f * height_scale * facets;
    return normalize(vec3((h00 - h10 + h01 - h11) * slope, (h00 - h01 + h10 - h11) * slope, 1.0f));
}

#endif
