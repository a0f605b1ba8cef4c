// The options of `relievo fur --mode classic` and `--mode lapped`.
#pragma once

#include "fur/coat.h"
#include "pipeline/classic_picture.h"
#include "pipeline/lapped_picture.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace relievo {

struct ClassicOptions {
    std::string map = "cube", addressing = "normal_plus_position", neighbourhood = "none", colour_map, fur_map, tinted_map, dds_code = "bc3";
    int map_size = 256;
    std::uint32_t seed = 1;
    bool filtered = false;
};

void add_classic_options(CLI::App& verb, ClassicOptions& options);

// height and density in percent, 0: the default; `set` as NAME=VALUE. Throws UsageError.
ClassicSettings classic_settings(const ClassicOptions& options, const FurSettings& common, double height, double density, const std::vector<std::string>& set);

// Of mode lapped: the coat and the seed.
LappedFurSettings lapped_settings(const ClassicOptions& options, const FurSettings& common);

// The names that --set knows, a line each.
std::string classic_knob_list();

nlohmann::ordered_json classic_report(const FurPicture& picture);

}  // namespace relievo
