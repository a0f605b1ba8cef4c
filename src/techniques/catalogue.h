// The table of techniques, in order of year. Everything that lists, draws, tests, measures or documents them is a loop over it.
#pragma once

#include "techniques/technique.h"

#include <span>
#include <string_view>

namespace relievo {

std::span<const Technique> techniques();

// The technique with this id, or null.
const Technique* find_technique(std::string_view id);

}  // namespace relievo
