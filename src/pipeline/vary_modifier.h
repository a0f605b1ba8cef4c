// One modifier under every of its values, on the same pictures: what each costs and how far it is from the truth.
#pragma once

#include "core/progress.h"
#include "pipeline/material_source.h"
#include "scenes/view.h"
#include "techniques/modifiers.h"

#include <string>
#include <vector>

namespace relievo {

struct VarySettings {
    const Modifier* modifier = nullptr;
    std::vector<MaterialSource> materials;
    const Technique* technique = nullptr;  // null: the exact one, so that only the modifier errs
    std::vector<View> views;               // empty: all named ones
    DrawOptions options{};                 // of everything but the modifier that is varied
    std::string device;
    std::string pictures;                  // a folder for the pictures of every value and of the truth; empty: none are kept
    std::string sheet;                     // one picture of them all, as PNG: for every view the values on the first material, then the truth; empty: none
    int magnified = 1;                     // pixels of that picture for one of each
    int width = 448;
    int height = 252;
    int runs = 11;                         // timed runs of each value, interleaved
    int samples = 5;                       // samples per pixel of the pictures
    int truth_samples = 0;                 // of the truth; 0: the same samples as the pictures
    int threads = 0;
};

// One value on one picture.
struct VariedRow {
    std::string material;
    std::string view;
    std::string value;
    double flip = 0;          // mean LDR-FLIP against the truth
    double psnr_db = 0;
    double shadow_error = 0;  // mean |share of the key light - true share| over the pixels where both have a hit
    double gpu_ms = 0;        // median
};

struct Varied {
    std::string device;
    std::string truth;            // the options of the truth, in words
    std::vector<VariedRow> rows;  // by material, view and value, in the order of the table
};

// A material, view and numbers under which the values of a modifier differ to the eye, at the size of a figure. What it leaves open is
// left as it is.
VarySettings example_of(const Modifier& modifier);

// Throws Error where a material cannot be loaded, or a picture not be written.
Varied vary_modifier(const VarySettings& settings, const Progress& progress);

}  // namespace relievo
