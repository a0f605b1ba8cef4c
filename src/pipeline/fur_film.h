// Fur in motion, frame by frame.
#pragma once

#include "core/image.h"
#include "fur/fur_motion.h"
#include "pipeline/fur_painter.h"

#include <functional>

namespace relievo {

struct FurFilm {
    int frames = 0;                 // 0: none
    double frames_per_second = 25;
    double turns_per_second = 0;    // of the mesh around its vertical axis, reached from rest within the first half second
    std::function<void(int frame, const Image8& picture)> shown;  // takes each frame, counted from 0
};

// Draws the fur that the painter has loaded. Begins as gravity alone holds it; the wind sets in with the first
// frame, in gusts. `forces` are told in the space of the camera, in which the mesh turns: its `time` and `spin` are not looked at.
void film_fur(FurPainter& painter, const FurView& view, const FurForces& forces, const FurFilm& film, int threads = 0);

}  // namespace relievo
