// A prepared mesh drawn, as a picture and for its speed.
#pragma once

#include "pipeline/prepare_mesh.h"
#include "render/mesh_renderer.h"

#include <filesystem>
#include <string>

namespace relievo {

struct MeshPicture {
    MeshFrames list, indexed;  // the same picture
    std::string device;
};

// Draws the mesh as a list of faces and through its indices in turn, 15 times each, at 1280x800, and writes the picture as PNG.
// Throws Error, for meshes without faces too.
MeshPicture draw_mesh_picture(const PreparedMesh& prepared, const std::filesystem::path& file, const std::string& device);

}  // namespace relievo
