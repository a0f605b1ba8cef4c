// The mouse over the picture, and what is drawn over it: the divider and whose picture stands on which side.
#pragma once

#include "viewer/controls.h"

#include <string>

namespace relievo {

// Of the picture in the window, in points.
struct PictureArea {
    float x = 0;
    float y = 0;
    float width = 0;
    float height = 0;
};

class PictureInput {
public:
    // Between the beginning and the end of an ImGui frame, after the panel.
    void handle(Controls& controls, const PictureArea& area);
    void draw_split(const Controls& controls, const PictureArea& area, const std::string& reference_label) const;

private:
    enum class Drag { none, orbit, light, divider };
    Drag drag_ = Drag::none;
    bool near_divider_ = false;
};

}  // namespace relievo
