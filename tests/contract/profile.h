// Fields that vary along u alone and are straight between a few kinks, so that every crossing of a ray is known in closed form.
#pragma once

#include "core/height_field.h"
#include "techniques/glsl.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace relievo::contract {

// A stretch of a descending ray inside the solid, as heights of the ray.
struct Solid {
    double enter;
    double leave;
};

struct Profile {
    static constexpr int texels = 64;

    std::string name;
    // (texel, height), texels whole and increasing within one repeat; at least one.
    std::vector<Vec2d> kinks;
    // Rays are asked about only while they stay between these texels.
    double first = -1e9;
    double last = 1e9;

    // x in units of texel centres.
    double height(double x) const {
        const double period = texels;
        const double in_period = x - period * std::floor((x - kinks.front().x) / period);
        for (std::size_t i = 0; i < kinks.size(); ++i) {
            const Vec2d a = kinks[i];
            const Vec2d b = i + 1 < kinks.size() ? kinks[i + 1] : Vec2d{kinks[0].x + period, kinks[0].y};
            if (in_period <= b.x) return a.y + (b.y - a.y) * (in_period - a.x) / (b.x - a.x);
        }
        return kinks.front().y;
    }

    HeightField field() const {
        HeightField f(texels, 8);
        for (int j = 0; j < f.height(); ++j)
            for (int i = 0; i < texels; ++i) f.texels(i, j) = static_cast<float>(height(i));
        return f;
    }

    static double x_at(const glsl::SurfaceRay& ray, double z) {
        return (ray.uv.x + (z - static_cast<double>(ray.zero_level)) * static_cast<double>(ray.uv_per_height.x)) * texels - 0.5;
    }

    bool contains(const glsl::SurfaceRay& ray) const {
        const auto [low, high] = std::minmax({x_at(ray, ray.z_start), x_at(ray, ray.z_end)});
        return low >= first && high <= last;
    }

    // Ray's height over the field, negative inside.
    double gap(const glsl::SurfaceRay& ray, double z) const { return z - height(x_at(ray, z)); }

    // Every stretch of the ray inside the solid, from the top down. Between two kinks the gap is linear in z.
    std::vector<Solid> solids(const glsl::SurfaceRay& ray) const {
        std::vector<double> stops{ray.z_start, ray.z_end};
        const double speed = static_cast<double>(ray.uv_per_height.x) * texels;
        if (speed != 0) {
            const auto [low, high] = std::minmax({x_at(ray, ray.z_start), x_at(ray, ray.z_end)});
            for (const Vec2d& kink : kinks)
                for (double x = kink.x + texels * std::ceil((low - kink.x) / texels); x <= high; x += texels)
                    stops.push_back(std::clamp(ray.z_start + (x - x_at(ray, ray.z_start)) / speed, static_cast<double>(ray.z_end),
                                               static_cast<double>(ray.z_start)));
        }
        std::ranges::sort(stops, std::greater{});
        std::vector<Solid> found;
        bool inside = false;
        for (std::size_t i = 0; i < stops.size(); ++i) {
            const double here = gap(ray, stops[i]);
            if (i > 0 && inside != (here <= 0)) {
                const double before = gap(ray, stops[i - 1]);
                const double z = before == here ? stops[i] : stops[i - 1] + (stops[i] - stops[i - 1]) * before / (before - here);
                if (inside) {
                    found.back().leave = z;
                } else {
                    found.push_back({z, ray.z_end});
                }
                inside = !inside;
            } else if (i == 0 && here <= 0) {
                found.push_back({stops[i], ray.z_end});
                inside = true;
            }
        }
        return found;
    }
};

}  // namespace relievo::contract
