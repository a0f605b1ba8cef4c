// A line drawing as a value: what to draw, in which role. Writers (svg.h, raster.h) know what a role looks like on light and dark
// paper, so that one drawing serves both.
#pragma once

#include "core/vec.h"

#include <string>
#include <variant>
#include <vector>

namespace relievo {

// What a mark means; its colours stand in ink.cpp.
enum class Ink { paper, text, muted, grid, ground, surface, ray, above, below, cone, node, opened, cell, secant, sphere, normal, found, truth };
inline constexpr int ink_count = 18;

// Of dashed lines, in pixels.
inline constexpr double dash_length = 5;
inline constexpr double dash_gap = 4;

// Lines and areas, in pixels from the top left corner.
struct Path {
    std::vector<Vec2d> points;
    bool closed = false;
    Ink ink = Ink::text;
    double width = 0;     // of the line; 0: no line
    double opacity = 1;   // of the line
    double fill = 0;      // opacity of the area; 0: not filled
    bool dashed = false;
};

struct Dot {
    Vec2d centre;
    double radius = 3;
    Ink ink = Ink::text;
    bool hollow = false;  // a ring, with paper inside
    double width = 1.5;   // of the ring's line, or of the rim of paper that sets a full dot apart from what lies under it
};

enum class Anchor { start, middle, end };

struct Label {
    Vec2d at;  // on the base line
    std::string text;  // UTF-8
    Ink ink = Ink::text;
    double size = 12;
    Anchor anchor = Anchor::start;
    bool bold = false;
};

using Mark = std::variant<Path, Dot, Label>;

struct Drawing {
    double width = 0;
    double height = 0;
    std::string title;        // for those who hear the figure instead of seeing it
    std::string description;
    std::vector<Mark> marks;  // later ones lie over earlier ones
};

enum class Paper { light, dark, either };  // either: as the reader's system prefers (SVG only)

}  // namespace relievo
