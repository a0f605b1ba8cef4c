#include "maps/map_kinds.h"

#include "maps/cell_cone.h"
#include "maps/cone_map.h"
#include "maps/conservative_cone.h"
#include "maps/distance_map.h"
#include "maps/horizon_map.h"
#include "maps/max_pyramid.h"
#include "maps/mip_chain.h"
#include "maps/normal_map.h"
#include "maps/relaxed_cone.h"
#include "maps/robust_cone.h"

#include <algorithm>

namespace relievo {

namespace {

constexpr MapKind table[] = {
    {
        .map = Map::height,
        .id = "height",
        .title = "Height",
        .summary = "the declared surface, bilinear between texel centres",
        .format = "1 channel, [0,1], 1 is the top",
        .source = "Blinn 1978",
        .channels = {{{"height"}}},
    },
    {
        .map = Map::normal,
        .id = "normal",
        .title = "Normal",
        .summary = "unit normals of the relief at its height_scale, for shading and slope",
        .format = "3 channels, tangent space, +Y along +v",
        .source = "Cohen 1998",
        .channels = {{{"normal.X"}, {"normal.Y"}, {"normal.Z"}}},
        .bake = [](MapSet& maps, const MapBake& b) { maps.normal = normal_mip_chain(normal_map(maps.height, b.height_scale, b.threads), b.threads); },
    },
    {
        .map = Map::colour,
        .id = "colour",
        .title = "Colour",
        .summary = "albedo under white light",
        .format = "RGBA, sRGB",
        .source = "Catmull 1974",
    },
    {
        .map = Map::max_pyramid,
        .id = "max_pyramid",
        .title = "Pyramid of maxima",
        .summary = "largest corner height of 2^k x 2^k cells, so that whole regions are skipped safely",
        .format = "1 channel, [0,1], a mip chain",
        .source = "Tevs 2008",
        .channels = {{{"maximum", Rounding::up}}},
        .bake = [](MapSet& maps, const MapBake& b) { maps.max_pyramid = max_pyramid(maps.height, b.threads); },
    },
    {
        .map = Map::cone,
        .id = "cone",
        .title = "Cone",
        .summary = "widest upward cone over each texel that holds no other texel",
        .format = "height and UV radius per unit of height, at most 1",
        .source = "Dummer 2006",
        .channels = {{{"height"}, {"ratio", Rounding::down}}},
        .bake = [](MapSet& maps, const MapBake& b) { maps.cone = cone_map(maps.height, b.threads, b.progress); },
        .image = &MapSet::cone,
        .cached_version = 1,
    },
    {
        .map = Map::conservative_cone,
        .id = "conservative_cone",
        .title = "Conservative cone",
        .summary = "widest upward cone over each texel that no point of the bilinear surface enters",
        .format = "height and UV radius per unit of height, at most 1",
        .source = "after Dummer 2006",
        .channels = {{{"height", Rounding::up}, {"ratio", Rounding::down}}},
        .bake = [](MapSet& maps, const MapBake& b) { maps.conservative_cone = conservative_cone(maps.height, b.threads, b.progress); },
        .image = &MapSet::conservative_cone,
        .cached_version = 2,
    },
    {
        .map = Map::relaxed_cone,
        .id = "relaxed_cone",
        .title = "Relaxed cone",
        .summary = "widest upward cone over each texel in which no ray from its axis leaves the solid, so that a leap ends before or in what it hits first",
        .format = "height and UV radius per unit of height, at most 1",
        .source = "Policarpo 2007",
        .channels = {{{"height", Rounding::up}, {"ratio", Rounding::down}}},
        .bake = [](MapSet& maps, const MapBake& b) { maps.relaxed_cone = relaxed_cone(maps.height, b.threads, b.progress); },
        .image = &MapSet::relaxed_cone,
        .cached_version = 2,
    },
    {
        .map = Map::robust_cone,
        .id = "robust_cone",
        .title = "Robust cone",
        .summary = "least sampled cone of each texel and its eight neighbours, for any point of the texel's square",
        .format = "height and UV radius per unit of height, at most 1",
        .source = "Ban 2024",
        .channels = {{{"height", Rounding::up}, {"ratio", Rounding::down}}},
        .bake = [](MapSet& maps, const MapBake& b) {
            maps.robust_cone = maps.cone.empty() ? robust_cone(maps.height, b.threads, b.progress) : robust_cone_of(maps.cone, b.threads);
        },
        .image = &MapSet::robust_cone,
        .cached_version = 1,
    },
    {
        .map = Map::horizon,
        .id = "horizon",
        .title = "Horizon",
        .summary = "elevation under which the surface hides the sky, in 32 directions, for shadows",
        .format = "32 channels, [0,1]: the angle over 90 degrees of a relief of 0.1",
        .source = "Max 1988",
        .channels = {{{"horizon", Rounding::up}}},
        .bake = [](MapSet& maps, const MapBake& b) { maps.horizon = horizon_map(maps.height, b.threads, b.progress); },
        .image = &MapSet::horizon,
        .cached_version = 2,
    },
    {
        .map = Map::distance,
        .id = "distance",
        .title = "3D distance",
        .summary = "Euclidean distance to the relief from points of the slab, rounded down so that a sphere of that radius is empty wherever it is read",
        .format = "heights, in the height-scaled metric; 64 slices stacked upward, at most 512 x 512 voxels each",
        .source = "Donnelly 2005",
        .channels = {{{"distance", Rounding::down}}},
        .bake = [](MapSet& maps, const MapBake& b) { maps.distance = distance_map(maps.height, b.height_scale, b.threads, b.progress); },
        .image = &MapSet::distance,
    },
    {
        .map = Map::cell_cone,
        .id = "cell_cone",
        .title = "Cell cone",
        .summary = "terraced cone over each bilinear cell toward each quadrant that holds nothing of the surface: roofs over the cells ahead",
        .format = "largest corner, highest of the cells up to 2, 8 and 32 ahead; 4 quadrants stacked upward",
        .source = "relievo 2026",
        .channels = {{{"maximum", Rounding::up}, {"near_roof", Rounding::up}, {"middle_roof", Rounding::up}, {"far_roof", Rounding::up}}},
        .bake = [](MapSet& maps, const MapBake& b) { maps.cell_cone = cell_cone_map(maps.height, b.threads, b.progress); },
        .image = &MapSet::cell_cone,
    },
};
constexpr bool in_order_of_maps() {
    for (const Map map : every_map)
        if (table[index_of(map)].map != map) return false;
    return true;
}
static_assert(std::size(table) == map_count && in_order_of_maps(), "one row a map, in the order of enum Map");

}  // namespace

std::span<const MapKind> map_kinds() { return table; }

const MapKind& map_kind(Map map) { return table[index_of(map)]; }

const MapKind* find_map_kind(std::string_view id) {
    const auto it = std::ranges::find(table, id, &MapKind::id);
    return it == std::end(table) ? nullptr : it;
}

}  // namespace relievo
