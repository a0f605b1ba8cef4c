// Which map of a material a file holds, told by its name: the habits of the common texture sites and games in one table.
#pragma once

#include <span>
#include <string_view>

namespace relievo {

enum class MapRole { colour, height, normal, ignored };  // ignored: known, of no use here (roughness, occlusion, ...)

struct MapName {
    std::string_view word;  // lower case; words of two parts stand joined: "nor_gl", "NorGL", "nor-gl" are "norgl"
    MapRole role;
    int rank = 0;                   // among several files of one role the lowest rank wins
    std::string_view meaning = {};  // what the name promises beyond the role: "depth" (white is low), "up", "down" (green)
};

std::span<const MapName> map_names();

// The entry for a file name without its ending ("rock_nor_gl_4k"), or nullptr. The name is split at every character that is not a
// letter or digit and before a capital after a small letter; trailing digits of a part are dropped. The last part (or two or three
// parts joined) that is a word of the table decides: "wall_rough_disp_4k" is a height. One-letter words count only as the last
// part of several.
const MapName* find_map_name(std::string_view stem);

}  // namespace relievo
