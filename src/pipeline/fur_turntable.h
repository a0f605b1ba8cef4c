// Fur on a turntable: pictures from all around, and how steady they are.
#pragma once

#include "core/image.h"
#include "core/progress.h"
#include "fur/strand_curves.h"
#include "pipeline/fur_painter.h"

#include <functional>
#include <optional>
#include <span>

namespace relievo {

struct FurTurntable {
    int frames = 0;         // 0: none
    double degrees = 360;   // that the mesh turns from the first frame to the one after the last
    std::function<bool(int frame)> wanted;  // frames that are there already need not be drawn; nothing: all are
    std::function<void(int frame, const Image8& picture)> shown;  // takes each frame, counted from 0
};

// How the pictures change from frame to frame, in linear light before the backdrop, a mean over colours and over the pixels that
// fur covers in either of the two frames or their references.
struct FurSteadiness {
    double change = 0;            // of the picture
    double reference_change = 0;  // of the traced strands
    double error_change = 0;      // of the difference between the two: what flickers
    double worst_over_median = 0; // of the latter, the step that changes most over the median step: what pops
};

// The mesh turns counter-clockwise seen from above, under lights that stay with the camera. With curves (of the fur that the painter has) each frame is traced,
// too, with `samples` rays a pixel, and compared; then all frames are drawn.
std::optional<FurSteadiness> turn_fur(FurPainter& painter, const GrownFur& fur, const Coat& coat, const FurView& view, const FurTurntable& turntable, const StrandCurves* curves, int samples,
                                      int threads = 0, const Progress& progress = {});

}  // namespace relievo
