// The text of an OBJ in pieces, each parsed into lists of its own, by any thread.
#pragma once

#include "core/vec.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "assets/mesh_assembly.h"

namespace relievo::obj {

enum Attribute : std::size_t { position, uv, normal };

struct Piece {
    const char* begin = nullptr;
    const char* end = nullptr;  // behind a newline

    std::vector<Vec3f> positions, normals, colours;  // colours: empty, or as long as positions
    std::vector<Vec2f> uvs;

    // Corners of all faces, one after the other; uv and normal are empty where no corner names one.
    std::array<std::vector<std::uint32_t>, 3> corners;
    std::vector<std::uint32_t> sizes;  // corners per face; empty while all are triangles
    std::size_t faces = 0;
    std::array<std::vector<std::uint32_t>, 3> relative;  // places in corners[a] that count from this piece's first element

    MeshFaults faults;
    std::size_t passed_over = 0;  // lines, points, curves and surfaces
    std::size_t vertex_count = 0, triangle_corners = 0;  // lengths, kept when the lists are given up
    const char* error_at = nullptr;
    std::string error;

    std::size_t count(std::size_t attribute) const {
        return attribute == position ? positions.size() : attribute == uv ? uvs.size() : normals.size();
    }
};

// The text as pieces that end with a newline, cut where no backslash continues a line; a last line without a newline is copied into
// `last_line`, with one, and the last piece lies there.
std::vector<Piece> pieces_of(std::string_view bytes, std::string& last_line);

// Reads the text of a piece into its lists, up to the first thing that cannot be understood, which is noted in it.
void parse(Piece& piece);

}  // namespace relievo::obj
