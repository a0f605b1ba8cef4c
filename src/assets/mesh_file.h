// Meshes from other people's files.
#pragma once

#include "core/mesh.h"

#include <filesystem>

namespace relievo {

// Reads OBJ, told by the name's ending, also gzip-compressed (.obj.gz). Polygons come out as triangles; broken faces are skipped
// and counted in `notes`. Throws Error for what is missing, empty, no mesh, without a face, or cannot be understood, naming line
// or byte offset. The result does not depend on `threads` (0: all cores).
Mesh load_mesh(const std::filesystem::path& file, int threads = 0);

}  // namespace relievo
