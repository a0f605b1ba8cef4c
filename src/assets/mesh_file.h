// Meshes from other people's files and back.
#pragma once

#include "core/mesh.h"

#include <filesystem>
#include <string>

namespace relievo {

// Reads OBJ, PLY, OFF, STL, glTF 2.0 (.gltf, .glb) and our own cache (.rmesh), each also gzip-compressed (.obj.gz, ...). PLY, GLB
// and the cache are told by their first bytes, the others by the name's ending. Polygons come out as triangles; broken faces are
// skipped and counted in `notes`. Throws Error for what is missing, empty, no mesh, without a face, or cannot be understood, naming
// line or byte offset; nothing is allocated on the strength of a promise that the file's size does not bear out. The result does not
// depend on `threads` (0: all cores).
Mesh load_mesh(const std::filesystem::path& file, int threads = 0);

// Writes OBJ, PLY (binary), glTF (one file), GLB or the cache as the ending says, compressed if it says .gz; the file appears whole
// or not at all. The mesh keeps the promises of core/mesh.h. Notes are kept by the cache alone. `tangents`, as in mesh/tangents.h, are
// one per vertex or none; only glTF and GLB have a place for them. Throws Error.
void save_mesh(const std::filesystem::path& file, const Mesh& mesh, int threads = 0, const std::vector<Vec4f>& tangents = {});

// load_mesh for bytes in memory, which may be compressed; the format as an ending ("ply"; "" to go by the first bytes alone).
// Buffers beside a glTF file are looked for in `folder`; empty: there are none.
Mesh parse_mesh(std::string_view bytes, const std::string& ending, const std::string& file, const std::filesystem::path& folder, int threads = 0);

}  // namespace relievo
