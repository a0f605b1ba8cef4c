// From a shaded point of a base polygon to the ray a technique searches, for the eye and for a light.
#ifndef RELIEVO_SURFACE_RAY_ENTRY
#define RELIEVO_SURFACE_RAY_ENTRY

// The steepest grazing ray that is followed: below this cosine the UV speed would overflow what a float can address.
// 0.0005 is 0.03 degrees above the plane.
const float min_view_z = 0.0005f;

SurfaceRay view_ray(vec2 uv, vec3 view, float height_scale, float zero_level, float lod) {
    SurfaceRay ray;
    ray.uv = uv;
    ray.view = view;
    ray.uv_per_height = vec2(view.x, view.y) * (height_scale / max(view.z, min_view_z));
    ray.height_scale = height_scale;
    ray.zero_level = zero_level;
    ray.z_start = 1.0f;
    ray.z_end = 0.0f;
    ray.lod = lod;
    return ray;
}

vec2 uv_at(SurfaceRay ray, float z) {
    return ray.uv + (z - ray.zero_level) * ray.uv_per_height;
}

// The ray that comes down from the light and ends `bias` above the hit: whatever it meets shadows the hit. A light at or below
// the plane's horizon must be handled by the caller (its ray never enters the slab). A hit within `bias` of the top leaves a ray
// of no length above every field: cut off at 1 instead, it would end in the hit itself and find every plateau in shadow.
SurfaceRay light_ray(SurfaceRay ray, SurfaceHit hit, vec3 to_light, float bias) {
    SurfaceRay r = ray;
    r.view = to_light;
    r.uv_per_height = vec2(to_light.x, to_light.y) * (ray.height_scale / max(to_light.z, min_view_z));
    r.uv = hit.uv + (ray.zero_level - hit.height) * r.uv_per_height;
    r.z_end = hit.height + bias;
    r.z_start = max(1.0f, r.z_end);
    return r;
}

#endif
