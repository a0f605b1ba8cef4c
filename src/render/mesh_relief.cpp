#include "render/mesh_relief.h"

#include "core/parallel_for.h"
#include "techniques/shadow_bias.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relievo {

namespace glsl {
namespace {

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"  // shader headers hold functions that only other files call
#include "shading/attenuation.glsl"
#include "shading/own_cell.glsl"
#include "shading/phong.glsl"
#include "shading/shading_normal.glsl"
#include "surface/ray_entry.glsl"
#pragma GCC diagnostic pop

}  // namespace
}  // namespace glsl

namespace {

Vec3d vec(const ImageF& plane, int x, int y) {
    const float* p = plane.at(x, y);
    return {p[0], p[1], p[2]};
}

void put(ImageF& plane, int x, int y, Vec3d v) {
    plane(x, y, 0) = static_cast<float>(v.x), plane(x, y, 1) = static_cast<float>(v.y), plane(x, y, 2) = static_cast<float>(v.z);
}

Vec3d toward(const Light& light, Vec3d position) {
    return light.directional ? Vec3d(light.position) : normalize(Vec3d(light.position) - position);
}

double linear_of_srgb(std::uint8_t code) {  // IEC 61966-2-1
    const double c = code / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

const std::array<double, 256> linear = [] {
    std::array<double, 256> table{};
    for (int i = 0; i < 256; ++i) table[static_cast<std::size_t>(i)] = linear_of_srgb(static_cast<std::uint8_t>(i));
    return table;
}();

Vec3d bilinear(const Image8& image, Vec2d uv) {
    const double x = uv.x * image.width - 0.5;
    const double y = uv.y * image.height - 0.5;
    const double i = std::floor(x);
    const double j = std::floor(y);
    Vec3d sum{};
    for (int k = 0; k < 4; ++k) {
        const int di = k & 1;
        const int dj = k >> 1;
        const std::uint8_t* texel = image.at(wrap_index(static_cast<int>(i) + di, image.width), wrap_index(static_cast<int>(j) + dj, image.height));
        sum += Vec3d{linear[texel[0]], linear[texel[1]], linear[texel[2]]} * ((di ? x - i : 1 - x + i) * (dj ? y - j : 1 - y + j));
    }
    return sum;
}

Vec3d albedo_at(const std::vector<Image8>& chain, Vec2d uv, double lod) {
    const double level = std::clamp(lod + std::log2(std::max(chain[0].width, chain[0].height)), 0.0, static_cast<double>(chain.size() - 1));
    const auto fine = static_cast<std::size_t>(level);
    const double share = level - static_cast<double>(fine);
    const Vec3d a = bilinear(chain[fine], uv);
    return share > 0 ? a * (1 - share) + bilinear(chain[fine + 1], uv) * share : a;
}

glsl::SurfaceRay entering(const MeshRays& rays, int x, int y, float zero_level) {
    const float* v = rays.rays.view.at(x, y);
    glsl::SurfaceRay ray = glsl::view_ray({rays.rays.uv(x, y, 0), rays.rays.uv(x, y, 1)}, {v[0], v[1], v[2]}, rays.height_scale(x, y), zero_level, rays.rays.lod(x, y));
    ray.z_start = rays.range(x, y, 0);
    ray.z_end = rays.range(x, y, 1);
    return ray;
}

// A hit's place in the world: along the line of sight, at its height over the tangent plane.
Vec3d place_of(const MeshRays& rays, int x, int y, double height, double zero_level) {
    const double cosine = std::max(static_cast<double>(rays.rays.view(x, y, 2)), flattest_cosine);
    return vec(rays.position, x, y) + vec(rays.to_eye, x, y) * ((height - zero_level) * static_cast<double>(rays.amplitude(x, y)) / cosine);
}

// Whether the technique meets its own relief on the way to the light (shading/self_shadow.glsl, on a chart of any outline).
bool in_shadow(const MeshRays& rays, int x, int y, const glsl::SurfaceRay& ray, const glsl::SurfaceHit& hit, const Light& key, float bias,
               const Technique& technique, const MarchParams& params, const ChartShare& on_chart) {
    const PlaneLight light = light_in_plane(rays, x, y, key);
    if (light.toward.z <= 0) return true;
    glsl::SurfaceRay lit = ray;
    lit.height_scale = light.height_scale;
    lit.z_start = 1;
    float clear = bias;
    if (bias == 0) {
        constexpr float rounding = 2e-5f;
        clear = glsl::climb_out_of_cell(hit, glsl::light_ray(lit, hit, light.toward, 0.0f).uv_per_height);
        if (clear < 0) return true;
        clear += rounding;
    }
    if (hit.height + clear >= 1) return false;
    glsl::SurfaceRay toward_light = glsl::light_ray(lit, hit, light.toward, clear);
    if (on_chart) {
        const double above = 1 - static_cast<double>(hit.height);
        const Vec2d first = Vec2d(hit.uv) - Vec2d(ray.uv);
        toward_light.z_start = static_cast<float>(static_cast<double>(hit.height) + above * on_chart(x, y, first, Vec2d(toward_light.uv_per_height) * above));
    }
    return toward_light.z_start > toward_light.z_end && technique.heightfield(toward_light, params).found;
}

}  // namespace

PlaneLight light_in_plane(const MeshRays& rays, int x, int y, const Light& light) {
    const Vec3d l = toward(light, vec(rays.position, x, y));
    const double cosine = dot(l, vec(rays.normal, x, y));
    if (cosine <= 0) return {{0, 0, -1}, 0};
    const double amplitude = rays.amplitude(x, y);
    const Vec2d per_height = Vec2d{dot(l, vec(rays.along_u, x, y)), dot(l, vec(rays.along_v, x, y))} * (amplitude / std::max(cosine, flattest_cosine));
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const double speed = length(per_height);
    if (!(sine > 1e-9 && speed > 0)) return {{0, 0, 1}, rays.height_scale(x, y)};
    const Vec2d across = per_height * (sine / speed);
    return {Vec3f(Vec3d{across.x, across.y, cosine}), static_cast<float>(speed * std::max(cosine, flattest_cosine) / sine)};
}

Frame trace_mesh(const MeshRays& rays, const MapSet& maps, const Technique& technique, const MarchParams& params, const Lighting& lighting,
                 const MeshReliefSettings& settings) {
    const int width = rays.rays.width;
    const int height = rays.rays.height;
    Frame frame(width, height);
    frame.source = "cpu";
    const glsl::BoundMaps searched = declared_maps(technique, maps);
    const float bias = shadow_bias(technique, params);
    const bool shadow = settings.shadow && technique.effects.self_shadow && !lighting.lights.empty();
    parallel_for(height, 8, settings.threads, [&](int begin, int end) {
        glsl::bound_maps = searched;
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < width; ++x) {
                if (rays.rays.coverage(x, y) != static_cast<std::uint8_t>(Coverage::hit)) continue;
                const glsl::SurfaceRay ray = entering(rays, x, y, settings.zero_level);
                glsl::fetch_count = 0;
                glsl::SurfaceHit hit{};
                if (ray.z_start >= ray.z_end) hit = technique.heightfield(ray, params);
                // Techniques that shift once do not ask where the ray ends: what lies beyond the chart is not there.
                if (hit.found && settings.on_chart) {
                    const Vec2d shift = Vec2d(hit.uv) - Vec2d(ray.uv);
                    if (dot(shift, shift) > 0 && settings.on_chart(x, y, {0, 0}, shift) < 1 - 1e-4) hit.found = false;
                }
                frame.coverage(x, y) = static_cast<std::uint8_t>(hit.found ? Coverage::hit : Coverage::no_hit);
                if (!hit.found) continue;
                frame.fetches(x, y) = static_cast<float>(glsl::fetch_count);
                frame.hit_uv(x, y, 0) = hit.uv.x;
                frame.hit_uv(x, y, 1) = hit.uv.y;
                frame.hit_height(x, y) = hit.height;
                frame.shadow(x, y) = shadow && in_shadow(rays, x, y, ray, hit, lighting.lights[0], bias, technique, params, settings.on_chart) ? 0.0f : 1.0f;
            }
        }
        glsl::bound_maps = {};
    });
    return frame;
}

