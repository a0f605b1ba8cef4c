// Which strands are copies of one another, as far as anyone can see.
#pragma once

#include "fur/roots.h"

#include <cstdint>
#include <span>
#include <vector>

namespace relievo {

// A number for each root, equal for roots that look alike: their own `chances` are equal and so are those of their three nearest neighbours,
// nearest first. `chances` are what sets a strand apart from others that stand as it does (strand_chance): one of 65,536, so that single
// strands do look alike, and four in a row do so only where fur repeats itself, by a texture or by numbers that have a period.
// What the nearest is may turn over by rounding: copies are found where they are exact to within rounding of the distances' order.
// Does not depend on `threads`.
std::vector<std::uint32_t> likeness(const Roots& roots, std::span<const std::uint32_t> chances, int threads = 0);

}  // namespace relievo
