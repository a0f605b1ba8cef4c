// All maps of a field at one height_scale, from the bakers that the program uses.
#pragma once

#include "maps/cone_map.h"
#include "maps/max_pyramid.h"
#include "maps/mip_chain.h"
#include "maps/normal_map.h"

namespace relievo::contract {

inline MapSet baked_maps(const HeightField& field, float height_scale) {
    MapSet maps;
    maps.height = field;
    maps.normal = normal_mip_chain(normal_map(field, height_scale));
    maps.max_pyramid = max_pyramid(field);
    maps.cone = cone_map(field);
    return maps;
}

}  // namespace relievo::contract
