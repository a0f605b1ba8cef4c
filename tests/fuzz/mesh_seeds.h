// Small files of every mesh format for fuzzing to start from, and changes to them that keep enough structure to get past the header.
#pragma once

#include "core/mesh.h"

#include <cstdint>
#include <random>
#include <string>
#include <vector>

namespace relievo::fuzz {

inline const std::vector<std::string> formats = {"obj", "ply", "off", "stl", "gltf", "rmesh", "gz"};

// Files of the format that load_mesh reads, among them every quirk the parsers know.
std::vector<std::string> seeds(const std::string& format);

// One to eight changes: bytes and bits, stretches removed, repeated, exchanged or moved over from another file, numbers replaced by
// awkward ones, counts in binary headers raised.
std::string mutated(const std::string& file, const std::string& other, std::mt19937_64& random);

// Parses the bytes; whatever is refused with an Error is fine, whatever is accepted must keep the promises of core/mesh.h and come
// out the same on one thread and on two. Aborts with a message where it does not. Whether it was accepted.
bool try_mesh(const std::string& format, std::string_view bytes);

}  // namespace relievo::fuzz
