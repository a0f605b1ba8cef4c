#include "reference/mesh_hits.h"

#include "core/parallel_for.h"
#include "reference/cast.h"

#include <algorithm>
#include <cmath>

namespace relievo {

namespace {

Vec3d vec(const ImageF& plane, int x, int y) {
    const float* p = plane.at(x, y);
    return {p[0], p[1], p[2]};
}

// Whether the relief hides a hit from the light: the same straight line as on a flat base, once the light's direction is written in UV
// and heights of the pixel's plane.
bool hidden(const MeshRays& rays, int x, int y, const HeightField& field, const ReferenceHit& hit, const Light& key, const MeshHitSettings& s) {
    const Vec3d l = key.directional ? Vec3d(key.position) : normalize(Vec3d(key.position) - vec(rays.position, x, y));
    const double cosine = dot(l, vec(rays.normal, x, y));
    if (cosine <= 0) return true;
    const Vec2d per_height = Vec2d{dot(l, vec(rays.along_u, x, y)), dot(l, vec(rays.along_v, x, y))} *
                             (static_cast<double>(rays.amplitude(x, y)) / std::max(cosine, flattest_cosine));
    double highest = 1;
    if (s.on_chart) {
        const Vec2d polygon{rays.rays.uv(x, y, 0), rays.rays.uv(x, y, 1)};
        highest = hit.height + (1 - hit.height) * s.on_chart(x, y, hit.uv - polygon, per_height * (1 - hit.height));
    }
    // A direction of slope 1 whose height_scale is the speed.
    const double speed = length(per_height);
    if (!(speed > 0)) return false;
    return reference_shadow(field, hit, Vec3d{per_height.x / speed, per_height.y / speed, 1}, speed, highest);
}

}  // namespace

Frame reference_mesh_hits(const MeshRays& rays, const HeightField& field, const Lighting& lighting, const MeshHitSettings& s) {
    const int width = rays.rays.width;
    const int height = rays.rays.height;
    Frame frame(width, height);
    frame.source = "reference";
    parallel_for(height, 4, s.threads, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < width; ++x) {
                if (rays.rays.coverage(x, y) != static_cast<std::uint8_t>(Coverage::hit)) continue;
                const Vec3d view = vec(rays.rays.view, x, y);
                const ReferenceRay ray{.uv = {rays.rays.uv(x, y, 0), rays.rays.uv(x, y, 1)},
                                       .uv_per_height = Vec2d{view.x, view.y} * (static_cast<double>(rays.height_scale(x, y)) / std::max(view.z, flattest_cosine)),
                                       .zero_level = s.zero_level,
                                       .z_start = rays.range(x, y, 0),
                                       .z_end = rays.range(x, y, 1)};
                ReferenceHit hit;
                if (ray.z_start >= ray.z_end) hit = reference_cast(field, ray);
                frame.coverage(x, y) = static_cast<std::uint8_t>(hit.found ? Coverage::hit : Coverage::no_hit);
                if (!hit.found) continue;
                frame.hit_uv(x, y, 0) = static_cast<float>(hit.uv.x);
                frame.hit_uv(x, y, 1) = static_cast<float>(hit.uv.y);
                frame.hit_height(x, y) = static_cast<float>(hit.height);
                frame.shadow(x, y) = s.shadow && !lighting.lights.empty() && hidden(rays, x, y, field, hit, lighting.lights[0], s) ? 0.0f : 1.0f;
            }
        }
    });
    return frame;
}

}  // namespace relievo
