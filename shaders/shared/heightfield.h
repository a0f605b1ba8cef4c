// The height-field family's question and answer, compiled by GLSL and by C++.
#ifndef RELIEVO_SHARED_HEIGHTFIELD_H
#define RELIEVO_SHARED_HEIGHTFIELD_H

// A ray through the slab 0 <= z <= 1 above a plane, in texture space. At height z it stands over
//   uv + (z - zero_level) * uv_per_height,
// so uv is where it meets the polygon. It is searched from z_start down to z_end: 1 to 0 for a view ray, 1 down to just above
// the lit point for a shadow ray, which is the same question asked from the light.
struct SurfaceRay {
    vec2 uv;             // UV on the polygon
    vec2 uv_per_height;  // height_scale * view.xy / view.z: UV gained per unit of height toward the eye
    vec3 view;           // unit, tangent space, from the surface to the eye (or to the light)
    float height_scale;  // relief amplitude in UV units
    float zero_level;    // height of the polygon, in [0,1]
    float z_start;
    float z_end;
    float lod;           // log2 of the undisplaced pixel footprint in UV units; accessors add log2 of the map's size
};

struct SurfaceHit {
    vec2 uv;       // texture coordinate of the surface seen
    float height;  // its height, in [0,1]
    bool found;    // false: the ray left the searched range without meeting the field
};

#endif
