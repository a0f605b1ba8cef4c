// Which way faces look, in three bytes each.
#pragma once

#include "core/mesh.h"

#include <cstdint>
#include <vector>

namespace relievo {

// Twice the area of a face along its normal: counter-clockwise seen from outside.
Vec3d face_vector(const Mesh& mesh, std::uint32_t face);

// A unit normal, enough to say without the mesh at hand whether two faces look the same way, unless it is close.
struct Facing {
    std::int8_t x = 0, y = 0, z = 0;
    Facing() = default;
    explicit Facing(Vec3d n) : x(rounded(n.x)), y(rounded(n.y)), z(rounded(n.z)) {}
    // The sign of the product of the two normals, or 0 where rounding (half a step in each of six numbers) may have changed it.
    int product(Facing o) const {
        const int p = x * o.x + y * o.y + z * o.z;
        return p > 256 ? 1 : p < -256 ? -1 : 0;
    }

private:
    static std::int8_t rounded(double v) { return static_cast<std::int8_t>(static_cast<int>(v * 127 + 128.5) - 128); }
};

struct Facings {
    const Mesh* mesh = nullptr;
    std::vector<Facing> of;  // each face; zeros for faces without area

    bool alike(std::uint32_t f, std::uint32_t g) const {
        const int sure = of[f].product(of[g]);
        return sure != 0 ? sure > 0 : dot(face_vector(*mesh, f), face_vector(*mesh, g)) > 0;
    }
};

}  // namespace relievo
