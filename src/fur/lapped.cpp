#include "fur/lapped.h"

#include "fur/facing.h"
#include "fur/fur_map.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <queue>
#include <random>
#include <span>

namespace relievo {

namespace {

// Lists of numbers by number, in one array.
struct Lists {
    std::vector<std::uint32_t> starts, items;
    std::span<const std::uint32_t> operator[](std::uint32_t i) const { return {items.data() + starts[i], starts[i + 1] - starts[i]}; }
};

Lists faces_at(const Mesh& mesh) {
    Lists lists;
    lists.starts.assign(mesh.positions.size() + 1, 0);
    for (const std::uint32_t v : mesh.indices) ++lists.starts[v + 1];
    std::partial_sum(lists.starts.begin(), lists.starts.end(), lists.starts.begin());
    lists.items.resize(mesh.indices.size());
    std::vector<std::uint32_t> next(lists.starts.begin(), lists.starts.end() - 1);
    for (std::size_t i = 0; i < mesh.indices.size(); ++i) lists.items[next[mesh.indices[i]]++] = static_cast<std::uint32_t>(i / 3);
    return lists;
}

struct Frame2 {
    Vec3d along, across;
    Vec2d flat(Vec3d way) const {
        const Vec2d d(dot(way, along), dot(way, across));
        const double l = length(d);
        return l > 0 ? d * (length(way) / l) : d;
    }
};

Frame2 frame_of(Vec3d normal, Vec3d along) {
    Vec3d t = along - normal * dot(normal, along);
    if (!(dot(t, t) > 1e-12)) t = cross(normal, std::abs(normal.x) < 0.8 ? Vec3d(1, 0, 0) : Vec3d(0, 1, 0));
    t = normalize(t);
    return {t, cross(normal, t)};
}

// What a patch knows of the vertices it has reached; found by the patch's number, so that nothing is cleared in between.
struct Reached {
    std::uint32_t patch = 0;
    double distance = 0;
    Vec2d place;
    Frame2 frame;
};

class Growth {
public:
    Growth(const Mesh& mesh, const std::vector<Vec3f>& comb, double radius) : mesh_(mesh), comb_(comb), radius_(radius), faces_at_(faces_at(mesh)), reached_(mesh.positions.size()) {}

    // The faces of the patch around `first`; places are asked for afterwards.
    std::vector<std::uint32_t> grow(std::uint32_t first) {
        ++patch_;
        order_.clear();
        const std::uint32_t* v = &mesh_.indices[std::size_t{first} * 3];
        const Vec3d middle = (at(v[0]) + at(v[1]) + at(v[2])) / 3.0;
        const Vec3d up = normal(v[0]) + normal(v[1]) + normal(v[2]);
        const Vec3d seed_normal = length(up) > 1e-9 ? normalize(up) : Vec3d(0, 1, 0);
        const Frame2 frame = frame_of(seed_normal, combed(v[0]) + combed(v[1]) + combed(v[2]));
        using Waiting = std::pair<double, std::uint32_t>;
        std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting;
        const auto reach = [&](std::uint32_t w, double distance, Vec2d place, Vec3d along) {
            Reached& r = reached_[w];
            if (r.patch == patch_ && r.distance <= distance) return;
            // The comb, unless it turns away from the way the patch came: around its singular points a patch goes straight on.
            const Frame2 straight = frame_of(normal(w), along);
            const Vec3d own = combed(w);
            r = {patch_, distance, place, dot(own, straight.along) > 0.5 ? frame_of(normal(w), own) : straight};
            waiting.push({distance, w});
        };
        for (int k = 0; k < 3; ++k) reach(v[k], length(at(v[k]) - middle), frame.flat(at(v[k]) - middle), frame.along);
        while (!waiting.empty()) {
            const auto [distance, w] = waiting.top();
            waiting.pop();
            if (distance > reached_[w].distance) continue;
            order_.push_back(w);
            if (distance > 1.5 * radius_) continue;
            const Reached from = reached_[w];
            for (const std::uint32_t f : faces_at_[w])
                for (std::size_t k = 0; k < 3; ++k) {
                    const std::uint32_t to = mesh_.indices[f * std::size_t{3} + k];
                    if (to == w || dot(normal(to), seed_normal) < 0) continue;  // around an edge another patch takes over
                    const Vec3d way = at(to) - at(w);
                    reach(to, distance + length(way), from.place + from.frame.flat(way), from.frame.along);
                }
        }
        smooth(v[0]);
        std::vector<std::uint32_t> faces{first};  // though all its corners lie beyond the disc
        for (const std::uint32_t w : order_)
            for (const std::uint32_t f : faces_at_[w]) {
                const std::uint32_t* c = &mesh_.indices[std::size_t{f} * 3];
                if (!has(c[0]) || !has(c[1]) || !has(c[2])) continue;
                if (std::min({length(place(c[0])), length(place(c[1])), length(place(c[2]))}) < radius_) faces.push_back(f);
            }
        std::ranges::sort(faces);
        faces.erase(std::ranges::unique(faces).begin(), faces.end());
        return faces;
    }
    Vec2d place(std::uint32_t v) const { return reached_[v].place; }

private:
    Vec3d at(std::uint32_t v) const { return Vec3d(mesh_.positions[v]); }
    Vec3d normal(std::uint32_t v) const { return Vec3d(mesh_.normals[v]); }
    Vec3d combed(std::uint32_t v) const { return Vec3d(comb_[v]); }
    bool has(std::uint32_t v) const { return reached_[v].patch == patch_; }

