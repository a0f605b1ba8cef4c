#include "fur/shell_texture.h"

#include "core/parallel_for.h"
#include "fur/facing.h"
#include "fur/strand_albedo.h"
#include "fur/strand_grid.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace relievo {

namespace {

double fraction(double x) { return x - std::floor(x); }

std::uint8_t encoded(double linear) {
    const double v = std::clamp(linear, 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(255 * (v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1 / 2.4) - 0.055)));
}

// Roots by the cells of a hash table, each as wide as they are looked for.
class RootTable {
public:
    RootTable(const Roots& roots, double reach) : roots_(roots), per_unit_(1 / reach) {
        while (mask_ + 1 < roots.roots.size()) mask_ = mask_ * 2 + 1;
        first_.assign(mask_ + 2, 0);
        std::vector<std::uint32_t> bucket;
        for (const Root& r : roots.roots) {
            bucket.push_back(bucket_of(cell(Vec3d(r.position))));
            ++first_[bucket.back() + 1];
        }
        std::partial_sum(first_.begin(), first_.end(), first_.begin());
        std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
        order_.resize(roots.roots.size());
        for (std::uint32_t i = 0; i < order_.size(); ++i) order_[next[bucket[i]]++] = i;
    }
    template <class Visit>
    void each_near(Vec3d p, const Visit& visit) const {
        const Cell c = cell(p);
        // Two cells along each axis are enough: the nearer neighbour of each.
        std::array<std::uint32_t, 8> seen;
        std::size_t count = 0;
        for (int k = 0; k < 8; ++k) {
            const auto side = [&](double v, int bit) { return (k >> bit & 1) ? (fraction(v * per_unit_) < 0.5 ? -1 : 1) : 0; };
            const std::uint32_t b = bucket_of({c.x + side(p.x, 0), c.y + side(p.y, 1), c.z + side(p.z, 2)});
            if (std::find(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(count), b) != seen.begin() + static_cast<std::ptrdiff_t>(count)) continue;
            seen[count++] = b;
            for (std::uint32_t i = first_[b]; i < first_[b + 1]; ++i) visit(order_[i]);
        }
    }

private:
    struct Cell {
        std::int64_t x, y, z;
    };
    Cell cell(Vec3d p) const {
        const auto at = [&](double v) { return static_cast<std::int64_t>(std::floor(v * per_unit_)); };
        return {at(p.x), at(p.y), at(p.z)};
    }
    std::uint32_t bucket_of(Cell c) const {
        return (static_cast<std::uint32_t>(c.x) * 73856093u ^ static_cast<std::uint32_t>(c.y) * 19349663u ^ static_cast<std::uint32_t>(c.z) * 83492791u) & mask_;
    }
    const Roots& roots_;
    double per_unit_;
    std::uint32_t mask_ = 1;
    std::vector<std::uint32_t> first_, order_;
};

struct Owner {
    std::uint32_t face = 0xffffffffu;
    float away = std::numeric_limits<float>::infinity();  // from the face, in texels; 0 inside
};

}  // namespace

