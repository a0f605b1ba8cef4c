// Strands as files that other programs open: Cem Yuksel's .hair, OBJ lines, PLY edges.
#pragma once

#include "core/vec.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace relievo {

// Polylines in a row: strand after strand, each from root to tip.
struct StrandLines {
    std::vector<std::uint32_t> pieces;  // straight ones of each strand, 1 to 65535
    std::vector<Vec3f> points;          // one more than pieces for each strand
    std::vector<float> radii;           // at the points, in their units
    std::vector<Vec3f> colours;         // at the points, linear light in [0,1]
};

// Writes .hair, .obj or .ply as the ending says; the file appears whole or not at all. Points are written bit by
// bit (in OBJ as the shortest digits that name the same float), colours sRGB-encoded. Throws Error, for other endings and for strands of too many
// pieces too.
void save_strands(const std::filesystem::path& file, const StrandLines& lines, int threads = 0);

// The bytes of such a file.
// .hair (cemyuksel.com/research/hairmodels, "HAIR File Format Specification"): thickness is the whole width of a strand.
std::string write_hair(const StrandLines& lines);
// v with colour and one l element a strand. OBJ has no place for radii.
std::string write_strands_obj(const StrandLines& lines, int threads = 0);
// Binary little-endian: vertex (x y z radius red green blue) and edge (vertex1 vertex2).
std::string write_strands_ply(const StrandLines& lines);

}  // namespace relievo
