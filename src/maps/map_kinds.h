// The table of maps: what can be baked from heights, and what for.
#pragma once

#include "core/map_set.h"

#include "core/progress.h"
#include "maps/safe_rounding.h"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace relievo {

struct MapBake {
    float height_scale;  // UV units
    int threads;         // 0: all cores; no map depends on it
    const Progress& progress;
};

struct MapChannel {
    std::string_view name;  // in EXR files; empty: there is no such channel
    Rounding rounding = Rounding::nearest;
};

struct MapKind {
    Map map;
    std::string_view id;
    std::string_view title;
    std::string_view summary;   // what it holds and what a technique does with it
    std::string_view format;    // channels and unit
    std::string_view source;    // paper
    std::array<MapChannel, 4> channels{};
    void (*bake)(MapSet&, const MapBake&) = nullptr;  // from the set's heights; null: the material brings it
    ImageF MapSet::*image = nullptr;  // where the map is one image: what is written to files and kept in the cache
    std::uint32_t cached_version = 0;  // raised whenever the baker's output changes in any bit; 0: faster to bake than to read
};

std::span<const MapKind> map_kinds();
const MapKind& map_kind(Map map);
const MapKind* find_map_kind(std::string_view id);

}  // namespace relievo