ShellTexture shell_texture(const ChartAtlas& atlas, const Mesh& mesh, const Roots& roots, const Coat& coat, double spacing, double off, int threads) {
    const int size = atlas.size;
    ShellTexture texture{.texels = Image8(size, size, 4)};
    // Which face each texel shows: its own, or, within the gutter, the nearest.
    std::vector<Owner> owners(static_cast<std::size_t>(size) * static_cast<std::size_t>(size));
    const double gutter = atlas.gutter - 1;
    const auto corners = [&](std::uint32_t f) {
        std::array<Vec2d, 3> c;
        for (std::size_t k = 0; k < 3; ++k) c[k] = Vec2d(atlas.mesh.uvs[atlas.mesh.indices[3 * f + k]]) * static_cast<double>(size);
        return c;
    };
    for (std::uint32_t f = 0; f < atlas.mesh.faces(); ++f) {
        const std::array<Vec2d, 3> c = corners(f);
        const double area = (c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[1].y - c[0].y) * (c[2].x - c[0].x);
        if (!(area > 1e-9)) continue;
        const auto low = [&](double a, double b, double d) { return std::max(0, static_cast<int>(std::floor(std::min({a, b, d}) - gutter))); };
        const auto high = [&](double a, double b, double d) { return std::min(size, static_cast<int>(std::ceil(std::max({a, b, d}) + gutter))); };
        for (int y = low(c[0].y, c[1].y, c[2].y); y < high(c[0].y, c[1].y, c[2].y); ++y)
            for (int x = low(c[0].x, c[1].x, c[2].x); x < high(c[0].x, c[1].x, c[2].x); ++x) {
                const Vec2d p(x + 0.5, y + 0.5);
                double away = 0;
                for (std::size_t k = 0; k < 3; ++k) {
                    const Vec2d a = c[k], b = c[(k + 1) % 3], d = b - a, e = p - a;
                    const double outside = -(d.x * e.y - d.y * e.x) / std::max(length(d), 1e-12);
                    away = std::max(away, outside);
                }
                Owner& o = owners[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)];
                if (away <= gutter && static_cast<float>(away) < o.away) o = {f, static_cast<float>(away)};
            }
    }

    const double root_radius = static_cast<double>(coat.width) * spacing, full = coat.length;
    const double stray = (1.42 * static_cast<double>(coat.spread) * full) + static_cast<double>(coat.curl_radius) * spacing;
    const double reach = 1.6 * root_radius + stray;
    // Cells twice as wide as the reach, so that two along each axis hold it; what the mesh of the atlas is off adds to that.
    const RootTable table(roots, 2 * (reach + off));
    const Vec3d mean = strand_albedo(coat, {.normal = {0, 1, 0}, .chance = 0x8080}, 0.7);
    std::vector<Vec3d> colours;  // and chances, once for each root
    std::vector<std::uint32_t> chances;
    std::vector<Vec3d> normals;
    for (const Root& r : roots.roots) {
        const Vec3d n = face_vector(mesh, r.face);
        const double l = length(n);
        normals.push_back(l > 0 ? n / l : Vec3d(0, 1, 0));
        chances.push_back(strand_chance(r.position));
        colours.push_back(strand_albedo(coat, {.normal = Vec3f(normals.back()), .chance = chances.back()}, 0.7));
    }
    std::vector<std::size_t> covered(static_cast<std::size_t>(size), 0), shown(static_cast<std::size_t>(size), 0);
    parallel_for(size, 8, threads, [&](int begin, int end) {
        for (int y = begin; y < end; ++y)
            for (int x = 0; x < size; ++x) {
                std::uint8_t* to = texture.texels.at(x, y);
                to[0] = encoded(mean.x);
                to[1] = encoded(mean.y);
                to[2] = encoded(mean.z);
                const Owner& o = owners[static_cast<std::size_t>(y) * static_cast<std::size_t>(size) + static_cast<std::size_t>(x)];
                if (o.face == 0xffffffffu) continue;
                const std::array<Vec2d, 3> c = corners(o.face);
                const std::uint32_t* v = &atlas.mesh.indices[std::size_t{o.face} * 3];
                const Vec2d e1 = c[1] - c[0], e2 = c[2] - c[0], e = Vec2d(x + 0.5, y + 0.5) - c[0];
                const double area = e1.x * e2.y - e1.y * e2.x, u = (e.x * e2.y - e.y * e2.x) / area, w = (e1.x * e.y - e1.y * e.x) / area;
                const Vec3d a(atlas.mesh.positions[v[0]]), p = a + (Vec3d(atlas.mesh.positions[v[1]]) - a) * u + (Vec3d(atlas.mesh.positions[v[2]]) - a) * w;
                const Vec3d facing = cross(Vec3d(atlas.mesh.positions[v[1]]) - a, Vec3d(atlas.mesh.positions[v[2]]) - a);
                double highest = 0;
                std::uint32_t winner = 0;
                table.each_near(p, [&](std::uint32_t r) {
                    Vec3d gap = p - Vec3d(roots.roots[r].position);
                    if (dot(gap, gap) > reach * reach + (reach + off) * (reach + off)) return;
                    const Vec3d n = normals[r];
                    if (dot(n, facing) <= 0) return;
                    const double above = dot(gap, n);
                    gap = gap - n * above;
                    if (dot(gap, gap) > reach * reach || std::abs(above) > reach + off) return;
                    const double s = (chances[r] & 255u) / 255.0, t = (chances[r] >> 8) / 255.0;
                    const bool guard = t < static_cast<double>(coat.guard_hairs);
                    const double tip = guard ? 1.0 : 1 - static_cast<double>(coat.length_variation) * s, radius = root_radius * (guard ? 1.6 : 1.0);
                    if (tip <= highest) return;
                    const Vec3d side = normalize(cross(n, std::abs(n.y) < 0.9 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0))), other = cross(n, side);
                    const Vec3d lean = (side * (fraction(7 * s) - 0.5) + other * (fraction(11 * t) - 0.5)) * (2.0 * static_cast<double>(coat.spread) * full);
                    // How far inside the strand the texel is at a level; from the top down to where it is.
                    const auto inside = [&](double level) {
                        const double way = level / tip, way4 = way * way * way * way;
                        Vec3d axis = lean * level;
                        if (coat.curl_radius > 0) {
                            const double round = 2 * std::numbers::pi * (7 * t + static_cast<double>(coat.curl_turns) * level);
                            axis += (side * std::cos(round) + other * std::sin(round)) * (static_cast<double>(coat.curl_radius) * spacing * std::min(4 * level, 1.0));
                        }
                        return radius * (1 - (way + (way4 - way) * static_cast<double>(coat.taper))) - length(gap - axis);
                    };
                    constexpr int steps = 24;
                    double above_level = tip, above_inside = inside(tip);
                    for (int k = steps - 1; k >= 0 && above_level > highest; --k) {
                        const double level = tip * k / steps, in = inside(level);
                        if (in >= 0) {
                            const double found = level + (above_level - level) * in / std::max(in - above_inside, 1e-12);
                            if (found > highest) {
                                highest = found;
                                winner = r;
                            }
                            break;
                        }
                        above_level = level;
                        above_inside = in;
                    }
                });
                if (o.away <= 0) ++shown[static_cast<std::size_t>(y)];
                if (!(highest > 0)) continue;
                if (o.away <= 0) ++covered[static_cast<std::size_t>(y)];
                to[0] = encoded(colours[winner].x);
                to[1] = encoded(colours[winner].y);
                to[2] = encoded(colours[winner].z);
                to[3] = static_cast<std::uint8_t>(std::lround(255 * std::min(highest, 1.0)));
            }
    });
    const auto all = static_cast<double>(std::accumulate(shown.begin(), shown.end(), std::size_t{0}));
    if (all > 0) texture.covered = static_cast<double>(std::accumulate(covered.begin(), covered.end(), std::size_t{0})) / all;
    return texture;
}

}  // namespace relievo
