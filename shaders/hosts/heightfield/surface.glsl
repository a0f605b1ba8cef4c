// The surface a technique found under a pixel, and the light it sends to the eye (core/lighting.h).
#include "../../shading/attenuation.glsl"
#include "../../shading/blinn_phong.glsl"
#include "../../shading/edge_blend.glsl"
#include "../../shading/emboss.glsl"
#include "../../shading/facets.glsl"
#include "../../shading/ggx.glsl"
#include "../../shading/key_shadow.glsl"
#include "../../shading/phong.glsl"
#include "../../shading/shading_normal.glsl"
#include "../../surface/hit_footprint.glsl"
#include "../../surface/modified_ray.glsl"
#include "maps.glsl"
#include "pixel.glsl"
#include "projection.glsl"

layout(constant_id = 0) const int shadow_mode = shadow_hard;  // none where rays were asked for and the technique cannot trace them
layout(constant_id = 1) const int shaded_by = shaded_by_normal_map;  // Technique::shaded_by
// Known when the pipeline is made, so that the loop over a few lights is unrolled and their fields are plain constants of the draw:
// shading a textured quad with two lights on the software device took 47 ms of CPU time with a bound read from a buffer.
layout(constant_id = 2) const int light_count = 1;

// The other modifiers, in the order of techniques/modifiers.h.
layout(constant_id = 3) const int edge_mode = edge_none;
layout(constant_id = 4) const int steps_mode = steps_fixed;
layout(constant_id = 5) const int scale_mode = scale_fixed;
layout(constant_id = 6) const int border_mode = border_repeat;
layout(constant_id = 7) const int fade_mode = fade_none;
layout(constant_id = 8) const int mip_mode = mip_polygon;
layout(constant_id = 9) const int shading_mode = shading_phong;
layout(constant_id = 10) const int sheet_mode = sheet_none;

DrawModes draw_modes() {
    return DrawModes(shadow_mode, edge_mode, steps_mode, scale_mode, border_mode, fade_mode, mip_mode, shading_mode,
                     sheet_mode);
}

// Call it in uniform flow.
SurfaceRay pixel_ray() {
    return modified_ray(view_ray(base_uv, pixel_view(), relief.height_scale, relief.zero_level, pixel_lod()), draw_modes(), numbers);
}

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
        visible = key_shadow(ray, hit, to_light(first_lights[0], surface_position(ray, hit)), relief.shadow_bias, march, draw_modes(),
                             numbers);
    return visible;
}

// The ray with the level at which the surface is to be read.
SurfaceRay shading_ray(SurfaceRay ray, SurfaceHit hit) {
    SurfaceRay shaded = ray;
    if (mip_mode == mip_finest) {
        shaded.lod = -64.0f;
    } else if (mip_mode == mip_hit) {
        vec3 eye = vec3(scene.eye_x, scene.eye_y, scene.eye_z);
        float pixel_angle = exp2(ray.lod) * ray.view.z / length(eye - base_position);
        shaded.lod = hit_lod(ray.view, surface_normal(ray, hit), pixel_angle, length(eye - surface_position(ray, hit)));
    }
    return shaded;
}

// Light that all lights send to the eye from the surface at uv; `visible`: share of the key light.
vec3 lit(SurfaceRay ray, vec2 uv, vec3 albedo, float specular, vec3 normal, vec3 position, float visible) {
    vec3 view = ray.view;
    vec3 result = vec3(scene.ambient_r, scene.ambient_g, scene.ambient_b) * albedo;
    for (int i = 0; i < light_count; ++i) {
        LightUniforms light = light_at(i);
        float arrives = i == 0 ? visible : 1.0f;
        if (light.directional == 0)
            arrives *= attenuation(light.constant, light.linear, light.quadratic,
                                   length(vec3(light.x, light.y, light.z) - position));
        vec3 toward = to_light(light, position);
        vec3 reflected;
        if (shaded_by == shaded_by_emboss) {
            reflected = albedo * emboss_diffuse(uv, ray.lod, ray.height_scale, toward);
        } else if (shading_mode == shading_ggx) {
            reflected = ggx(albedo, numbers.roughness, numbers.metallic, normal, view, toward);
        } else if (shading_mode == shading_blinn_phong) {
            reflected = blinn_phong(albedo, specular, scene.shininess, normal, view, toward);
        } else {
            reflected = phong(albedo, specular, scene.shininess, normal, view, toward);
        }
        result += arrives * vec3(light.r, light.g, light.b) * reflected;
    }
    return result;
}

// Light at the four corners of a hit's cell, blended between: what a mesh of that grid would show. Corners are seen from where the
// pixel is: a cell is small.
vec3 gouraud_colour(SurfaceRay ray, SurfaceHit hit, vec3 albedo, float visible) {
    float facets = float(numbers.facets);
    vec2 corner = facet_corner(hit.uv, facets);
    vec2 inside = facet_inside(hit.uv, facets);
    vec3 diffuse = vec3(0.0f);
    vec3 highlight = vec3(0.0f);
    for (int k = 0; k < 4; ++k) {
        vec2 place = vec2(float(k & 1), float(k >> 1));
        SurfaceHit vertex;
        vertex.uv = corner + place * (1.0f / facets);
        vertex.height = height_at(vertex.uv);
        vertex.found = true;
        vec3 normal = surface_normal(ray, vertex);
        vec3 position = surface_position(ray, vertex);
        float share = (place.x > 0.5f ? inside.x : 1.0f - inside.x) * (place.y > 0.5f ? inside.y : 1.0f - inside.y);
        diffuse += share * lit(ray, vertex.uv, vec3(1.0f), 0.0f, normal, position, visible);
        highlight += share * lit(ray, vertex.uv, vec3(0.0f), scene.specular, normal, position, visible);
    }
    return albedo * diffuse + highlight;
}

vec3 surface_colour(SurfaceRay ray, SurfaceHit hit) {
    SurfaceRay shaded = shading_ray(ray, hit);
    vec3 albedo = colour_at(hit.uv, shaded.lod);
    float visible = key_visibility(ray, hit);
    vec3 result;
    if (shading_mode == shading_gouraud) {
        result = gouraud_colour(shaded, hit, albedo, visible);
    } else {
        vec3 normal = shading_mode == shading_flat ? facet_normal(hit.uv, float(numbers.facets), ray.height_scale) : surface_normal(shaded, hit);
        result = lit(shaded, hit.uv, albedo, scene.specular, normal, surface_position(ray, hit), visible);
    }
    return result;
}
