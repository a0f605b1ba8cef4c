#include "reference/strand_tracer.h"

#include "core/morton.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <numeric>

namespace relievo {

namespace {

Vec3f lower(Vec3f a, Vec3f b) { return {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)}; }
Vec3f upper(Vec3f a, Vec3f b) { return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}; }

}  // namespace

StrandTracer::StrandTracer(const StrandPieces& strands, const Mesh& skin) : strands_(strands), skin_(skin) {
    assert(strands.pieces >= 1 && strands.points.size() == strands.radii.size());
    const std::size_t stride = static_cast<std::size_t>(strands.pieces) + 1, pieces = strands.points.size() / stride * static_cast<std::size_t>(strands.pieces);
    const std::size_t count = pieces + skin.faces();
    lows_.resize(count);
    highs_.resize(count);
    for (std::size_t i = 0; i < pieces; ++i) {
        const std::size_t p = i / static_cast<std::size_t>(strands.pieces) * stride + i % static_cast<std::size_t>(strands.pieces);
        const Vec3f r(std::max(strands.radii[p], strands.radii[p + 1]));
        lows_[i] = lower(strands.points[p], strands.points[p + 1]) - r;
        highs_[i] = upper(strands.points[p], strands.points[p + 1]) + r;
    }
    for (std::size_t f = 0; f < skin.faces(); ++f) {
        const Vec3f a = skin.positions[skin.indices[f * 3]], b = skin.positions[skin.indices[f * 3 + 1]], c = skin.positions[skin.indices[f * 3 + 2]];
        lows_[pieces + f] = lower(lower(a, b), c);
        highs_[pieces + f] = upper(upper(a, b), c);
    }
    if (count == 0) return;
    Vec3f low = lows_[0], high = highs_[0];
    for (std::size_t i = 0; i < count; ++i) {
        low = lower(low, lows_[i]);
        high = upper(high, highs_[i]);
    }
    const float extent = std::max({high.x - low.x, high.y - low.y, high.z - low.z, 1e-30f});
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keys(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3f m = ((lows_[i] + highs_[i]) * 0.5f - low) * (2097151.0f / extent);
        keys[i] = {morton(static_cast<std::uint64_t>(m.x), static_cast<std::uint64_t>(m.y), static_cast<std::uint64_t>(m.z)), static_cast<std::uint32_t>(i)};
    }
    std::ranges::sort(keys);
    order_.resize(count);
    for (std::size_t i = 0; i < count; ++i) order_[i] = keys[i].second;
    nodes_.reserve(count);
    build(0, static_cast<std::uint32_t>(count));
    lows_ = {};
    highs_ = {};
}

std::uint32_t StrandTracer::build(std::uint32_t first, std::uint32_t last) {
    const auto number = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    Node node;
    if (last - first <= 4) {
        node.first = first;
        node.count = last - first;
        node.low = lows_[order_[first]];
        node.high = highs_[order_[first]];
        for (std::uint32_t i = first; i < last; ++i) {
            node.low = lower(node.low, lows_[order_[i]]);
            node.high = upper(node.high, highs_[order_[i]]);
        }
    } else {
        const std::uint32_t middle = first + (last - first) / 2, left = build(first, middle);
        node.right = build(middle, last);
        node.low = lower(nodes_[left].low, nodes_[node.right].low);
        node.high = upper(nodes_[left].high, nodes_[node.right].high);
    }
    nodes_[number] = node;
    return number;
}

