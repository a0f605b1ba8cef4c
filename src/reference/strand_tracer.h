// Rays against many thin round strands and the skin under them: the truth that layers of fur are compared with.
#pragma once

#include "core/mesh.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace relievo {

// Straight pieces in a row: `pieces` of each strand, between pieces + 1 points with their radii.
struct StrandPieces {
    int pieces = 0;
    std::span<const Vec3f> points;
    std::span<const float> radii;
};

struct StrandHit {
    double t = 0;               // along the ray, in its direction's length
    bool skin = false;
    std::uint32_t index = 0;    // of the strand, or of the face of the skin
    double way = 0;             // along the strand, 0 at the root, 1 at the tip
    Vec2d weights;              // of the face's second and third corner
};

// Keeps the spans' data by reference: it outlives the tracer.
class StrandTracer {
public:
    StrandTracer(const StrandPieces& strands, const Mesh& skin);

    // The first strand or skin along the ray. A piece is met where the ray comes nearest to its axis, if that is within its radius there.
    std::optional<StrandHit> first_hit(Vec3d origin, Vec3d direction) const;

    // How many pieces of strands other than `own` the ray meets, up to `most`; none where it meets the skin.
    std::optional<int> strands_crossed(Vec3d origin, Vec3d direction, std::uint32_t own, int most) const;

private:
    struct Node {
        Vec3f low, high;
        std::uint32_t first = 0;  // of its pieces; the left child is the next node, the right child `right`
        std::uint32_t count = 0;  // 0 in an inner node
        std::uint32_t right = 0;
    };
    std::uint32_t build(std::uint32_t first, std::uint32_t last);
    template <class Visit>
    void along(Vec3d origin, Vec3d direction, double& nearest, const Visit& visit) const;
    bool meets(std::uint32_t piece, Vec3d origin, Vec3d direction, double nearest, StrandHit& hit) const;

    StrandPieces strands_;
    const Mesh& skin_;
    std::vector<std::uint32_t> order_;  // pieces of strands, then faces, in the order of the tree
    std::vector<Vec3f> lows_, highs_;   // of each, while the tree is built
    std::vector<Node> nodes_;
};

}  // namespace relievo
