#include "textures/lettering.h"

namespace relievo {

namespace {

// In cap heights: half the widths of the stem and of the thin stroke. Trajan's letters have stems of about a tenth of the height.
constexpr float thick = 0.062f;
constexpr float thin = 0.034f;
constexpr float serif = 0.058f;
constexpr float bracket = 0.20f;

Groove stroke(Vec2f a, Vec2f b, float width_a, float width_b, float flare_a, float flare_b) {
    Groove g;
    g.a = a;
    g.b = b;
    g.width_a = width_a;
    g.width_b = width_b;
    g.flare_a = flare_a;
    g.flare_b = flare_b;
    g.bracket = bracket;
    return g;
}

Groove stem(float x) { return stroke({x, 0}, {x, 1}, thick, thick, serif, serif); }

// A thin horizontal from a stem at x, ending in a vertical serif.
Groove arm(float x, float end, float y, float flare) { return stroke({x, y}, {end, y}, thin, thin, 0, flare); }

Groove bow(Vec2f centre, Vec2f outer, Vec2f inner_centre, Vec2f inner, float clip_x) {
    Groove g;
    g.figure = Groove::Figure::ring;
    g.centre = centre;
    g.outer = outer;
    g.inner_centre = inner_centre;
    g.inner = inner;
    g.clip_x = clip_x;
    return g;
}

// Strokes with the baseline at y = 0 and the left edge at x = 0; returns the width. Round letters overshoot a little, or they would
// look smaller than their neighbours.
float letter(char c, std::vector<Groove>& strokes) {
    switch (c) {
        case 'I':
            strokes = {stem(0.12f)};
            return 0.24f;
        case 'L':
            strokes = {stem(0.12f), arm(0.12f, 0.54f, thin, 0.075f)};
            return 0.56f;
        case 'E':
            strokes = {stem(0.12f), arm(0.12f, 0.50f, 1 - thin, 0.065f), arm(0.12f, 0.43f, 0.52f, 0.055f),
                       arm(0.12f, 0.53f, thin, 0.075f)};
            return 0.55f;
        case 'V':
            strokes = {stroke({0.10f, 1}, {0.405f, 0}, thick, thick * 0.85f, serif, 0),
                       stroke({0.73f, 1}, {0.43f, 0}, thin, thin * 1.1f, serif, 0)};
            return 0.82f;
        case 'O':
            strokes = {bow({0.44f, 0.5f}, {0.44f, 0.515f}, {0.44f, 0.5f}, {0.305f, 0.455f}, -100)};
            return 0.88f;
        case 'R':
            strokes = {stem(0.12f), stroke({0.12f, 1 - thin}, {0.29f, 1 - thin}, thin, thin, 0, 0),
                       stroke({0.12f, 0.47f + thin}, {0.29f, 0.47f + thin}, thin, thin, 0, 0),
                       bow({0.28f, 0.735f}, {0.285f, 0.265f}, {0.265f, 0.735f}, {0.185f, 0.197f}, 0.28f),
                       stroke({0.30f, 0.50f}, {0.68f, 0.0f}, thin * 1.2f, thick, 0, serif * 0.7f)};
            return 0.70f;
        default:
            strokes.clear();
            return 0.3f;
    }
}

// Space between two letters: less where both lean away from each other.
float gap(char left, char right) {
    const bool open_left = left == 'V' || left == 'L';
    const bool open_right = right == 'V' || right == 'O';
    return 0.13f - (open_left ? 0.035f : 0.0f) - (open_right ? 0.02f : 0.0f);
}

}  // namespace

std::vector<Groove> inscription(std::string_view text, Vec2f centre, float cap_height, const Section& section) {
    std::vector<Groove> line;
    float x = 0;
    for (std::size_t k = 0; k < text.size(); ++k) {
        std::vector<Groove> strokes;
        const float width = letter(text[k], strokes);
        for (Groove& g : strokes) {
            for (Vec2f* point : {&g.a, &g.b, &g.centre, &g.inner_centre}) point->x += x;
            g.clip_x += x;
            line.push_back(g);
        }
        x += width + (k + 1 < text.size() ? gap(text[k], text[k + 1]) : 0.0f);
    }
    const Vec2f origin = centre - Vec2f{x, 1} * (0.5f * cap_height);
    for (Groove& g : line) {
        for (Vec2f* point : {&g.a, &g.b, &g.centre, &g.inner_centre}) *point = origin + *point * cap_height;
        for (Vec2f* size : {&g.outer, &g.inner}) *size *= cap_height;
        for (float* size : {&g.width_a, &g.width_b, &g.flare_a, &g.flare_b, &g.bracket}) *size *= cap_height;
        g.clip_x = origin.x + g.clip_x * cap_height;
        g.section = section;
    }
    return line;
}

}  // namespace relievo
