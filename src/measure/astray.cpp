#include "measure/astray.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace relievo {

namespace {

// Heights of the ray that float explains: its own steps in z, and those of a texture coordinate of about 1 over the ray's speed.
double rounding_of(double uv_per_height) { return 3e-5 + 2e-7 / std::max(uv_per_height, 1e-4); }

}  // namespace

bool is_astray(const AstrayRay& ray, double z, const Promise& promise) {
    assert(!ray.solids.empty());
    const double texels = promise.texels > 0 ? promise.texels / std::max(ray.texels_per_height, 1e-9) : 0;
    const double error = promise.error + texels + ray.rounding;
    const double stride = promise.stride + texels + ray.rounding;
    for (const Solid& s : ray.solids) {
        if (std::abs(z - static_cast<double>(s.enter)) <= error) return false;
        if (static_cast<double>(s.enter) - static_cast<double>(s.leave) > stride) break;
    }
    const double first = ray.solids.front().enter;
    const double polygon = std::abs(ray.zero_level - first);
    double allowed = promise.unmoved * polygon + promise.relief * (ray.highest - ray.lowest);
    if (promise.polygon) allowed = std::max(allowed, polygon);
    return std::abs(z - first) > allowed + ray.rounding;
}

Measured<double> astray_share(const Frame& picture, const RayField& rays, const RaySolids& truth, const AstraySettings& settings) {
    assert(picture.width == rays.width && picture.height == rays.height);
    assert(truth.rays.size() == static_cast<std::size_t>(rays.width) * static_cast<std::size_t>(rays.height));
    const Vec2d size{static_cast<double>(settings.texels.x), static_cast<double>(settings.texels.y)};
    struct Count {
        long long judged = 0, astray = 0;
    };
    std::vector<Count> rows(static_cast<std::size_t>(rays.height));
    parallel_for(rays.height, 16, settings.threads, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            Count& row = rows[static_cast<std::size_t>(y)];
            for (int x = 0; x < rays.width; ++x) {
                const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(rays.width) + static_cast<std::size_t>(x);
                if (truth.rays[i].count == 0) continue;
                ++row.judged;
                if (picture.coverage(x, y) != static_cast<std::uint8_t>(Coverage::hit)) {
                    ++row.astray;
                    continue;
                }
                const float* v = rays.view.at(x, y);
                const Vec3d view = normalize(Vec3d{v[0], v[1], v[2]});
                const Vec2d speed = Vec2d{view.x, view.y} * (settings.height_scale / std::max(view.z, flattest_cosine));
                const Vec2d shift{static_cast<double>(picture.hit_uv(x, y, 0)) - static_cast<double>(rays.uv(x, y, 0)),
                                  static_cast<double>(picture.hit_uv(x, y, 1)) - static_cast<double>(rays.uv(x, y, 1))};
                // The height at which the ray stands over the hit's place: what a technique calls its height may be another. A ray
                // that hardly moves is over it at any height.
                const double squared = dot(speed, speed);
                const double z = squared > 1e-12 ? settings.zero_level + dot(shift, speed) / squared
                                                 : static_cast<double>(picture.hit_height(x, y));
                const AstrayRay ray{.solids = truth.of(i),
                                    .lowest = truth.rays[i].lowest,
                                    .highest = truth.rays[i].highest,
                                    .zero_level = settings.zero_level,
                                    .texels_per_height = length(speed * size),
                                    .rounding = rounding_of(length(speed))};
                row.astray += is_astray(ray, z, settings.promise(view.z)) ? 1 : 0;
            }
        }
    });
    Count all;
    for (const Count& row : rows) all.judged += row.judged, all.astray += row.astray;
    if (all.judged == 0) return Measured<double>::missing("no ray of the picture meets the surface");
    return static_cast<double>(all.astray) / static_cast<double>(all.judged);
}

}  // namespace relievo
