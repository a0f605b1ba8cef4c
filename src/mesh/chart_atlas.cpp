#include "mesh/chart_atlas.h"

#include "core/error.h"
#include "mesh/equal_vertices.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <unordered_map>

namespace relievo {

namespace {

constexpr int gutter = 3;         // two texels that are drawn beyond the edge, one that keeps neighbours apart
constexpr double filling = 0.6;   // of the square by charts: where the search for the scale begins
constexpr double steepest = 0.25; // cosine between a face and the axis along which its neighbours want it to be seen

// Sideways and upward seen against axis a (0 to 2: against +x, +y, +z; 3 to 5 against the others), turning the same way round as the face.
Vec2d projected(Vec3d p, int a) {
    const Vec2d flat = a % 3 == 0 ? Vec2d(p.y, p.z) : a % 3 == 1 ? Vec2d(p.z, p.x) : Vec2d(p.x, p.y);
    return a < 3 ? flat : Vec2d(-flat.x, flat.y);
}

double along(Vec3d n, int a) { return (a % 3 == 0 ? n.x : a % 3 == 1 ? n.y : n.z) * (a < 3 ? 1 : -1); }

struct Faces {
    const Mesh& mesh;
    std::vector<std::array<std::uint32_t, 3>> beside;  // faces across the sides, `none` at borders
    std::vector<int> axis;
    static constexpr std::uint32_t none = 0xffffffffu;
};

Faces faces_of(const Mesh& mesh, int threads) {
    Faces faces{mesh, {}, {}};
    faces.beside.assign(mesh.faces(), {Faces::none, Faces::none, Faces::none});
    const std::vector<std::uint32_t> place = first_equal_vertex(mesh, Compared::positions, threads);
    std::unordered_map<std::uint64_t, std::uint32_t> sides;  // side as 3 face + k, from lower to higher place
    sides.reserve(mesh.indices.size());
    for (std::uint32_t i = 0; i < mesh.indices.size(); ++i) {
        const std::uint32_t a = place[mesh.indices[i]], b = place[mesh.indices[i % 3 == 2 ? i - 2 : i + 1]];
        const auto [at, added] = sides.try_emplace(std::uint64_t{std::min(a, b)} << 32 | std::max(a, b), i);
        if (added || at->second == Faces::none) continue;
        faces.beside[i / 3][i % 3] = at->second / 3;
        faces.beside[at->second / 3][at->second % 3] = i / 3;
        at->second = Faces::none;  // a third face at the side has no neighbour there
    }
    std::vector<Vec3d> normals;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        const Vec3d a(mesh.positions[mesh.indices[3 * f]]), n = cross(Vec3d(mesh.positions[mesh.indices[3 * f + 1]]) - a, Vec3d(mesh.positions[mesh.indices[3 * f + 2]]) - a);
        const double l = length(n);
        normals.push_back(l > 0 ? n / l : Vec3d());
        int best = 0;
        for (int k = 1; k < 6; ++k)
            if (along(normals[f], k) > along(normals[f], best)) best = k;
        faces.axis.push_back(best);
    }
    // A face between others that look elsewhere goes with them if it can be seen from there: scans are rough, and every change is a seam.
    for (int round = 0; round < 4; ++round) {
        const std::vector<int> before = faces.axis;
        for (std::size_t f = 0; f < mesh.faces(); ++f) {
            std::array<int, 6> votes{};
            for (const std::uint32_t g : faces.beside[f])
                if (g != Faces::none) ++votes[static_cast<std::size_t>(before[g])];
            for (int k = 0; k < 6; ++k)
                if (votes[static_cast<std::size_t>(k)] >= 2 && votes[static_cast<std::size_t>(before[f])] == 0 && along(normals[f], k) > steepest) faces.axis[f] = k;
        }
    }
    return faces;
}

struct Chart {
    int axis = 0;
    std::vector<std::uint32_t> faces;
    Vec2d low, high;  // projected
    int x = 0, y = 0, width = 0, height = 0;
};

// Of the faces not yet in a chart, those that hang together and look the same way.
std::vector<std::uint32_t> connected(const Faces& faces, std::vector<bool>& taken, std::uint32_t first) {
    std::vector<std::uint32_t> found{first};
    taken[first] = true;
    for (std::size_t i = 0; i < found.size(); ++i)
        for (const std::uint32_t g : faces.beside[found[i]])
            if (g != Faces::none && !taken[g] && faces.axis[g] == faces.axis[first]) {
                taken[g] = true;
                found.push_back(g);
            }
    return found;
}

// Takes from the chart the faces that fold over others of it, which are given back to be parted again.
void unfold(const Mesh& mesh, Chart& chart, double texel, std::vector<bool>& taken) {
    const auto across = [&](double low, double high) { return static_cast<std::size_t>(std::ceil((high - low) / texel)) + 2; };
    const std::size_t width = across(chart.low.x, chart.high.x), height = across(chart.low.y, chart.high.y);
    std::vector<bool> covered(width * height, false);
    std::vector<std::uint32_t> kept;
    std::vector<std::size_t> texels;
    for (const std::uint32_t f : chart.faces) {
        Vec2d c[3];
        for (std::size_t k = 0; k < 3; ++k) c[k] = (projected(Vec3d(mesh.positions[mesh.indices[3 * f + k]]), chart.axis) - chart.low) / texel;
        const auto side = [](Vec2d a, Vec2d b, Vec2d p) { return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x); };
        texels.clear();
        bool free = true;
        const auto from = [](double a, double b, double d) { return static_cast<std::size_t>(std::max(std::floor(std::min({a, b, d})), 0.0)); };
        const auto to = [](double a, double b, double d) { return static_cast<std::size_t>(std::max(std::ceil(std::max({a, b, d})), 0.0)); };
        for (std::size_t y = from(c[0].y, c[1].y, c[2].y); y < std::min(height, to(c[0].y, c[1].y, c[2].y)) && free; ++y)
            for (std::size_t x = from(c[0].x, c[1].x, c[2].x); x < std::min(width, to(c[0].x, c[1].x, c[2].x)) && free; ++x) {
                const Vec2d p(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
                // A centre on a side belongs to neither face here.
                if (!(side(c[0], c[1], p) > 0 && side(c[1], c[2], p) > 0 && side(c[2], c[0], p) > 0)) continue;
                free = !covered[y * width + x];
                texels.push_back(y * width + x);
            }
        if (!free) {
            taken[f] = false;
            continue;
        }
        for (const std::size_t t : texels) covered[t] = true;
        kept.push_back(f);
    }
    chart.faces = std::move(kept);
}

void measure(const Mesh& mesh, Chart& chart) {
    chart.low = Vec2d(1e300);
    chart.high = Vec2d(-1e300);
    for (const std::uint32_t f : chart.faces)
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec2d p = projected(Vec3d(mesh.positions[mesh.indices[3 * f + k]]), chart.axis);
            chart.low = {std::min(chart.low.x, p.x), std::min(chart.low.y, p.y)};
            chart.high = {std::max(chart.high.x, p.x), std::max(chart.high.y, p.y)};
        }
}