// Visits the pieces whose box the ray enters before `nearest`, which the visitor may bring nearer.
template <class Visit>
void StrandTracer::along(Vec3d origin, Vec3d direction, double& nearest, const Visit& visit) const {
    if (nodes_.empty()) return;
    const Vec3d inverse(1 / direction.x, 1 / direction.y, 1 / direction.z);
    const auto enters = [&](const Node& n) {
        double in = 0, out = nearest;
        const auto slab = [&](double o, double inv, double low, double high) {
            double a = (low - o) * inv, b = (high - o) * inv;
            if (a > b) std::swap(a, b);
            // A ray in a face of the box divides 0 by 0: it counts as inside.
            if (a > in) in = a;
            if (b < out) out = b;
        };
        slab(origin.x, inverse.x, n.low.x, n.high.x);
        slab(origin.y, inverse.y, n.low.y, n.high.y);
        slab(origin.z, inverse.z, n.low.z, n.high.z);
        return in <= out * (1 + 1e-12) ? in : std::numeric_limits<double>::infinity();
    };
    struct Waiting {
        std::uint32_t node;
        double in;
    };
    std::array<Waiting, 64> stack;
    std::size_t size = 0;
    stack[size++] = {0, enters(nodes_[0])};
    while (size > 0) {
        const Waiting w = stack[--size];
        if (!(w.in < nearest)) continue;
        const Node& n = nodes_[w.node];
        if (n.count > 0) {
            for (std::uint32_t i = n.first; i < n.first + n.count; ++i)
                if (!visit(order_[i])) return;
            continue;
        }
        const Waiting a{w.node + 1, enters(nodes_[w.node + 1])}, b{n.right, enters(nodes_[n.right])};
        const bool a_first = a.in <= b.in;
        stack[size++] = a_first ? b : a;
        stack[size++] = a_first ? a : b;
    }
}

bool StrandTracer::meets(std::uint32_t piece, Vec3d origin, Vec3d direction, double nearest, StrandHit& hit) const {
    const auto per_strand = static_cast<std::uint32_t>(strands_.pieces);
    const auto pieces = static_cast<std::uint32_t>(strands_.points.size() / (per_strand + 1)) * per_strand;
    if (piece < pieces) {
        const std::size_t p = std::size_t{piece / per_strand} * (per_strand + 1) + piece % per_strand;
        const Vec3d a(strands_.points[p]), axis = Vec3d(strands_.points[p + 1]) - a, from = origin - a;
        const double dd = dot(direction, direction), da = dot(direction, axis), aa = dot(axis, axis), df = dot(direction, from), af = dot(axis, from);
        const double det = dd * aa - da * da;
        const double s = std::clamp(det > 1e-14 * dd * aa ? (dd * af - da * df) / det : 0.0, 0.0, 1.0);
        const double t = (s * da - df) / dd;
        if (!(t > 0) || t >= nearest) return false;
        const Vec3d gap = from + direction * t - axis * s;
        const double r = strands_.radii[p] * (1 - s) + strands_.radii[p + 1] * s;
        if (dot(gap, gap) >= r * r) return false;
        hit = {.t = t, .skin = false, .index = piece / per_strand, .way = (piece % per_strand + s) / per_strand, .weights = {}};
        return true;
    }
    // Moeller and Trumbore (1997), "Fast, Minimum Storage Ray/Triangle Intersection".
    const std::uint32_t f = piece - pieces;
    const Vec3d a(skin_.positions[skin_.indices[f * 3]]), e1 = Vec3d(skin_.positions[skin_.indices[f * 3 + 1]]) - a, e2 = Vec3d(skin_.positions[skin_.indices[f * 3 + 2]]) - a;
    const Vec3d h = cross(direction, e2);
    const double det = dot(e1, h);
    if (det == 0) return false;
    const Vec3d from = origin - a, q = cross(from, e1);
    const double u = dot(from, h) / det, v = dot(direction, q) / det, t = dot(e2, q) / det;
    if (u < 0 || v < 0 || u + v > 1 || !(t > 0) || t >= nearest) return false;
    hit = {.t = t, .skin = true, .index = f, .way = 0, .weights = {u, v}};
    return true;
}

std::optional<StrandHit> StrandTracer::first_hit(Vec3d origin, Vec3d direction) const {
    std::optional<StrandHit> first;
    double nearest = std::numeric_limits<double>::infinity();
    StrandHit hit;
    along(origin, direction, nearest, [&](std::uint32_t piece) {
        if (meets(piece, origin, direction, nearest, hit)) {
            first = hit;
            nearest = hit.t;
        }
        return true;
    });
    return first;
}

std::optional<int> StrandTracer::strands_crossed(Vec3d origin, Vec3d direction, std::uint32_t own, int most) const {
    int crossed = 0;
    bool blocked = false;
    double nearest = std::numeric_limits<double>::infinity();
    StrandHit hit;
    along(origin, direction, nearest, [&](std::uint32_t piece) {
        if (!meets(piece, origin, direction, nearest, hit)) return true;
        if (hit.skin) blocked = true;
        else if (hit.index != own) ++crossed;
        return !blocked && crossed < most;
    });
    if (blocked) return std::nullopt;
    return crossed;
}

}  // namespace relievo
