// A mesh file made ready to draw: the steps of src/mesh in their order, each only where it is asked for, timed and reported.
#pragma once

#include "core/mesh.h"
#include "core/progress.h"
#include "mesh/bounds.h"
#include "mesh/hausdorff.h"
#include "mesh/index_order.h"
#include "mesh/normals.h"
#include "mesh/repair.h"
#include "mesh/simplify.h"
#include "mesh/topology.h"
#include "mesh/vertex_cache.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace relievo {

struct MeshSteps {
    bool repair = false;
    bool centre = false;
    std::optional<SimplifyTarget> simplify;
    NormalMode normals = NormalMode::none;
    bool index = false;
    OrderSettings order{.order = IndexOrder::none};
    bool tangents = false;
    int threads = 0;
};

struct MeshTimes {  // milliseconds; 0 for steps not taken
    double load = 0, repair = 0, centre = 0, simplify = 0, normals = 0, index = 0, order = 0, tangents = 0, save = 0;
    double total() const { return load + repair + centre + simplify + normals + index + order + tangents + save; }
};

// The mesh drawn in its own order of indices.
struct DrawingCost {
    VertexWork fifo16, fifo32, batched;
    double overdraw = 0;  // pixels shaded per pixel covered, mean over views along the axes, each way (meshoptimizer's rasteriser)
};

struct PreparedMesh {
    Mesh mesh;
    std::vector<Vec4f> tangents;      // one per vertex where they were asked for; see mesh/tangents.h
    std::size_t vertices_doubled = 0; // for tangents, where a texture is mirrored
    MeshTimes ms;
    std::size_t vertices_before = 0;  // three a face: the list that the steps began with
    std::size_t bytes_before = 0;
    std::size_t bytes_after = 0;      // with indices if indexed or as the file came, else again a list
    Box box;                          // of the result
    Sphere sphere;
    std::optional<Repair> repair;
    std::optional<double> simplify_estimate;  // by the quadrics, in the mesh's units
    std::optional<SurfaceDistance> simplify_distance;  // first: the mesh as it was before that step; its time is in no step
};

// Applies the steps to a mesh at hand. `ms.load` and `ms.save` stay 0. Throws Error for tangents of a mesh without normals or texture
// coordinates.
PreparedMesh prepare_mesh(Mesh mesh, const MeshSteps& steps);

// Loads, prepares and, where `out` is not empty, saves. Throws Error.
PreparedMesh prepare_mesh_file(const std::filesystem::path& in, const MeshSteps& steps, const std::filesystem::path& out, const Progress& progress = {});

DrawingCost drawing_cost(const Mesh& mesh);

// "FILE_1234.ply" for several results of one command.
std::filesystem::path with_suffix(const std::filesystem::path& file, const std::string& suffix);

}  // namespace relievo
