// How a picture of fur is judged: four numbers, the same for every way of growing it. Columns of tables, budgets and tests are loops over
// the table of them.
#pragma once

#include <limits>
#include <string_view>

namespace relievo {

// All are better small.
struct FurErrors {
    double flip = 0;                 // mean LDR-FLIP against the traced strands, backdrop included
    double coverage_error = 0;       // mean difference of coverage, over the pixels where either has any
    double gaps = 0;                 // share of the pixels more than half covered in the reference that are less than a quarter covered
    double density_p95_over_p5 = 0;  // of strands over the surface; infinite where a twentieth of it is bare
};

inline constexpr double not_promised = std::numeric_limits<double>::infinity();  // of a budget

struct FurMeasure {
    std::string_view id;     // in JSON and CSV
    std::string_view title;  // on pages and in the terminal
    int digits;              // behind the point
    double times;            // of the value, as shown to people
    double FurErrors::*value;
    std::string_view help;
};

inline constexpr FurMeasure fur_measures[] = {
    {"flip", "FLIP", 4, 1, &FurErrors::flip, "mean LDR-FLIP against the traced strands, backdrop included"},
    {"coverage_error", "coverage", 4, 1, &FurErrors::coverage_error, "mean difference of coverage where either picture has any"},
    {"gaps", "gaps %", 2, 100, &FurErrors::gaps, "of what the traced strands cover by more than half, the share less than a quarter covered"},
    {"density_p95_over_p5", "density", 2, 1, &FurErrors::density_p95_over_p5, "strands an area over the surface, 95th percentile over 5th"},
};

// Whether the measure is more than the budget has of it.
constexpr bool is_outside(const FurMeasure& measure, const FurErrors& measured, const FurErrors& budget) { return !(measured.*measure.value <= budget.*measure.value); }

constexpr bool inside_budget(const FurErrors& measured, const FurErrors& budget) {
    for (const FurMeasure& m : fur_measures)
        if (is_outside(m, measured, budget)) return false;
    return true;
}

}  // namespace relievo
