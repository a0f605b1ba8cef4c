// How steady pictures of fur are from frame to frame, beside the traced strands.
#pragma once

#include "render/fur_frames.h"

#include <optional>
#include <vector>

namespace relievo {

// A mean over colours, in linear light before the backdrop, and over the pixels that fur covers in either of two frames or their references.
struct FurChange {
    double picture = 0;
    double reference = 0;  // of the traced strands
    double error = 0;      // of the difference between the two: what flickers
    double layers = 0;     // of the picture, by the change of its number of layers alone: what pops
};

// Of what a step changes, the most that the number of layers may change by itself. Meant for steps of 4 % of the distance and less.
inline constexpr double most_pop = 0.15;

struct FurSteadiness {
    int samples = 0;       // rays a pixel of the traced strands: what is steadier than they are cannot be told from their noise
    struct Row {
        int passes = 1;
        FurChange mean;    // over the steps; of `layers` over those that change them
        double worst_over_median = 1;  // of the error, the step that changes most over the median step
        double pop = 0;    // of the steps that change the number of layers, the largest share that this alone has in the picture's change
        bool inside() const { return mean.error <= mean.reference && pop <= most_pop; }
    };
    std::vector<Row> rows;  // as many as there are numbers of passes
    struct Step {
        double distance = 1;  // of the camera in the later frame, in those of the picture
        double layers = 0;    // there
        FurChange change;     // with the passes of the last row
    };
    std::vector<Step> steps;  // between frames
};

struct FilmedFrame {
    double distance = 1;
    double layers = 0;
    std::vector<FurFrames> pictures;           // one for each number of passes
    FurFrames reference;
    std::vector<FurFrames> as_layered_before;  // the pictures with the number of layers of the frame before; empty where it is the same
};

// Takes frames in their order and keeps no more than one.
class SteadinessMeter {
public:
    SteadinessMeter(std::vector<int> passes, int samples) : passes_(std::move(passes)), samples_(samples), changes_(passes_.size()) {}
    void add(FilmedFrame frame);
    std::optional<FurSteadiness> result() const;  // nothing of less than two frames

private:
    std::vector<int> passes_;
    int samples_ = 0;
    std::optional<FilmedFrame> before_;
    std::vector<std::vector<FurChange>> changes_;  // of each number of passes, in each step
    std::vector<FurSteadiness::Step> steps_;
};

}  // namespace relievo
