// Classical ornament as grooves: meander, rosette, laurel, rules.
#pragma once

#include "textures/carving.h"

#include <vector>

namespace relievo {

// Coordinates are UV about the tile's centre, widths are halves.

// A rule from a to b.
Groove rule(Vec2f a, Vec2f b, float width, const Section& section);

// A square of four rules, `half` from the centre to the middle of each.
std::vector<Groove> square_rule(Vec2f centre, float half, float width, const Section& section);

Groove circle(Vec2f centre, float radius, float width, const Section& section);

// A frame of Greek key between the squares of half edge `inner` and `outer`, `keys` to a side, with a square block in each corner.
std::vector<Groove> meander_frame(float inner, float outer, int keys, float width, const Section& section);

// Petals about a centre: an outer wreath of `petals`, an inner one turned by half a petal, and an eye.
std::vector<Groove> rosette(Vec2f centre, float radius, int petals, const Section& section);

// A bough from a to b, bowed sideways by `bow` of its length, with pairs of leaves.
std::vector<Groove> laurel(Vec2f a, Vec2f b, float bow, int pairs, const Section& section);

}  // namespace relievo
