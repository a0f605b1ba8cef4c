// Distance mapping (Donnelly 2005): sphere tracing in a 3D map of distances to the relief. Nothing is nearer than the map says, so the
// ray leaps that far; through the empty part of the slab a few leaps do. The map's distances are rounded down and end about half a
// voxel above the surface, so there the heights are asked, in steps of half a texel, or of an equal share of what is left of the way
// where that is more, so that the last step arrives; bisection closes the step that went below. At most two fetches a step and one a
// refinement. Steps that were leapt over make the others shorter, so less is stepped over than by as many equal steps.
// Beside walls, and at grazing views, the leaps are short all the way down: then it is a linear search that fetches twice.
#include "../../surface/maps.glsl"
#include "../../surface/ray_entry.glsl"

SurfaceHit distance_mapping(SurfaceRay ray, MarchParams params) {
    ivec2 size = height_size();
    float cells = max(abs(ray.uv_per_height.x) * float(size.x), abs(ray.uv_per_height.y) * float(size.y));  // per unit of descent
    float half_texel = min(0.5f / max(cells, 1e-6f), (ray.z_start - ray.z_end) / float(params.max_steps));
    float descent = max(ray.view.z, min_view_z);  // of a unit of the ray, in heights and in the map's metric
    SurfaceHit hit;
    hit.found = false;
    float above = ray.z_start;
    float below = ray.z_end;
    float z = ray.z_start;
    for (int i = 0; i < params.max_steps && z > ray.z_end && !hit.found; ++i) {
        vec2 uv = uv_at(ray, z);
        float leap = distance_at(vec3(uv, z)) * descent;
        float shortest = max((z - ray.z_end) / float(params.max_steps - i), half_texel);
        if (leap < shortest) {
            leap = shortest;
            if (height_at(uv) >= z) hit.found = true;
        }
        if (hit.found) {
            below = z;
        } else {
            above = z;
            z -= leap;
        }
    }
    // Every field is at least 0. A shadow ray ends at the point that asks, which does not shadow itself.
    if (!hit.found && ray.z_end <= 0.0f) hit.found = true;
    if (hit.found) {
        for (int i = 0; i < params.refine_steps; ++i) {
            float middle = 0.5f * (above + below);
            if (height_at(uv_at(ray, middle)) >= middle) {
                below = middle;
            } else {
                above = middle;
            }
        }
    }
    hit.height = below;
    hit.uv = uv_at(ray, below);
    return hit;
}