    // Praun's optimisation along edges: each place the mean of what its neighbours say it is, over and over.
    void smooth(std::uint32_t held) {
        for (int step = 0; step < 12; ++step)
            for (const std::uint32_t v : order_) {
                if (v == held) continue;
                Vec2d sum;
                int count = 0;
                for (const std::uint32_t f : faces_at_[v])
                    for (std::size_t k = 0; k < 3; ++k) {
                        const std::uint32_t w = mesh_.indices[f * std::size_t{3} + k];
                        if (w == v || !has(w)) continue;
                        const Vec3d way = at(v) - at(w);
                        sum = sum + place(w) + (reached_[w].frame.flat(way) + reached_[v].frame.flat(way)) * 0.5;
                        ++count;
                    }
                if (count > 0) reached_[v].place = sum / static_cast<double>(count);
            }
    }

    const Mesh& mesh_;
    const std::vector<Vec3f>& comb_;
    double radius_;
    Lists faces_at_;
    std::vector<Reached> reached_;
    std::vector<std::uint32_t> order_;
    std::uint32_t patch_ = 0;
};

double signed_area(Vec2d a, Vec2d b, Vec2d c) { return ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2; }

}  // namespace

Lapped lapped(const Mesh& mesh, const std::vector<Vec3f>& comb, const LappedSettings& s) {
    assert(mesh.normals.size() == mesh.positions.size() && comb.size() == mesh.positions.size() && s.radius > 0);
    Lapped result;
    result.mesh.name = mesh.name;
    std::vector<std::uint32_t> order(mesh.faces());
    std::iota(order.begin(), order.end(), 0u);
    std::mt19937 random(s.seed);
    for (std::size_t i = 0; i < order.size(); ++i) std::swap(order[i], order[i + (std::uint64_t{random()} * (order.size() - i) >> 32)]);
    std::vector<bool> covered(mesh.faces(), false);
    Growth growth(mesh, comb, s.radius);
    std::vector<std::uint32_t> copy(mesh.positions.size()), copied_for(mesh.positions.size(), 0);
    double all = 0;
    for (std::uint32_t f = 0; f < mesh.faces(); ++f) {
        all += length(face_vector(mesh, f)) / 2;
        if (!(length(face_vector(mesh, f)) > 0)) covered[f] = true;
    }
    for (const std::uint32_t first : order) {
        if (covered[first]) continue;
        ++result.patches;
        for (const std::uint32_t f : growth.grow(first)) {
            if (covered[f]) continue;
            const std::uint32_t* v = &mesh.indices[std::size_t{f} * 3];
            // Where the patch folds over itself it pastes nothing.
            if (signed_area(growth.place(v[0]), growth.place(v[1]), growth.place(v[2])) <= 0 && f != first) continue;
            double farthest = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                farthest = std::max(farthest, length(growth.place(v[k])));
                if (copied_for[v[k]] != result.patches) {
                    copied_for[v[k]] = static_cast<std::uint32_t>(result.patches);
                    copy[v[k]] = static_cast<std::uint32_t>(result.mesh.positions.size());
                    result.mesh.positions.push_back(mesh.positions[v[k]]);
                    result.mesh.normals.push_back(mesh.normals[v[k]]);
                    result.comb.push_back(comb[v[k]]);
                    const Vec2d p = growth.place(v[k]) / s.radius;
                    result.mesh.uvs.emplace_back(static_cast<float>(0.5 + 0.5 * p.x), static_cast<float>(0.5 + 0.5 * p.y));
                }
                result.mesh.indices.push_back(copy[v[k]]);
            }
            result.face_of.push_back(f);
            result.pasted_area += length(face_vector(mesh, f)) / 2;
            if (farthest <= blob_inside * s.radius || f == first) covered[f] = true;
        }
    }
    if (all > 0) result.pasted_area /= all;
    return result;
}

