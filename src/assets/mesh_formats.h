// The parsers and writers behind load_mesh and save_mesh: bytes in memory to a Mesh and back. `file` is how messages name the source;
// `threads` 0 means all cores and never changes the result. All parsers throw Error naming line or byte offset, and need memory in
// proportion to the bytes they are given, whatever these promise.
#pragma once

#include "core/mesh.h"

#include <functional>
#include <string>
#include <string_view>

namespace relievo {

// Told of parts of the bytes that are not read again unless to complain about them: a mapped file's memory can be given back. Called
// from several threads at once.
using Forget = std::function<void(std::string_view part)>;

// Wavefront OBJ. v (with w or colour), vt, vn, f in every form, negative indices, polygons, continued lines; all groups and
// objects become one mesh; lines, points, curves and materials are passed over.
Mesh parse_obj(std::string_view bytes, const std::string& file, int threads = 0, const Forget& forget = {});

// PLY, ascii or binary of either byte order: elements vertex (x y z, nx ny nz, red green blue, s t or u v), face (vertex_indices or
// vertex_index) and tristrips (with -1 as restart); any types and order, others passed over.
Mesh parse_ply(std::string_view bytes, const std::string& file, int threads = 0);

// OFF, COFF, NOFF, STOFF and their combinations, as text.
Mesh parse_off(std::string_view bytes, const std::string& file, int threads = 0);

// STL, text or binary.
Mesh parse_stl(std::string_view bytes, const std::string& file, int threads = 0);

// The content of what an URI of a glTF file names, relative to it. Throws Error.
using ReadUri = std::function<std::string(const std::string& uri)>;

// glTF 2.0 as JSON or GLB: all triangles of the default scene (of all meshes if there is none) with node transforms, as one mesh.
// Skins, morph targets and animations are left at rest; Draco and meshopt compression are refused.
Mesh parse_gltf(std::string_view bytes, const std::string& file, const ReadUri& read_uri, int threads = 0);

// The compact cache; its layout is documented in mesh_cache.cpp.
bool is_mesh_cache(std::string_view bytes);
Mesh parse_mesh_cache(std::string_view bytes, const std::string& file, int threads = 0);
std::string write_mesh_cache(const Mesh& mesh, int threads = 0);
void seal_mesh_cache(std::string& bytes, int threads = 0);  // puts the checksum of what stands there; 64 bytes at least

// Writers. Positions, normals and texture coordinates come back bit by bit from OBJ and PLY; colours are 8 bits in PLY and linear
// light in glTF. PLY is binary little-endian.
std::string write_obj(const Mesh& mesh, int threads = 0);
std::string write_ply(const Mesh& mesh);
std::string write_glb(const Mesh& mesh, const std::vector<Vec4f>& tangents = {});   // tangents: none, or one per vertex
std::string write_gltf(const Mesh& mesh, const std::vector<Vec4f>& tangents = {});  // one file: the buffer stands in it in base64

}  // namespace relievo
