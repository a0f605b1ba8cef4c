#include "textures/ornament.h"

#include "textures/curves.h"

#include <array>

namespace relievo {

namespace {

void append(std::vector<Groove>& to, const std::vector<Groove>& more) { to.insert(to.end(), more.begin(), more.end()); }

Groove leaf(Vec2f a, Vec2f b, float width, const Section& section) {
    Groove g;
    g.figure = Groove::Figure::leaf;
    g.section = section;
    g.a = a;
    g.b = b;
    g.width_a = width;
    return g;
}

}  // namespace

Groove rule(Vec2f a, Vec2f b, float width, const Section& section) {
    Groove g;
    g.section = section;
    const Vec2f along = normalize(b - a);
    // Ends reach out by the width, so that rules which meet at a corner fill it.
    g.a = a - along * width;
    g.b = b + along * width;
    g.width_a = g.width_b = width;
    return g;
}

std::vector<Groove> square_rule(Vec2f c, float half, float width, const Section& section) {
    const std::array<Vec2f, 4> corner{Vec2f{-half, -half}, Vec2f{half, -half}, Vec2f{half, half}, Vec2f{-half, half}};
    std::vector<Groove> out;
    for (std::size_t k = 0; k < 4; ++k) out.push_back(rule(c + corner[k], c + corner[(k + 1) % 4], width, section));
    return out;
}

Groove circle(Vec2f centre, float radius, float width, const Section& section) {
    Groove g;
    g.figure = Groove::Figure::ring;
    g.section = section;
    g.centre = g.inner_centre = centre;
    g.outer = Vec2f(radius + width);
    g.inner = Vec2f(radius - width);
    return g;
}

std::vector<Groove> meander_frame(float inner, float outer, int keys, float width, const Section& section) {
    // One key on a grid of five columns and four rows: a base line, a riser, and the line that turns in on itself.
    constexpr std::array<std::array<Vec2f, 2>, 6> key{{
        {Vec2f{0, 0}, Vec2f{5, 0}},
        {Vec2f{0, 0}, Vec2f{0, 4}},
        {Vec2f{0, 4}, Vec2f{4, 4}},
        {Vec2f{4, 4}, Vec2f{4, 1.35f}},
        {Vec2f{4, 1.35f}, Vec2f{2, 1.35f}},
        {Vec2f{2, 1.35f}, Vec2f{2, 2.7f}},
    }};
    std::vector<Groove> out;
    const float step = 2 * inner / static_cast<float>(5 * keys);
    const float row = (outer - inner) / 4;
    // Four sides by quarter turns.
    constexpr std::array<std::array<int, 2>, 4> turn{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    for (const auto& [c, s] : turn) {
        const auto place = [&, cosine = static_cast<float>(c), sine = static_cast<float>(s)](Vec2f q) {
            const Vec2f p{-inner + q.x * step, -outer + q.y * row};
            return Vec2f{cosine * p.x - sine * p.y, sine * p.x + cosine * p.y};
        };
        for (int k = 0; k < keys; ++k) {
            for (const auto& [a, b] : key) {
                const Vec2f shift{static_cast<float>(5 * k) + 0.5f, 0};
                // The last base line stops at the frame's corner block.
                const Vec2f end = b.x == 5 && k == keys - 1 ? Vec2f{4, 0} : b;
                out.push_back(rule(place(a + shift), place(end + shift), width, section));
            }
        }
        const Vec2f block = place({-0.5f * (outer - inner) / step - 0.12f, 2});
        const float half = 0.5f * (outer - inner);
        append(out, square_rule(block, half, width, section));
        for (const Vec2f d : {Vec2f{1, 0}, Vec2f{0, 1}, Vec2f{-1, 0}, Vec2f{0, -1}}) {
            out.push_back(leaf(block + d * (0.08f * half), block + d * (0.74f * half), 0.19f * half,
                               {.wall = 0.2f, .slope = 60, .floor = 0.6f}));
        }
    }
    return out;
}

std::vector<Groove> rosette(Vec2f centre, float radius, int petals, const Section& section) {
    std::vector<Groove> out;
    for (int k = 0; k < petals; ++k) {
        const float turn = static_cast<float>(k) / static_cast<float>(petals);
        const Vec2f d{cos_turns(turn), sin_turns(turn)};
        const Vec2f between{cos_turns(turn + 0.5f / static_cast<float>(petals)),
                            sin_turns(turn + 0.5f / static_cast<float>(petals))};
        // Petals nearly touch: the ridge between them is the drawing.
        const float width = radius * 2.2f / static_cast<float>(petals);
        out.push_back(leaf(centre + d * (0.40f * radius), centre + d * radius, width, section));
        out.push_back(leaf(centre + between * (0.15f * radius), centre + between * (0.58f * radius), 0.62f * width, section));
    }
    Groove eye;
    eye.figure = Groove::Figure::ring;
    eye.section = section;
    eye.centre = eye.inner_centre = centre;
    eye.outer = Vec2f(0.12f * radius);
    eye.inner = Vec2f(0.05f * radius);
    out.push_back(eye);
    return out;
}

std::vector<Groove> laurel(Vec2f a, Vec2f b, float bow, int pairs, const Section& section) {
    std::vector<Groove> out;
    const Vec2f ab = b - a;
    const Vec2f side{-ab.y, ab.x};
    const float whole = length(ab);
    const auto at = [&](float t) { return a + ab * t + side * (4 * bow * t * (1 - t)); };
    const int parts = 14;
    for (int k = 0; k < parts; ++k) {
        const float t0 = static_cast<float>(k) / parts;
        const float t1 = static_cast<float>(k + 1) / parts;
        out.push_back(rule(at(t0), at(t1), whole * mix(0.011f, 0.006f, t0), {.wall = 0.30f, .slope = 20, .floor = 0.45f}));
    }
    for (int k = 0; k < pairs; ++k) {
        const float t = (static_cast<float>(k) + 0.35f) / static_cast<float>(pairs);
        const Vec2f root = at(t);
        const Vec2f along = normalize(at(t + 0.01f) - at(t - 0.01f));
        const Vec2f out_side{-along.y, along.x};
        const float size = whole * mix(0.27f, 0.18f, t);
        for (const float hand : {-1.0f, 1.0f}) {
            const Vec2f d = along * 0.80f + out_side * (0.60f * hand);
            out.push_back(leaf(root + d * (0.16f * size), root + d * size, 0.15f * size, section));
        }
    }
    const Vec2f tip = normalize(at(1.0f) - at(0.98f));
    out.push_back(leaf(b + tip * (0.01f * whole), b + tip * (0.17f * whole), 0.024f * whole, section));
    return out;
}

}  // namespace relievo
