// Hard self-shadow: the technique that found the hit is asked the same question from the light. No technique has a shadow
// function of its own; a technique that misses thin features misses their shadows too, which is what is to be shown.
#ifndef RELIEVO_SHADING_SELF_SHADOW
#define RELIEVO_SHADING_SELF_SHADOW

#include "../surface/chart.glsl"
#include "own_cell.glsl"
#include "../surface/ray_entry.glsl"

// 1 where the key light arrives, 0 where the relief is in its way. to_light is unit, tangent space. The light ray ends `bias` (a
// share of the relief's amplitude) above the hit, or a hit that lies a little below the field would shadow itself; what that
// costs is that the first `bias` of a shadow's foot is lit. bias 0: the technique's hits are exact, and the hit's own cell is solved for
// its second root instead (own_cell.glsl). chart: as in surface/chart.glsl; nothing beyond it casts a shadow.
float self_shadow(SurfaceRay ray, SurfaceHit hit, vec3 to_light, float bias, MarchParams params, float chart) {
    float visible = 1.0f;
    if (to_light.z <= 0.0f) {
        visible = 0.0f;  // below the plane's horizon
    } else if (hit.height + bias < 1.0f) {  // else nothing rises above the hit
        float clear = bias;
        if (bias == 0.0f) {
            // Beyond the cell's wall the neighbour begins at the ray's own height where the hit is on the wall: told apart by more than
            // the rounding of a height and of its place.
            const float rounding = 2e-5f;
            clear = climb_out_of_cell(hit, light_ray(ray, hit, to_light, 0.0f).uv_per_height);
            if (clear < 0.0f) visible = 0.0f;
            clear += rounding;
        }
        if (visible > 0.0f && hit.height + clear < 1.0f) {
            SurfaceRay light = over_chart(light_ray(ray, hit, to_light, clear), chart);
            if (light.z_start > light.z_end) {
                if (technique(light, params).found) visible = 0.0f;
            }
        }
    }
    return visible;
}

#endif
