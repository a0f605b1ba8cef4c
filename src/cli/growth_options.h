// What `relievo fur` takes to say how fur grows and where its strands go, beside the coat's own settings.
#pragma once

#include "pipeline/fur_picture.h"

#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace relievo {

// The comb that --comb names; its picture is not read.
void add_comb_option(CLI::App& verb, std::string& comb);
CombPaint comb_paint_of(const std::string& comb);

struct GrowthOptions {
    std::vector<std::string> where;     // rules of length
    std::string comb;                   // picture, or "colours"
    std::vector<std::string> exported;  // files
    int pieces = 8, atlas = 0;
    int turntable = 0;
    std::optional<double> turn;  // nothing: once around, or not at all where the camera moves away
    std::string dolly;
    double gravity = 0, gusts = 0.6, spin = 0;
    std::vector<double> wind;
    int frames = 0;
};

void add_growth_options(CLI::App& verb, GrowthOptions& options);

// The rules that --grow-where asks for. Throws UsageError.
std::vector<LengthRule> length_rules_of(const GrowthOptions& options);

// The forces that --gravity and --wind ask for.
void take_forces(const GrowthOptions& options, FurSettings& settings);

// The frames that --animate or --turntable asks for, written beside `out` with their number before its ending; those of a turntable are kept with
// `words`, which name all that they depend on, beside them. Throws UsageError and Error.
void take_film(const GrowthOptions& options, const std::string& out, const std::string& words, FurSettings& settings);

// What --grow-where knows, a line each.
std::string length_rule_list();

// Writes what --export names and says so. Throws Error.
void export_as_asked(const std::string& mesh, const GrowthOptions& options, const FurSettings& fur, bool quiet);

}  // namespace relievo
