// Bump mapping's normal (Blinn 1978, "Simulation of Wrinkled Surfaces"): a surface X(u,v) moved by P along its normal n = X_u x X_v
// has, as long as P is small against the surface's curvature,
//   n' = n + P_u (n x X_v) / |n| + P_v (X_u x n) / |n|.
// On a plane nothing is neglected, and n' is the relief's own normal.
#ifndef RELIEVO_SHADING_BUMP_NORMAL
#define RELIEVO_SHADING_BUMP_NORMAL

#include "../surface/height_slopes.glsl"

// Unit n'. x_u and x_v are the surface's derivatives by u and v, slopes those of the bump, in one unit of length.
vec3 bump_normal(vec3 x_u, vec3 x_v, vec2 slopes) {
    vec3 n = cross(x_u, x_v);
    return normalize(n + (slopes.x * cross(n, x_v) + slopes.y * cross(x_u, n)) / length(n));
}

#endif
