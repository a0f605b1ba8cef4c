#include "mesh/overdraw.h"

#include <meshoptimizer.h>

namespace relievo {

double overdraw(const Mesh& mesh) {
    if (mesh.indices.empty()) return 0;
    return meshopt_analyzeOverdraw(mesh.indices.data(), mesh.indices.size(), &mesh.positions[0].x, mesh.positions.size(), sizeof(Vec3f)).overdraw;
}

}  // namespace relievo
