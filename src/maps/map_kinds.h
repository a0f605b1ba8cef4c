// The table of maps: what can be baked from heights, and what for.
#pragma once

#include "core/map_set.h"

#include <span>
#include <string_view>

namespace relievo {

struct MapKind {
    Map map;
    std::string_view id;
    std::string_view title;
    std::string_view summary;   // what it holds and what a technique does with it
    std::string_view format;    // channels and unit
    std::string_view source;    // paper
};

std::span<const MapKind> map_kinds();
const MapKind* find_map_kind(std::string_view id);

}  // namespace relievo
