#include "fur/evenness.h"

#include "core/parallel_for.h"
#include "fur/facing.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <unordered_map>
#include <vector>

namespace relievo {

namespace {

// The area that the disc of radius r around the origin shares with the triangle of the origin and the edge from p to q, counted
// negative where the edge runs clockwise.
double disc_and_edge(Vec2d p, Vec2d q, double r) {
    const auto sector = [&](Vec2d u, Vec2d v) { return r * r / 2 * std::atan2(u.x * v.y - u.y * v.x, dot(u, v)); };
    const auto triangle = [](Vec2d u, Vec2d v) { return (u.x * v.y - u.y * v.x) / 2; };
    const Vec2d d = q - p;
    const double a = dot(d, d), b = dot(p, d), c = dot(p, p) - r * r, root2 = b * b - a * c;
    if (!(a > 0)) return 0;
    if (root2 <= 0) return sector(p, q);
    const double root = std::sqrt(root2), enter = (-b - root) / a, leave = (-b + root) / a;
    if (enter >= 1 || leave <= 0) return sector(p, q);
    const Vec2d in = enter > 0 ? p + d * enter : p, out = leave < 1 ? p + d * leave : q;
    return (enter > 0 ? sector(p, in) : 0) + triangle(in, out) + (leave < 1 ? sector(out, q) : 0);
}

struct Site {
    Vec3d at, normal;
    double area = 0;
    std::uint32_t strands = 0;
    float nearest2 = std::numeric_limits<float>::infinity();  // to the root `nearest`
    std::uint32_t nearest = 0;
};

// Points in cells as wide as the radius that will be asked for.
class SiteGrid {
public:
    SiteGrid(std::span<const Site> sites, double width) : width_(width) {
        for (std::uint32_t s = 0; s < sites.size(); ++s) cells_[key(cell(sites[s].at))].push_back(s);
        count_ = sites.size();
    }
    // Visits every site in cells that the box reaches; others may come too.
    template <class Visit>
    void each_near(Vec3d low, Vec3d high, const Visit& visit) const {
        const Cell l = cell(low), h = cell(high);
        const double cells = static_cast<double>(h.x - l.x + 1) * static_cast<double>(h.y - l.y + 1) * static_cast<double>(h.z - l.z + 1);
        if (cells > static_cast<double>(count_)) {
            for (std::uint32_t s = 0; s < count_; ++s) visit(s);
            return;
        }
        for (std::int64_t z = l.z; z <= h.z; ++z)
            for (std::int64_t y = l.y; y <= h.y; ++y)
                for (std::int64_t x = l.x; x <= h.x; ++x)
                    if (const auto it = cells_.find(key({x, y, z})); it != cells_.end())
                        for (const std::uint32_t s : it->second) visit(s);
    }

private:
    struct Cell {
        std::int64_t x, y, z;
    };
    Cell cell(Vec3d p) const {
        const auto at = [&](double v) { return static_cast<std::int64_t>(std::floor(std::clamp(v / width_, -1e15, 1e15))); };
        return {at(p.x), at(p.y), at(p.z)};
    }
    // Distinct for cells within a million of each other, and finding too much is allowed.
    static std::uint64_t key(Cell c) {
        return (static_cast<std::uint64_t>(c.x) & 0x1fffff) | (static_cast<std::uint64_t>(c.y) & 0x1fffff) << 21 | (static_cast<std::uint64_t>(c.z) & 0x3fffff) << 42;
    }
    double width_;
    std::size_t count_ = 0;
    std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

Vec3d unit_normal(const Mesh& mesh, std::uint32_t face) {
    const Vec3d n = face_vector(mesh, face);
    const double l = length(n);
    return l > 0 ? n / l : Vec3d{};
}

}  // namespace

double area_in_ball(Vec3d a, Vec3d b, Vec3d c, Vec3d centre, double radius) {
    const Vec3d n = cross(b - a, c - a);
    const double size = length(n);
    if (!(size > 0)) return 0;
    const Vec3d unit = n / size;
    const double off = dot(a - centre, unit), r2 = radius * radius - off * off;
    if (r2 <= 0) return 0;
    // In the plane of the triangle, from the centre of the circle in which it cuts the ball.
    const Vec3d u = normalize(b - a), v = cross(unit, u), origin = centre + unit * off;
    const auto flat = [&](Vec3d p) { return Vec2d(dot(p - origin, u), dot(p - origin, v)); };
    const Vec2d p = flat(a), q = flat(b), s = flat(c);
    const double r = std::sqrt(r2);
    return std::max(0.0, disc_and_edge(p, q, r) + disc_and_edge(q, s, r) + disc_and_edge(s, p, r));
}

Evenness evenness(const Mesh& mesh, const Roots& roots, std::span<const std::uint32_t> strands, const EvennessSettings& settings) {
    assert(settings.extent > 0 && (strands.empty() || strands.size() == roots.roots.size()));
    Evenness result;
    if (roots.roots.empty()) return result;
    const double mean = static_cast<double>(roots.roots.size()) / roots.area;
    const double radius = std::sqrt(settings.strands_per_disc / mean / 3.141592653589793);

    const Roots places = grow_roots(mesh, {.count = settings.discs, .seed = 0x5eedu, .threads = settings.threads});
    std::vector<Site> sites;
    for (const Root& p : places.roots) sites.push_back({.at = Vec3d(p.position), .normal = unit_normal(mesh, p.face)});
    const SiteGrid grid(sites, radius);

    // What blocks of faces and of roots add to each site, summed in the order of blocks.
    constexpr int grain = 16384;
    const auto blocks = [&](std::size_t count) { return (count + grain - 1) / grain; };
    struct Part {
        std::uint32_t site;
        double area;
    };
    std::vector<std::vector<Part>> parts(blocks(mesh.faces()));
    parallel_for(static_cast<int>(mesh.faces()), grain, settings.threads, [&](int begin, int end) {
        std::vector<Part>& mine = parts[static_cast<std::size_t>(begin / grain)];
        for (auto f = static_cast<std::uint32_t>(begin); f < static_cast<std::uint32_t>(end); ++f) {
            const std::uint32_t* v = &mesh.indices[std::size_t{f} * 3];
            const Vec3d a(mesh.positions[v[0]]), b(mesh.positions[v[1]]), c(mesh.positions[v[2]]), n = cross(b - a, c - a);
            const Vec3d low(std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z}));
            const Vec3d high(std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z}));
            grid.each_near(low - Vec3d(radius), high + Vec3d(radius), [&](std::uint32_t s) {
                if (dot(n, sites[s].normal) <= 0) return;
                const double area = area_in_ball(a, b, c, sites[s].at, radius);
                if (area > 0) mine.push_back({s, area});
            });
        }
    });
    for (const auto& block : parts)
        for (const Part& p : block) sites[p.site].area += p.area;

    struct Near {
        std::uint32_t site, root;
        float gap2;
    };
    std::vector<std::vector<Near>> near(blocks(roots.roots.size()));
    parallel_for(static_cast<int>(roots.roots.size()), grain, settings.threads, [&](int begin, int end) {
        std::vector<Near>& mine = near[static_cast<std::size_t>(begin / grain)];
        for (auto i = static_cast<std::uint32_t>(begin); i < static_cast<std::uint32_t>(end); ++i) {
            const Vec3d at(roots.roots[i].position), n = face_vector(mesh, roots.roots[i].face);
            grid.each_near(at - Vec3d(radius), at + Vec3d(radius), [&](std::uint32_t s) {
                const Vec3d gap = at - sites[s].at;
                if (dot(gap, gap) <= radius * radius && dot(n, sites[s].normal) > 0) mine.push_back({s, i, static_cast<float>(dot(gap, gap))});
            });
        }
    });
    for (const auto& block : near)
        for (const Near& n : block) {
            Site& s = sites[n.site];
            ++s.strands;
            if (n.gap2 < s.nearest2) {
                s.nearest2 = n.gap2;
                s.nearest = n.root;
            }
        }

    std::vector<double> densities;
    for (const Site& s : sites) densities.push_back(s.area > 0 ? s.strands / s.area / mean : 0);
    std::ranges::sort(densities);
    const auto rank = [&](double share) { return densities[static_cast<std::size_t>(share * static_cast<double>(densities.size() - 1) + 0.5)]; };
    result.p5 = rank(0.05);
    result.p50 = rank(0.5);
    result.p95 = rank(0.95);
    result.density_p95_over_p5 = result.p5 > 0 ? result.p95 / result.p5 : std::numeric_limits<double>::infinity();

    if (!strands.empty()) {
        // Each site asks where else its strand grows.
        std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> asked;
        for (std::uint32_t s = 0; s < sites.size(); ++s)
            if (sites[s].strands > 0) asked[strands[sites[s].nearest]].push_back(s);
        std::vector<bool> shared(sites.size(), false);
        const double far = settings.distant * settings.extent;
        for (std::size_t i = 0; i < roots.roots.size(); ++i)
            if (const auto it = asked.find(strands[i]); it != asked.end())
                for (const std::uint32_t s : it->second)
                    if (length(Vec3d(roots.roots[i].position) - sites[s].at) > far) shared[s] = true;
        result.shared_texel_area = static_cast<double>(std::ranges::count(shared, true)) / static_cast<double>(sites.size());
    }
    return result;
}

}  // namespace relievo
