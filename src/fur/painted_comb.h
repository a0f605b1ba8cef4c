// Which way fur lies where somebody has painted it.
#pragma once

#include "core/image.h"
#include "core/mesh.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace relievo {

// What a user has painted: nothing, the colours at the mesh's vertices, or a picture over its texture coordinates.
struct CombPaint {
    std::string file;                       // of the picture
    std::shared_ptr<const ImageF> picture;  // read from it by whoever asks for the comb; row 0 is the bottom, values in [0,1]
    bool colours = false;                   // the vertices' own
    bool empty() const { return file.empty() && !picture && !colours; }
};

// At one vertex: how strongly the painted direction holds there, and that direction times this weight. Both can be interpolated.
struct PaintedLean {
    Vec3f weighted;    // in fur space and in the skin; of length 1 at weight 1 where strands lean as far as the coat says, shorter where less
    float weight = 0;  // 0: the comb as it is; 1: the painted one
};

// For each vertex what is painted there; empty where the paint is empty or its weight is 0 everywhere. The mesh has unit normals and what colours and texture
// coordinates its file has. Places that several vertices share get the mean of what is painted at their faces' corners.
//
// A picture is a flow map in the tangent frame of normal maps (mesh/tangents.h): red toward growing u and green toward growing v, each (byte - 128) / 127, so that 128 is
// none. Its length is how strongly strands lean, at most 1. The weight is alpha, or blue in a picture without alpha. It is read bilinearly at the vertices, and
// repeats outside [0,1].
//
// Vertex colours are a direction in space, for meshes without texture coordinates: red along x, green along y, blue along z by the same code, laid into the skin. Its
// length, at most 1, is the weight: mid-grey is unpainted.
//
// Throws Error for pictures on meshes without texture coordinates, for pictures of fewer than three channels, and for meshes without colours.
std::vector<PaintedLean> painted_leans(const Mesh& mesh, const CombPaint& paint);

// The comb, as `combed` has it, of fur that stands upright where nothing is painted. The mesh has unit normals; a lean for each of its vertices, or none.
std::vector<Vec3f> upright_but_for(const Mesh& mesh, std::span<const PaintedLean> painted);

}  // namespace relievo
