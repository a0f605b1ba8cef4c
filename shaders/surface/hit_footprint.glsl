// The footprint of a pixel on the surface that was hit, from the differentials of its ray (Igehy 1999) instead of the polygon's: a
// flank that faces the eye is seen finer than the polygon under it, and what lies deeper is seen coarser.
#ifndef RELIEVO_SURFACE_HIT_FOOTPRINT
#define RELIEVO_SURFACE_HIT_FOOTPRINT

// lod as in SurfaceRay. pixel_angle: a pixel's width over its distance; distance to the hit in UV units; normal of the surface there,
// unit. Of the two axes across the ray the longer displacement in UV counts (Heckbert 1983).
float hit_lod(vec3 view, vec3 normal, float pixel_angle, float distance_to_hit) {
    vec3 level = vec3(-view.y, view.x, 0.0f);
    level = length(level) > 1e-6f ? normalize(level) : vec3(1.0f, 0.0f, 0.0f);
    vec3 steep = cross(view, level);
    float facing = max(dot(normal, view), 0.05f);  // flatter, a normal of the mip chain says little about the surface
    float width = pixel_angle * distance_to_hit;
    vec3 a = (level - view * (dot(normal, level) / facing)) * width;
    vec3 b = (steep - view * (dot(normal, steep) / facing)) * width;
    return log2(max(max(length(vec2(a)), length(vec2(b))), 1e-12f));
}

#endif
