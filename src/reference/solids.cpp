#include "reference/solids.h"

#include "core/parallel_for.h"
#include "reference/cell_walk.h"

#include <array>

namespace relievo {

namespace {

// Where the gap is 0 strictly between 0 and limit, in order; at most two. The stable form, as in cast.cpp's first_contact.
int roots_inside(const CellGap& g, double limit, std::array<double, 2>& roots) {
    int count = 0;
    const auto keep = [&](double s) {
        if (s > 0 && s < limit) roots[static_cast<std::size_t>(count++)] = s;  // false for NaN
    };
    const double discriminant = g.slope * g.slope - 4 * g.bend * g.gap;
    if (!(discriminant >= 0)) return 0;
    const double q = -0.5 * (g.slope + std::copysign(std::sqrt(discriminant), g.slope));
    if (q != 0) keep(g.gap / q);
    if (g.bend != 0) keep(q / g.bend);
    if (count == 2 && roots[0] > roots[1]) std::swap(roots[0], roots[1]);
    return count;
}

// Heights of the surface over a part of a cell, as bounds: the line's height at either end and at the gap's extreme.
void widen(RaySolids::Ray& summary, const CellGap& g, double z, double from, double to) {
    const auto put = [&](double s) {
        const auto h = static_cast<float>(g.at(s) + z - s);
        summary.lowest = std::min(summary.lowest, h);
        summary.highest = std::max(summary.highest, h);
    };
    put(from);
    put(to);
    // The surface's own height is gap + line, whose slope is the gap's less the descent's.
    const double vertex = -(g.slope - 1) / (2 * g.bend);
    if (vertex > from && vertex < to) put(vertex);
}

}  // namespace

void append_solids(RaySolids& all, const HeightField& field, const ReferenceRay& ray) {
    assert(!field.empty() && ray.z_start >= ray.z_end);
    const Vec2d size{static_cast<double>(field.width()), static_cast<double>(field.height())};
    const Vec2d start = (ray.uv + (ray.z_start - ray.zero_level) * ray.uv_per_height) * size - Vec2d{0.5, 0.5};
    const double end = ray.z_start - ray.z_end;
    RaySolids::Ray summary{.first = all.solids.size(), .count = 0, .lowest = 2, .highest = -1};

    // t is the descent since z_start.
    CellWalk walk(field, start, -(ray.uv_per_height * size));
    bool inside = false;
    for (;; walk.advance()) {
        const double entered = walk.entered();
        const double leave = std::min(walk.leaves(), end);
        const double limit = leave - entered;
        if (!inside && ray.z_start - leave > walk.highest_corner()) {
            // above all of the cell
        } else if (limit > 0) {
            const CellGap g = walk.gap(ray.z_start - entered, -1);
            std::array<double, 4> cuts{};
            std::array<double, 2> roots{};
            int count = 1;
            for (int i = 0; i < roots_inside(g, limit, roots); ++i) cuts[static_cast<std::size_t>(count++)] = roots[static_cast<std::size_t>(i)];
            cuts[static_cast<std::size_t>(count)] = limit;
            for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
                const bool solid = g.at(0.5 * (cuts[i] + cuts[i + 1])) >= 0;
                const auto z = static_cast<float>(ray.z_start - entered - cuts[i]);
                if (solid && !inside) all.solids.push_back({z, static_cast<float>(ray.z_end)});
                if (!solid && inside) all.solids.back().leave = z;
                inside = solid;
            }
        }
        if (walk.leaves() >= end) break;
    }
    // Nothing is lower than height 0: a ray that arrives there is on the floor, a solid without thickness.
    if (!inside && ray.z_end <= 0) all.solids.push_back({static_cast<float>(ray.z_end), static_cast<float>(ray.z_end)});
    summary.count = all.solids.size() - summary.first;

    // The way between polygon and surface, once more: it is short, and where it ends was not known before.
    if (summary.count > 0) {
        const double first = all.solids[summary.first].enter;
        const double top = std::max(first, ray.zero_level);
        const double way = top - std::min(first, ray.zero_level);
        const Vec2d from = (ray.uv + (top - ray.zero_level) * ray.uv_per_height) * size - Vec2d{0.5, 0.5};
        for (CellWalk between(field, from, -(ray.uv_per_height * size));; between.advance()) {
            const double z = top - between.entered();
            widen(summary, between.gap(z, -1), z, 0, std::max(0.0, std::min(between.leaves(), way) - between.entered()));
            if (between.leaves() >= way) break;
        }
    }
    all.rays.push_back(summary);
}

RaySolids reference_solids(const RayField& rays, const HeightField& field, const SolidSettings& settings, const Progress& progress) {
    std::vector<RaySolids> rows(static_cast<std::size_t>(rays.height));
    parallel_for(rays.height, 4, settings.threads, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            RaySolids& row = rows[static_cast<std::size_t>(y)];
            for (int x = 0; x < rays.width; ++x) {
                if (rays.coverage(x, y) != static_cast<std::uint8_t>(Coverage::hit)) {
                    row.rays.push_back({.first = row.solids.size()});
                    continue;
                }
                const float* v = rays.view.at(x, y);
                const Vec3d view = normalize(Vec3d{v[0], v[1], v[2]});
                append_solids(row, field,
                              {.uv = {rays.uv(x, y, 0), rays.uv(x, y, 1)},
                               .uv_per_height = Vec2d{view.x, view.y} * (settings.height_scale / std::max(view.z, flattest_cosine)),
                               .zero_level = settings.zero_level});
            }
        }
    }, progress, "following rays");
    RaySolids all;
    for (const RaySolids& row : rows) {
        for (RaySolids::Ray ray : row.rays) {
            ray.first += all.solids.size();
            all.rays.push_back(ray);
        }
        all.solids.insert(all.solids.end(), row.solids.begin(), row.solids.end());
    }
    return all;
}

}  // namespace relievo
