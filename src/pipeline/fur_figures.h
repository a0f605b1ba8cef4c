// The figures of the chapters on fur, on a made-up scan, a torus and a bulging sheet.
#pragma once

#include <filesystem>
#include <string>

namespace relievo {

// fur-addressing.png: the three addressings; fur-maps.png: cubes of two sizes and a disc; fur-modes.png: every mode and the traced
// strands; fur-plotted.png: strands in shells, plotted and traced; fur-combed.png: a flow map,
// fur without it, with it, and traced. Throws Error.
void write_fur_figures(const std::filesystem::path& folder, const std::string& device, int threads);

}  // namespace relievo
