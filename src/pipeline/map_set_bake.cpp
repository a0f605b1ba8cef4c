#include "pipeline/map_set_bake.h"
#include "maps/cone_map.h"
#include "maps/max_pyramid.h"
#include "maps/mip_chain.h"
#include "maps/normal_map.h"
#include <algorithm>
namespace relievo {
BakedMaps bake_maps(Material material, std::span<const Map> wanted, const BakeOptions& options) {
    BakedMaps b;
    b.height_scale = material.height_scale; b.zero_level = material.zero_level; b.notes = material.notes;
    if (material.physical_size_m) b.physical_size_m = *material.physical_size_m;
    const auto wants = [&](Map m) { return std::ranges::find(wanted, m) != wanted.end(); };
    b.maps.height = std::move(material.height);
    if (wants(Map::normal)) b.maps.normal = normal_mip_chain(material.normal ? std::move(*material.normal) : normal_map(b.maps.height, b.height_scale, options.threads), options.threads);
    if (wants(Map::colour)) b.maps.colour = colour_mip_chain(material.colour ? std::move(*material.colour) : Image8(1, 1, 4, 188), options.threads);
    if (wants(Map::max_pyramid)) b.maps.max_pyramid = max_pyramid(b.maps.height, options.threads);
    if (wants(Map::cone)) b.maps.cone = cone_map(b.maps.height, options.threads, options.progress);
    return b;
}
}