bool packed(std::vector<Chart>& charts, int size, double texel) {
    for (Chart& c : charts) {
        c.width = static_cast<int>(std::min(std::ceil((c.high.x - c.low.x) / texel), 1e6)) + 2 * gutter;
        c.height = static_cast<int>(std::min(std::ceil((c.high.y - c.low.y) / texel), 1e6)) + 2 * gutter;
    }
    std::vector<std::uint32_t> order(charts.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, [&](std::uint32_t a, std::uint32_t b) { return charts[a].height > charts[b].height; });
    int x = 0, y = 0, shelf = 0;
    for (const std::uint32_t i : order) {
        Chart& c = charts[i];
        if (x + c.width > size) {
            y += shelf;
            x = shelf = 0;
        }
        if (c.width > size || y + c.height > size) return false;
        c.x = x;
        c.y = y;
        x += c.width;
        shelf = std::max(shelf, c.height);
    }
    return true;
}

}  // namespace

ChartAtlas chart_atlas(const Mesh& mesh, int size, int threads) {
    assert(size >= 64 && mesh.faces() > 0);
    const Faces faces = faces_of(mesh, threads);
    double area = 0;
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        Vec2d c[3];
        for (std::size_t k = 0; k < 3; ++k) c[k] = projected(Vec3d(mesh.positions[mesh.indices[3 * f + k]]), faces.axis[f]);
        area += std::max(0.0, ((c[1].x - c[0].x) * (c[2].y - c[0].y) - (c[1].y - c[0].y) * (c[2].x - c[0].x)) / 2);
    }
    if (!(area > 0)) throw Error("unfold", mesh.name, "its faces have no area");
    double texel = std::sqrt(area / filling) / size;

    std::vector<Chart> charts;
    std::vector<bool> taken(mesh.faces(), false);
    // Charts of all faces that are in none. The first face of each is never folded over another: there is an end.
    const auto part = [&] {
        for (std::uint32_t f = 0; f < mesh.faces();) {
            if (taken[f]) {
                ++f;
                continue;
            }
            Chart chart{.axis = faces.axis[f], .faces = connected(faces, taken, f)};
            measure(mesh, chart);
            unfold(mesh, chart, texel, taken);
            measure(mesh, chart);
            charts.push_back(std::move(chart));
        }
    };
    part();
    for (int tries = 0;; ++tries) {
        if (tries == 100) throw Error("unfold", mesh.name, std::to_string(charts.size()) + " charts find no room in " + std::to_string(size) + " x " + std::to_string(size) + " texels", "take a larger atlas or a smoother mesh");
        if (!packed(charts, size, texel)) {
            texel *= 1.04;
            continue;
        }
        // Other texels may have their centres in two faces.
        bool changed = false;
        for (Chart& chart : charts) {
            const std::size_t before = chart.faces.size();
            unfold(mesh, chart, texel, taken);
            if (chart.faces.size() == before) continue;
            measure(mesh, chart);
            changed = true;
        }
        if (!changed) break;
        part();
    }

    ChartAtlas atlas{.size = size, .gutter = gutter, .charts = static_cast<int>(charts.size()), .texel = texel};
    atlas.mesh.name = mesh.name;
    atlas.mesh.indices.resize(mesh.indices.size());
    std::unordered_map<std::uint32_t, std::uint32_t> number;
    for (const Chart& chart : charts) {
        number.clear();
        for (const std::uint32_t f : chart.faces)
            for (std::size_t k = 0; k < 3; ++k) {
                const std::uint32_t v = mesh.indices[3 * f + k];
                const auto [at, added] = number.try_emplace(v, static_cast<std::uint32_t>(atlas.vertex.size()));
                if (added) {
                    atlas.vertex.push_back(v);
                    atlas.mesh.positions.push_back(mesh.positions[v]);
                    if (!mesh.normals.empty()) atlas.mesh.normals.push_back(mesh.normals[v]);
                    const Vec2d p = (projected(Vec3d(mesh.positions[v]), chart.axis) - chart.low) / texel + Vec2d(chart.x + gutter, chart.y + gutter);
                    atlas.mesh.uvs.emplace_back(p / size);
                }
                atlas.mesh.indices[3 * f + k] = at->second;
            }
    }
    return atlas;
}

}  // namespace relievo
