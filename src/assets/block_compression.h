// Blocks of 4x4 texels in 8 or 16 bytes, as graphics devices read them: BC1 (colours), BC4 (one channel); BC3 is a BC4 of the alpha and a
// BC1 after it. Layouts: Direct3D 11.3 Functional Specification, chapter 19.5.
#pragma once

#include <array>
#include <cstdint>

namespace relievo {

// Rows top to bottom.
using GreyBlock = std::array<std::uint8_t, 16>;
using ColourBlock = std::array<std::array<std::uint8_t, 3>, 16>;

// Opaque, always in the mode of four colours, so that it may also stand in BC3. End colours along the axis on which the block's colours
// spread most, then fitted to what they stand for by least squares (as Brown 2006, "DXT Compression Techniques", and others do); blocks of
// one colour take the pair whose mixture is nearest.
std::array<std::uint8_t, 8> bc1_block(const ColourBlock& colours);

// Both modes are tried: eight steps between two ends, or six and exact 0 and 255.
std::array<std::uint8_t, 8> bc4_block(const GreyBlock& values);

// What devices make of them: mixtures of 8-bit ends, rounded to nearest.
ColourBlock decoded_bc1(const std::array<std::uint8_t, 8>& block);
GreyBlock decoded_bc4(const std::array<std::uint8_t, 8>& block);

}  // namespace relievo
