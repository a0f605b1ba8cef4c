#include "mesh/triangle_tree.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

namespace relievo {

namespace {

constexpr std::uint32_t leaf_size = 4;  // distances to triangles cost about as much as those to two boxes

double box_distance2(Vec3d p, const Vec3f& low, const Vec3f& high) {
    const double x = std::max({0.0, low.x - p.x, p.x - high.x});
    const double y = std::max({0.0, low.y - p.y, p.y - high.y});
    const double z = std::max({0.0, low.z - p.z, p.z - high.z});
    return x * x + y * y + z * z;
}

float along(const Vec3f& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

Vec3d nearest_on_segment(Vec3d p, Vec3d a, Vec3d b) {
    const double l2 = dot(b - a, b - a);
    return l2 > 0 ? a + (b - a) * std::clamp(dot(p - a, b - a) / l2, 0.0, 1.0) : a;
}

}  // namespace

Vec3d nearest_on_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c) {
    const Vec3d ab = b - a, ac = c - a, n = cross(ab, ac);
    if (dot(n, n) > 0) {
        // Inside where the foot of the perpendicular is on the inner side of all three sides.
        const Vec3d ap = p - a;
        const double v = dot(cross(ap, ac), n), w = dot(cross(ab, ap), n);
        if (v >= 0 && w >= 0 && v + w <= dot(n, n)) return a + (ab * v + ac * w) / dot(n, n);
    }
    const Vec3d candidates[] = {nearest_on_segment(p, a, b), nearest_on_segment(p, b, c), nearest_on_segment(p, c, a)};
    return *std::ranges::min_element(candidates, {}, [p](Vec3d q) { return dot(p - q, p - q); });
}

TriangleTree::TriangleTree(const Mesh& mesh) {
    assert(mesh.faces() > 0);
    triangles_.reserve(mesh.faces());
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3)
        triangles_.push_back({mesh.positions[mesh.indices[i]], mesh.positions[mesh.indices[i + 1]], mesh.positions[mesh.indices[i + 2]]});
    nodes_.reserve(triangles_.size());
    nodes_.emplace_back();
    build(0, 0, static_cast<std::uint32_t>(triangles_.size()));
}

// Halved at the median along the longest axis of the centres.
void TriangleTree::build(std::uint32_t node, std::uint32_t first, std::uint32_t last) {
    const auto centre = [](const Triangle& t) { return t.a + t.b + t.c; };
    Vec3f low = triangles_[first].a, high = low, low_centre = centre(triangles_[first]), high_centre = low_centre;
    const auto lower = [](const Vec3f& a, const Vec3f& b) { return Vec3f(std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)); };
    const auto upper = [](const Vec3f& a, const Vec3f& b) { return Vec3f(std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)); };
    for (std::uint32_t i = first; i < last; ++i) {
        const Triangle& t = triangles_[i];
        low = lower(low, lower(t.a, lower(t.b, t.c)));
        high = upper(high, upper(t.a, upper(t.b, t.c)));
        low_centre = lower(low_centre, centre(t));
        high_centre = upper(high_centre, centre(t));
    }
    nodes_[node].low = low;
    nodes_[node].high = high;
    if (last - first <= leaf_size) {
        nodes_[node].first = first;
        nodes_[node].count = last - first;
        return;
    }
    const Vec3f size = high_centre - low_centre;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::uint32_t middle = first + (last - first) / 2;
    std::nth_element(triangles_.begin() + first, triangles_.begin() + middle, triangles_.begin() + last,
                     [&](const Triangle& s, const Triangle& t) { return along(centre(s), axis) < along(centre(t), axis); });
    const auto left = static_cast<std::uint32_t>(nodes_.size());
    nodes_[node].first = left;
    nodes_.resize(nodes_.size() + 2);
    build(left, first, middle);
    build(left + 1, middle, last);
}

double TriangleTree::distance2(Vec3d p, double at_most) const {
    struct Waiting {
        std::uint32_t node;
        double distance2;
    };
    std::array<Waiting, 64> waiting;  // the tree is halved at every level: 32 of them for 2^32 triangles, two nodes each
    std::size_t count = 0;
    double best = at_most;
    waiting[count++] = {0, box_distance2(p, nodes_[0].low, nodes_[0].high)};
    while (count > 0) {
        const Waiting w = waiting[--count];
        if (w.distance2 >= best) continue;
        const Node& node = nodes_[w.node];
        if (node.count > 0) {
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                const Vec3d d = p - nearest_on_triangle(p, Vec3d(triangles_[i].a), Vec3d(triangles_[i].b), Vec3d(triangles_[i].c));
                best = std::min(best, dot(d, d));
            }
            continue;
        }
        Waiting near{node.first, box_distance2(p, nodes_[node.first].low, nodes_[node.first].high)};
        Waiting far{node.first + 1, box_distance2(p, nodes_[node.first + 1].low, nodes_[node.first + 1].high)};
        if (far.distance2 < near.distance2) std::swap(near, far);
        if (far.distance2 < best) waiting[count++] = far;
        if (near.distance2 < best) waiting[count++] = near;
    }
    return best;
}

}  // namespace relievo
