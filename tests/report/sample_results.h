// A comparison made for the report's tests: the catalogue's own functions run on a made-up relief, judged roughly. Its numbers are
// plausible, not published; what the tests need is results of the right shape, with pictures that can be looked at.
#pragma once

#include "report/results.h"

#include <filesystem>

namespace relievo::test {

struct SampleSettings {
    int width = 192;
    int height = 108;
    int materials = 2;
    bool pictures = true;  // false: rows without pictures and pixels
};

// Writes the pictures and pixel scripts into the folder and returns the results that refer to them.
Results sample_results(const std::filesystem::path& folder, const SampleSettings& settings = {});

// Results without pictures whose rows are made up by arithmetic alone, for size and speed.
Results many_rows(int materials, int settings_per_technique);

void write_text(const std::filesystem::path& path, const std::string& text);

}  // namespace relievo::test
