// Lapped textures: one small square of strands pasted over a mesh again and again along its comb (Praun, Finkelstein and Hoppe 2000,
// "Lapped Textures"; for fur Lengyel, Praun, Finkelstein and Hoppe 2001, "Real-Time Fur over Arbitrary Surfaces").
#pragma once

#include "core/image.h"
#include "core/mesh.h"
#include "fur/map_strands.h"

#include <cstdint>
#include <vector>

namespace relievo {

struct LappedSettings {
    double radius = 0.2;     // of the disc around the patch, in the mesh's units; positive
    std::uint32_t seed = 1;  // of the order in which patches are pasted
};

struct Lapped {
    Mesh mesh;                          // all patches' faces in the order in which they were pasted, with normals and, in [0,1]^2, uvs
    std::vector<Vec3f> comb;            // of its vertices
    std::vector<std::uint32_t> face_of; // of each of its faces the one of `mesh` as given
    std::size_t patches = 0;
    double pasted_area = 0;             // of all faces of all patches, over that of the surface: 1 without laps
};

// Patches grow from faces that none covers yet, until none is left. A patch takes vertices in the order of their distance from its first
// face, each placed from the one before by the way between them in the frame of comb and normal there; then all places are smoothed, so that the
// differences along edges come near those ways in the least squares sense. It pastes the faces that touch its disc and are not yet covered; a
// face is covered when it lies in the part of the disc where the blob's edge never comes. The mesh has unit normals and should have
// edges well below the radius. Throws nothing; deterministic.
Lapped lapped(const Mesh& mesh, const std::vector<Vec3f>& comb, const LappedSettings& settings);

// A square of strands (fur_map), cut to a blob whose edge wavers between 0.75 and 1 of the disc, so that laps do not show as circles.
Image8 patch_texture(int size, double density, std::uint32_t seed);
inline constexpr double blob_inside = 0.75;  // of the disc's radius: within it the blob is whole

// Where the strands of the texture grow: roots on faces of the mesh that was lapped, `strands` the texels.
MapStrands lapped_strands(const Lapped& lapped, const Mesh& mesh, const Image8& texture);

}  // namespace relievo
