// A mesh file in fur, as a picture.
#pragma once

#include "core/image.h"
#include "core/progress.h"
#include "fur/coat.h"
#include "fur/evenness.h"
#include "fur/fur_motion.h"
#include "pipeline/fur_film.h"
#include "fur/fur_modes.h"
#include "pipeline/fur_score.h"
#include "pipeline/fur_steadiness.h"
#include "render/fur_frames.h"
#include "render/layers_renderer.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace relievo {

struct FurSettings {
    FurKind mode = FurKind::strands;  // or shells
    std::string preset;     // empty: the first
    Coat coat;              // as the preset says, changed by options
    Growth growth;          // where fur is shorter and which way it lies; pictures are read here
    FurForces forces;       // that hold the fur in the picture, in the space of the mesh
    FurFilm film;           // drawn after the picture, under the same forces
    int layers = 0;         // 0: as many as the length of the fur in the picture asks for
    int width = 1280, height = 800;
    int passes = 16;        // averaged into the picture
    std::string device;
    bool measure = false;   // how even the strands are
    int reference_samples = 0;  // rays a pixel of a picture of the same strands as curves, to compare with; 0: none
    int threads = 0;
};

struct FurTimes {  // milliseconds
    double load = 0, prepare = 0, roots = 0, grid = 0, first_frame = 0, frame_median = 0;
};

struct FurPicture {
    FurKind mode = FurKind::strands;
    std::size_t faces = 0, strands = 0;
    double bare = 0;  // share of the surface where nothing grows, as roots that were left out tell
    int layers = 0, passes = 0;
    std::size_t layer_faces = 0;  // of the mesh that was pushed out
    std::optional<Evenness> evenness;
    std::optional<FurScore> score;
    std::optional<FurSteadiness> steadiness;  // of the film, where it was compared
    std::optional<LayersLight> light;  // of mode classic
    std::vector<FurStages> stages;  // of the first frame and of the last; empty where they are not told apart
    FurTimes ms;  // first_frame: from the loaded mesh to the first whole picture in memory, all steps in between included
    std::string device;
    FurFrames frames;  // of the picture
    Image8 picture;  // sRGB, rows top to bottom
    Image8 beside;   // the same and the reference to its right, where there is one
    std::vector<std::string> notes;
};

// Throws Error.
void write_fur_picture(const std::filesystem::path& png, const Image8& picture);
FurPicture fur_picture(const std::filesystem::path& mesh, const FurSettings& settings, const Progress& progress = {});

}  // namespace relievo
