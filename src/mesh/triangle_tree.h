// Nearest points on a mesh, by a tree of boxes.
#pragma once

#include "core/mesh.h"

#include <cstdint>
#include <vector>

namespace relievo {

// The point of the triangle nearest to p. Ericson (2005), Real-Time Collision Detection, 5.1.5. A triangle without area is its sides.
Vec3d nearest_on_triangle(Vec3d p, Vec3d a, Vec3d b, Vec3d c);

class TriangleTree {
public:
    // Keeps the triangles it needs; the mesh has faces.
    explicit TriangleTree(const Mesh& mesh);

    // The squared distance from p to the surface, or `at_most` where that is not larger.
    double distance2(Vec3d p, double at_most) const;

private:
    struct Node {
        Vec3f low, high;
        std::uint32_t first = 0;  // of its triangles, or its left child; the right child follows the left one
        std::uint32_t count = 0;  // of triangles; 0 in an inner node
    };
    struct Triangle {
        Vec3f a, b, c;
    };
    void build(std::uint32_t node, std::uint32_t first, std::uint32_t last);

    std::vector<Triangle> triangles_;
    std::vector<Node> nodes_;
};

}  // namespace relievo
