// Fur frame by frame: on a turntable, from near to far, or in motion; and compared with the traced strands in each.
#pragma once

#include "core/image.h"
#include "core/progress.h"
#include "pipeline/fur_painter.h"
#include "pipeline/fur_steadiness.h"

#include <functional>
#include <optional>
#include <vector>

namespace relievo {

// From how far a frame is seen, in distances of the picture: from the first in the first frame to the last in the last, by equal factors.
struct FurDolly {
    double first = 1, last = 1;
};

struct FurFilm {
    int frames = 0;                 // 0: none
    double degrees = 0;             // that the mesh turns, from the first frame to the one after the last
    FurDolly dolly;
    bool swings = false;            // frames are 1 / frames_per_second apart, and forces move the fur meanwhile; else it stays as they hold it
    double frames_per_second = 25;
    double turns_per_second = 0;    // of the mesh where the fur swings, reached from rest within the first half second; counts beside `degrees`
    std::vector<int> passes;        // averaged into a picture; of several, the last are shown and each is compared. Empty: as the view has it
    int samples = 0;                // rays a pixel of the traced strands, to compare with; 0: none
    std::function<bool(int frame)> wanted;  // frames that are there already need not be shown; nothing: all are
    std::function<void(int frame, const Image8& picture)> shown;  // takes each frame, counted from 0
};

// What is filmed. The painter has loaded the fur.
struct FilmedFur {
    FurPainter& painter;
    GrownFur& fur;
    const Coat& coat;
    FurForces forces;               // told in the space of the mesh, or of the camera where the fur swings
    FurView view;                   // of the picture at distance 1
    bool layers_adapt = false;      // to each frame's distance; else they are the view's
};

// With samples, the strands are traced once in each frame, moved by the same pushes, and pictures of each number of passes are compared with that.
std::optional<FurSteadiness> film_fur(const FilmedFur& filmed, const FurFilm& film, int threads = 0, const Progress& progress = {});

// The frame of a film that is seen from the smallest distance, with the fewest layers that any frame has: what the painter is to be loaded for.
FurView nearest_view(const FurView& view, const FurFilm& film, FurKind kind, const Coat& coat, bool layers_adapt);

}  // namespace relievo