Image8 patch_texture(int size, double density, std::uint32_t seed) {
    FurMap map = fur_map({.width = size, .height = size, .density = density, .apart = 0, .seed = seed});
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double u = (2 * x + 1.0) / size - 1, v = (2 * y + 1.0) / size - 1, angle = std::atan2(v, u);
            // Three waves of no common period make the edge look like none in particular.
            const double wave = (std::sin(3 * angle + 1) + std::sin(7 * angle + 2) + std::sin(12 * angle)) / 3;
            const double edge = blob_inside + (1 - blob_inside) * (0.5 + 0.5 * wave) - 2.0 / size;
            if (u * u + v * v > edge * edge) map.texels(x, y, 3) = u * u + v * v <= blob_inside * blob_inside ? map.texels(x, y, 3) : std::uint8_t{0};
        }
    return std::move(map.texels);
}

MapStrands lapped_strands(const Lapped& patches, const Mesh& mesh, const Image8& texture) {
    MapStrands result;
    for (std::uint32_t f = 0; f < mesh.faces(); ++f) result.roots.area += length(face_vector(mesh, f)) / 2;
    for (std::uint32_t f = 0; f < patches.mesh.faces(); ++f) {
        const std::uint32_t* v = &patches.mesh.indices[std::size_t{f} * 3];
        std::array<Vec2d, 3> t;
        for (std::size_t k = 0; k < 3; ++k) t[k] = Vec2d(static_cast<double>(patches.mesh.uvs[v[k]].x) * texture.width - 0.5, static_cast<double>(patches.mesh.uvs[v[k]].y) * texture.height - 0.5);
        const double area = signed_area(t[0], t[1], t[2]);
        if (!(std::abs(area) > 1e-12)) continue;
        const auto least = [&](auto of) { return std::min({of(t[0]), of(t[1]), of(t[2])}); };
        const auto most = [&](auto of) { return std::max({of(t[0]), of(t[1]), of(t[2])}); };
        const auto x_of = [](Vec2d p) { return p.x; };
        const auto y_of = [](Vec2d p) { return p.y; };
        const int x0 = std::max(0, static_cast<int>(std::ceil(least(x_of)))), x1 = std::min(texture.width - 1, static_cast<int>(std::floor(most(x_of))));
        const int y0 = std::max(0, static_cast<int>(std::ceil(least(y_of)))), y1 = std::min(texture.height - 1, static_cast<int>(std::floor(most(y_of))));
        for (int y = y0; y <= y1; ++y)
            for (int x = x0; x <= x1; ++x) {
                if (texture(x, y, 3) == 0) continue;
                const Vec2d p(x, y);
                const double a = signed_area(p, t[1], t[2]) / area, b = signed_area(t[0], p, t[2]) / area, c = 1 - a - b;
                if (a < 0 || b < 0 || c < 0) continue;
                const Vec3d at = Vec3d(patches.mesh.positions[v[0]]) * a + Vec3d(patches.mesh.positions[v[1]]) * b + Vec3d(patches.mesh.positions[v[2]]) * c;
                result.roots.roots.push_back({Vec3f(at), patches.face_of[f]});
                result.strands.push_back(static_cast<std::uint32_t>(y * texture.width + x));
            }
    }
    return result;
}

}  // namespace relievo
