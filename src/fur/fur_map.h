// Where strands stand on a texture: the fur map of the thesis that the project started from (Evangelista 2009, Algorithm 4).
#pragma once

#include "core/image.h"

#include <cstdint>
#include <string_view>

namespace relievo {

// Within so many texels of a strand no other grows.
struct Neighbourhood {
    std::string_view id;
    double texels;
    std::string_view summary;
};
inline constexpr Neighbourhood neighbourhoods[] = {
    {"none", 0, "strands may stand side by side"},
    {"4", 1, "none beside a strand, above or below it"},
    {"8", 1.5, "nor diagonally: the square root of 2 lies below 1.5"},
};

struct FurMapSettings {
    int width = 256, height = 256;  // texels, positive
    double density = 0.1;           // strands per texel, [0,1]
    double apart = 0;               // texels, as in the table above; not negative
    std::uint32_t seed = 1;
};

struct FurMap {
    Image8 texels;              // RGBA: (255,255,255,255) where a strand stands, (255,255,255,0) elsewhere, so that no filter darkens its colour
    std::uint32_t strands = 0;
    std::uint32_t wanted = 0;   // density times area, rounded; more than `strands` where the neighbourhood leaves no room
};

// Strands at random texels that are free, until there are enough or none is free: each free texel is as likely as any other. The thesis'
// own loop draws texels until it has enough, and does not end where there is no room. The same for the same settings everywhere.
FurMap fur_map(const FurMapSettings& settings);

}  // namespace relievo
