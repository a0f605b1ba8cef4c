#include "fur/facing.h"

namespace relievo {

Vec3d face_vector(const Mesh& mesh, std::uint32_t face) {
    const std::uint32_t* i = &mesh.indices[std::size_t{face} * 3];
    const Vec3d a(mesh.positions[i[0]]), b(mesh.positions[i[1]]), c(mesh.positions[i[2]]);
    return cross(b - a, c - a);
}

}  // namespace relievo
