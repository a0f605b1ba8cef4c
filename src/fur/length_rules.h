// How long fur grows where: a share of the coat's length for every vertex, the product of rules.
#pragma once

#include "core/image.h"
#include "core/mesh.h"
#include "mesh/bounds.h"

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace relievo {

// What a rule looks at.
enum class LengthQuantity { up, height, curvature, distance, noise, red, green, blue, grey, mask };

// What is written behind the @ of a rule.
enum class LengthArgument { none, place, size, file };

struct LengthQuantityEntry {
    LengthQuantity quantity;
    std::string_view id;
    double from, to;  // unless the rule says otherwise
    LengthArgument argument;
    std::string_view help;
};
std::span<const LengthQuantityEntry> length_quantities();

// The share is 0 where the quantity is `from` or beyond and 1 where it is `to` or beyond, and rises smoothly in between; `from` may be the larger
// one, which turns the rule round.
struct LengthRule {
    LengthQuantity quantity = LengthQuantity::up;
    double from = 0, to = 1;
    Vec3d place;       // for distance, in the space of the mesh's file
    double size = 0.2; // of noise's hills, in radii
    std::string file;  // for mask
    std::shared_ptr<const ImageF> mask;  // read from it by whoever asks for shares; row 0 is the bottom
};

// "NAME", "NAME=FROM..TO", "NAME@ARGUMENT" or "NAME=FROM..TO@ARGUMENT". Throws UsageError.
LengthRule length_rule(const std::string& text);

// Below this share of the coat's length nothing grows: the skin is bare.
inline constexpr float shortest_share = 0.02f;

// For each vertex the product of what the rules say there, in [0,1]; no rules: empty, which stands for 1 everywhere. The mesh is in fur
// space, with unit normals and what colours and texture coordinates its file has; `sphere` is what became the unit sphere. Vertices at one
// place get the same share but for what their colours and texture coordinates make of it. A mask is read bilinearly, its edge repeated
// outwards, at the texture coordinates, or, where the mesh has none, where a light along z throws it onto the box of x and y.
// Throws Error for rules that ask for colours of a mesh without any. Does not depend on `threads`.
std::vector<float> length_shares(const Mesh& mesh, const Sphere& sphere, std::span<const LengthRule> rules, int threads = 0);

// Mean curvature at each vertex by the normals at the ends of its edges, in 1/radius of the mesh's units: 1 on the unit sphere, positive where the
// skin bulges. 0 where there are no edges.
std::vector<float> mean_curvature(const Mesh& mesh, int threads = 0);

}  // namespace relievo
