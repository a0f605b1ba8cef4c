// The font files inside the program; CMake writes the definitions (cmake/fonts.cmake).
#pragma once

#include <cstdint>

namespace relievo {

// The bytes of a TrueType file, four to a word, the first in the lowest bits.
extern const std::uint32_t font_regular[];
extern const std::uint32_t font_bold[];

}  // namespace relievo
