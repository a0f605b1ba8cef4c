#include "render/cpu_renderer.h"

#include "techniques/shadow_bias.h"

#include "core/parallel_for.h"

namespace relievo {

namespace glsl {
namespace {

// What the shading text calls `technique`, for the calling thread.
thread_local HeightFieldFunction technique = nullptr;

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"  // shader headers hold functions that only other files call
#include "shading/key_shadow.glsl"
#include "surface/modified_ray.glsl"
#include "shading/shading_normal.glsl"
#pragma GCC diagnostic pop

}  // namespace
}  // namespace glsl

namespace {

Vec3f to_light(const Light& light, Vec3f position) {
    return light.directional ? light.position : normalize(light.position - position);
}

}  // namespace

Frame cpu_trace(const RayField& rays, const MapSet& maps, float height_scale, float zero_level, const Lighting& lighting,
                const Technique& technique, const MarchParams& params, const DrawOptions& options, int threads) {
    Frame frame(rays.width, rays.height);
    frame.source = "cpu";
    const glsl::BoundMaps searched = declared_maps(technique, maps);
    const glsl::BoundMaps all{.maps = &maps, .readable = MapFlags().set()};
    glsl::DrawModes modes = options;
    modes.shadow = lighting.lights.empty() ? glsl::shadow_none : shadow_of(technique, options);
    const float bias = shadow_bias(technique, params);
    // A device finds one level texel where there is no normal map.
    const bool lacks_normals = technique.shaded_by == ShadedBy::normal_map && maps.normal.empty();
    const int shaded_by = static_cast<int>(lacks_normals ? ShadedBy::polygon : technique.shaded_by);
    parallel_for(rays.height, 8, threads, [&](int begin, int end) {
        glsl::technique = technique.heightfield;
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < rays.width; ++x) {
                if (rays.coverage(x, y) != static_cast<std::uint8_t>(Coverage::hit)) continue;
                const float* uv = rays.uv.at(x, y);
                const float* view = rays.view.at(x, y);
                glsl::bound_maps = searched;
                glsl::fetch_count = 0;
                const auto ray = glsl::modified_ray(
                    glsl::view_ray({uv[0], uv[1]}, {view[0], view[1], view[2]}, height_scale, zero_level, rays.lod(x, y)), modes,
                    options.numbers);
                const auto hit = glsl::modified_search(ray, glsl::modified_march(params, ray, modes, options.numbers), modes, options.numbers);
                frame.coverage(x, y) = static_cast<std::uint8_t>(hit.found ? Coverage::hit : Coverage::no_hit);
                if (!hit.found) continue;
                frame.fetches(x, y) = static_cast<float>(glsl::fetch_count);
                frame.hit_uv(x, y, 0) = hit.uv.x;
                frame.hit_uv(x, y, 1) = hit.uv.y;
                frame.hit_height(x, y) = hit.height;

                const Vec3f position(hit.uv, (hit.height - zero_level) * height_scale);
                // Ways of the technique's own see its maps and no others.
                if (!traces_shadow(modes.shadow)) glsl::bound_maps = all;
                if (modes.shadow != glsl::shadow_none)
                    frame.shadow(x, y) = glsl::key_shadow(ray, hit, to_light(lighting.lights[0], position), bias, params, modes,
                                                          options.numbers);
                else
                    frame.shadow(x, y) = 1.0f;

                glsl::bound_maps = all;
                const Vec3f normal = glsl::shading_normal(shaded_by, hit.uv, ray.lod, ray.height_scale);
                frame.normal(x, y, 0) = normal.x;
                frame.normal(x, y, 1) = normal.y;
                frame.normal(x, y, 2) = normal.z;
            }
        }
        // Leaves nothing bound that may not outlive this call.
        glsl::bound_maps = {};
        glsl::technique = nullptr;
    });
    return frame;
}

}  // namespace relievo
