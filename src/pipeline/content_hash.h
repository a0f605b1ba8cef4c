// Names for contents: equal bytes, equal name, on every machine and in every run.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace relievo {

using Digest = std::array<std::uint8_t, 32>;

// SHA-256 (FIPS 180-4). A cache must not mix up two maps even where somebody tries, and its test vectors are everybody's.
Digest sha256(std::span<const std::byte> bytes);

// The digest of the digests of pieces of 1 MiB, which several threads can make; not the SHA-256 of the bytes.
Digest content_digest(std::span<const std::byte> bytes, int threads = 0);

// Lower-case hexadecimal.
std::string hex(std::span<const std::uint8_t> bytes);

}  // namespace relievo
