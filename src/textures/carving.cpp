#include "textures/carving.h"

#include "textures/curves.h"
#include "textures/distance.h"

#include <algorithm>

namespace relievo {

namespace {

float stem_distance(const Groove& g, Vec2f p) {
    const Vec2f ab = g.b - g.a;
    const float whole = length(ab);
    const Vec2f along = ab / whole;
    const Vec2f from_a = p - g.a;
    const float t = dot(from_a, along);
    const float s = std::abs(from_a.x * along.y - from_a.y * along.x);
    float width = mix(g.width_a, g.width_b, saturate(t / whole));
    if (g.bracket > 0) {
        // Flares grow with the cube of nearness to the end: the bracketed serif of inscriptions.
        const float near_a = saturate(1 - t / g.bracket);
        const float near_b = saturate(1 - (whole - t) / g.bracket);
        width += g.flare_a * near_a * near_a * near_a + g.flare_b * near_b * near_b * near_b;
    }
    return std::max(s - width, std::abs(t - 0.5f * whole) - 0.5f * whole);
}

float leaf_distance(const Groove& g, Vec2f p) {
    const Vec2f ab = g.b - g.a;
    const float whole = length(ab);
    const Vec2f along = ab / whole;
    const Vec2f from_middle = p - (g.a + g.b) * 0.5f;
    const float t = dot(from_middle, along);
    const float s = std::abs(from_middle.x * along.y - from_middle.y * along.x);
    // Radius of the arcs through both ends that bulge by width_a.
    const float radius = (0.25f * whole * whole + g.width_a * g.width_a) / (2 * g.width_a);
    return length(Vec2f{s + radius - g.width_a, t}) - radius;
}

}  // namespace

float groove_distance(const Groove& g, Vec2f p) {
    switch (g.figure) {
        case Groove::Figure::stem:
            return stem_distance(g, p);
        case Groove::Figure::leaf:
            return leaf_distance(g, p);
        case Groove::Figure::ring:
            break;
    }
    const float ring = std::max(ellipse_distance(p - g.centre, g.outer), -ellipse_distance(p - g.inner_centre, g.inner));
    return std::max(ring, g.clip_x - p.x);
}

Carving::Carving(std::vector<Groove> grooves) : grooves_(std::move(grooves)), near_(buckets * buckets) {
    // Distances are not exact away from outlines, so a bucket's reach is generous.
    const float margin = 0.7072f / buckets * 1.5f + reach;
    for (int j = 0; j < buckets; ++j) {
        for (int i = 0; i < buckets; ++i) {
            const Vec2f middle{(static_cast<float>(i) + 0.5f) / buckets - 0.5f, (static_cast<float>(j) + 0.5f) / buckets - 0.5f};
            for (std::size_t k = 0; k < grooves_.size(); ++k) {
                if (groove_distance(grooves_[k], middle) <= margin)
                    near_[static_cast<std::size_t>(j * buckets + i)].push_back(static_cast<std::uint16_t>(k));
            }
        }
    }
}

Cut Carving::at(Vec2f p, float wall_uv, float ragged) const {
    const int i = std::clamp(floor_index((p.x + 0.5f) * buckets), 0, buckets - 1);
    const int j = std::clamp(floor_index((p.y + 0.5f) * buckets), 0, buckets - 1);
    Cut cut{0, reach};
    for (const std::uint16_t k : near_[static_cast<std::size_t>(j * buckets + i)]) {
        const Groove& g = grooves_[k];
        const float d = groove_distance(g, p) - ragged;
        cut.distance = std::min(cut.distance, d);
        if (d >= 0) continue;
        const float depth = g.section.wall * smooth_ramp(0, wall_uv, -d) + g.section.slope * std::max(0.0f, -d - 0.5f * wall_uv);
        cut.depth = std::max(cut.depth, std::min(depth, g.section.floor));
    }
    return cut;
}

}  // namespace relievo