void shade_mesh(Frame& hits, const MeshRays& rays, const MapSet& maps, ShadedBy shaded_by, const Lighting& lighting, const MeshReliefSettings& settings) {
    const glsl::BoundMaps all{.maps = &maps, .readable = MapFlags().set()};
    // Emboss has no normals; the slopes it takes differences of are the same.
    const ShadedBy by = shaded_by == ShadedBy::emboss ? ShadedBy::height_slopes : shaded_by == ShadedBy::normal_map && maps.normal.empty() ? ShadedBy::polygon : shaded_by;
    parallel_for(hits.height, 8, settings.threads, [&](int begin, int end) {
        glsl::bound_maps = all;
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < hits.width; ++x) {
                if (hits.coverage(x, y) != static_cast<std::uint8_t>(Coverage::hit)) continue;
                const Vec2f uv{hits.hit_uv(x, y, 0), hits.hit_uv(x, y, 1)};
                const double lod = rays.rays.lod(x, y);
                const Vec3d n = vec(rays.normal, x, y);
                const Vec3d u = vec(rays.along_u, x, y);
                const Vec3d v = vec(rays.along_v, x, y);
                // The map's slopes, in UV units of a repeat, are those of the mesh along its own gradients of u and v.
                const Vec3d texel(glsl::shading_normal(static_cast<int>(by), uv, static_cast<float>(lod), settings.material_scale));
                const double slopes = static_cast<double>(rays.amplitude(x, y)) / (static_cast<double>(settings.material_scale) * std::max(texel.z, 1e-3));
                const Vec3d normal = normalize(n + u * (texel.x * slopes) + v * (texel.y * slopes));
                put(hits.normal, x, y, normal);

                const Vec3d to_eye = vec(rays.to_eye, x, y);
                const Vec3d position = place_of(rays, x, y, static_cast<double>(hits.hit_height(x, y)), static_cast<double>(settings.zero_level));
                const Vec3f albedo(albedo_at(maps.colour, Vec2d(uv), lod));
                Vec3d colour = Vec3d(lighting.ambient) * Vec3d(albedo);
                for (std::size_t k = 0; k < lighting.lights.size(); ++k) {
                    const Light& light = lighting.lights[k];
                    const Vec3d l = toward(light, position);
                    // A face turned away from a light lies in the mesh's own shadow, however its relief is tilted.
                    double arrives = dot(l, n) > 0 ? (k == 0 ? static_cast<double>(hits.shadow(x, y)) : 1.0) : 0.0;
                    if (!light.directional)
                        arrives *= static_cast<double>(glsl::attenuation(light.constant, light.linear, light.quadratic, static_cast<float>(length(Vec3d(light.position) - position))));
                    if (arrives == 0) continue;
                    colour += Vec3d(light.colour) * Vec3d(glsl::phong(albedo, lighting.specular, lighting.shininess, Vec3f(normal), Vec3f(to_eye), Vec3f(l))) * arrives;
                }
                put(hits.colour, x, y, colour);
            }
        }
        glsl::bound_maps = {};
    });
}

}  // namespace relievo
