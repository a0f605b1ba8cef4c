// The base under a pixel and the ray that goes through it. Tangent space is world space here: t = +x, b = +y, n = +z.
#include "scene.glsl"

layout(location = 0) in vec2 base_uv;
layout(location = 1) in vec3 base_position;

vec3 pixel_view() { return normalize(vec3(scene.eye_x, scene.eye_y, scene.eye_z) - base_position); }

// log2 of the longer side of the pixel's footprint in UV (Heckbert 1983's max(|du|, |dv|)), undisplaced. Call it in uniform flow.
float pixel_lod() { return log2(max(length(dFdx(base_uv)), length(dFdy(base_uv)))); }
