// The main job: every technique on every material from every view, against exact ground truth.
#pragma once

#include "core/progress.h"
#include "pipeline/material_source.h"
#include "render/gpu_renderer.h"
#include "report/results.h"
#include "scenes/view.h"

#include <string>
#include <vector>

namespace relievo {

// How far each technique is turned over its budget knob, beside its defaults: not at all; half and twice, in the first view; or an
// eighth to eight times in steps of two, in every view.
enum class Sweep { none, small, full };

struct CompareSettings {
    std::vector<MaterialSource> materials;   // empty: the procedural set, one scene each
    std::vector<const Technique*> techniques;  // empty: all
    std::vector<View> views;                 // empty: all named ones
    std::string out;                         // folder for the page, results and pictures; made if missing
    std::string device;                      // as GpuRenderer takes it
    std::string command;                     // for the manifest
    int width = 352;
    int height = 198;
    int runs = 11;                           // timed runs of each technique, interleaved
    int samples = 5;                         // samples per pixel of every picture and of the reference: 1, 5, 9 or 25
    DrawOptions options{};
    Sweep sweep = Sweep::small;              // more settings, for plots and equal-error tables
    bool use_cache = true;
    bool validation = false;
    int threads = 0;
};

// Writes out/index.html, results.json, results.csv, budgets.md (budget_table.h) and pictures/; each file appears whole or not at all. The numbers and
// pictures, times aside, do not depend on threads or on the run.
Results compare(const CompareSettings& settings, const Progress& progress);

// Sub-pixel sample positions, in pixels from the centre, the centre first: it alone (1), with a rotated square around it (5), or in
// the middle of a regular grid (9, 25).
std::vector<Vec2f> sample_offsets(int samples);

}  // namespace relievo
