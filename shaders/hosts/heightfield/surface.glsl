// The surface a technique found under a pixel, and the light it sends to the eye (core/lighting.h).
#include "../../shading/attenuation.glsl"
#include "../../shading/emboss.glsl"
#include "../../shading/key_shadow.glsl"
#include "../../shading/phong.glsl"
#include "../../shading/shading_normal.glsl"
#include "maps.glsl"
#include "pixel.glsl"

layout(constant_id = 0) const int shadow_mode = shadow_hard;  // none where rays were asked for and the technique cannot trace them
layout(constant_id = 1) const int shaded_by = shaded_by_normal_map;  // Technique::shaded_by
// Known when the pipeline is made, so that the loop over a few lights is unrolled and their fields are plain constants of the draw:
// shading a textured quad with two lights on the software device took 47 ms of CPU time with a bound read from a buffer.
layout(constant_id = 2) const int light_count = 1;

vec3 surface_normal(SurfaceRay ray, SurfaceHit hit) {
    return shading_normal(shaded_by, hit.uv, ray.lod, ray.height_scale);
}

// World position of a hit: one world unit is one repeat of the texture, and the base's centre is the origin.
vec3 surface_position(SurfaceRay ray, SurfaceHit hit) {
    return vec3(hit.uv - vec2(0.5f * scene.periods), (hit.height - ray.zero_level) * ray.height_scale);
}

vec3 to_light(LightUniforms light, vec3 position) {
    vec3 place = vec3(light.x, light.y, light.z);
    return light.directional != 0 ? place : normalize(place - position);
}

// Share of the key light, the first, that arrives.
float key_visibility(SurfaceRay ray, SurfaceHit hit) {
    float visible = 1.0f;
    if (light_count > 0)
        visible = key_shadow(ray, hit, to_light(first_lights[0], surface_position(ray, hit)), relief.shadow_bias, march, shadow_mode,
                             numbers);
    return visible;
}

vec3 surface_colour(SurfaceRay ray, SurfaceHit hit) {
    vec3 albedo = colour_at(hit.uv, ray.lod);
    vec3 normal = surface_normal(ray, hit);
    vec3 position = surface_position(ray, hit);
    float visible = key_visibility(ray, hit);
    vec3 result = vec3(scene.ambient_r, scene.ambient_g, scene.ambient_b) * albedo;
    for (int i = 0; i < light_count; ++i) {
        LightUniforms light = light_at(i);
        float arrives = i == 0 ? visible : 1.0f;
        if (light.directional == 0)
            arrives *= attenuation(light.constant, light.linear, light.quadratic,
                                   length(vec3(light.x, light.y, light.z) - position));
        vec3 l = to_light(light, position);
        vec3 reflected = shaded_by == shaded_by_emboss ? albedo * emboss_diffuse(hit.uv, ray.lod, ray.height_scale, l)
                                                       : phong(albedo, scene.specular, scene.shininess, normal, ray.view, l);
        result += arrives * vec3(light.r, light.g, light.b) * reflected;
    }
    return result;
}
