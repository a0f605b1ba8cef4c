// What `relievo fur` takes to say how fur grows and where its strands go, beside the coat's own settings.
#pragma once

#include "pipeline/fur_picture.h"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace relievo {

struct GrowthOptions {
    std::vector<std::string> where;     // rules of length
    std::vector<std::string> exported;  // files
    int pieces = 8, atlas = 0;
    int turntable = 0;
    double turn = 360;
    double gravity = 0, gusts = 0.6, spin = 0;
    std::vector<double> wind;
    int frames = 0;
};

void add_growth_options(CLI::App& verb, GrowthOptions& options);

// The rules that --grow-where asks for. Throws UsageError.
std::vector<LengthRule> length_rules_of(const GrowthOptions& options);

// The forces that --gravity and --wind ask for, and the frames of --animate, written beside `out` with their number before its ending. Throws UsageError.
void take_motion(const GrowthOptions& options, const std::string& out, FurSettings& settings);

// What --turntable asks for, its frames named alike; `words` name all that they depend on, and are kept beside them. Throws UsageError and Error.
void take_turntable(const GrowthOptions& options, const std::string& out, const std::string& words, FurSettings& settings);

// What --grow-where knows, a line each.
std::string length_rule_list();

// Writes what --export names and says so. Throws Error.
void export_as_asked(const std::string& mesh, const GrowthOptions& options, const FurSettings& fur, bool quiet);

}  // namespace relievo
