// Labels that keep out of each other's way.
#pragma once

#include "figure/clip.h"
#include "figure/drawing.h"

#include <optional>
#include <string>
#include <vector>

namespace relievo {

class Labels {
public:
    explicit Labels(const Rect& room) : room_(room) {}

    // Nothing is written over this from now on.
    void keep_clear(const Rect& taken) { taken_.push_back(taken); }
    void keep_clear_line(Vec2d a, Vec2d b);

    // Beside the point, at the first of eight sides that is free; nothing where there is none, unless it must stand.
    void place(Drawing& drawing, Vec2d point, double distance, const std::string& text, Ink ink, double size, bool must = false, bool bold = false);

private:
    Rect room_;
    std::vector<Rect> taken_;
};

}  // namespace relievo
