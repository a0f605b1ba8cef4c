// All maps of a field at one height_scale, from the bakers that the program uses.
#pragma once

#include "maps/map_kinds.h"

namespace relievo::contract {

inline MapSet baked_maps(const HeightField& field, float height_scale) {
    MapSet maps;
    maps.height = field;
    for (const MapKind& kind : map_kinds())
        if (kind.bake != nullptr) kind.bake(maps, {.height_scale = height_scale, .threads = 0, .progress = {}});
    return maps;
}

}  // namespace relievo::contract
