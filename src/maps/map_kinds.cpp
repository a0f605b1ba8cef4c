#include "maps/map_kinds.h"

#include <algorithm>

namespace relievo {

namespace {

constexpr MapKind table[] = {
    {Map::height, "height", "Height", "the declared surface, bilinear between texel centres", "1 channel, [0,1], 1 is the top", "Blinn 1978"},
    {Map::normal, "normal", "Normal", "unit normals of the relief at its height_scale, for shading and slope", "3 channels, tangent space, +Y along +v", "Cohen 1998"},
    {Map::colour, "colour", "Colour", "albedo under white light", "RGBA, sRGB", "Catmull 1974"},
    {Map::max_pyramid, "max_pyramid", "Pyramid of maxima", "largest corner height of 2^k x 2^k cells, so that whole regions are skipped safely", "1 channel, [0,1], a mip chain", "Tevs 2008"},
    {Map::cone, "cone", "Cone", "widest upward cone over each texel that holds no other texel", "height and UV radius per unit of height, at most 1", "Dummer 2006"},
};
static_assert(std::size(table) == map_count);

}  // namespace

std::span<const MapKind> map_kinds() { return table; }

const MapKind* find_map_kind(std::string_view id) {
    const auto it = std::ranges::find(table, id, &MapKind::id);
    return it == std::end(table) ? nullptr : it;
}

}  // namespace relievo
