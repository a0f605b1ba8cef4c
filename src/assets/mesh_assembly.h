// What all readers of meshes do after parsing: polygons to triangles, broken faces out, the promises of Mesh kept.
#pragma once

#include "core/mesh.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace relievo {

// Indices that stand for none.
inline constexpr std::uint32_t index_missing = 0xffffffff;       // the corner has no such attribute
inline constexpr std::uint32_t index_out_of_range = 0xfffffffe;  // it names one that is not there
inline constexpr std::size_t max_vertices = 0xfffffff0;

// Counts of what was left out or mended, turned into the sentences of Mesh::notes.
struct MeshFaults {
    std::size_t faces_out_of_range = 0;   // names a vertex that is not there
    std::size_t faces_degenerate = 0;     // fewer than three distinct vertices
    std::size_t faces_non_finite = 0;     // has a corner that is NaN or infinite
    std::size_t polygons_unclean = 0;     // cut into triangles although the outline crosses itself or has no area
    std::size_t attributes_missing = 0;   // corners naming a normal or texture coordinate that is not there
    std::size_t vertices_non_finite = 0;  // left out
    std::size_t colours_non_finite = 0;   // taken for white

    MeshFaults& operator+=(const MeshFaults& other);
    void describe(std::vector<std::string>& notes) const;
};

// Collects polygons as triangles of corner numbers. One per thread: it keeps its working memory.
class PolygonCutter {
public:
    // Appends to `triangles` places in `corners` (0 .. n-1), three per triangle, or counts a fault and appends nothing. Corners that
    // repeat are left out first. Corners are indices of positions; those at or above positions.size() are out of range.
    void cut(std::span<const std::uint32_t> corners, std::span<const Vec3f> positions, std::vector<std::uint32_t>& triangles, MeshFaults& faults);

private:
    std::vector<std::uint32_t> places_, cut_;
    std::vector<Vec3f> outline_;
};

// Keeps the promises of Mesh for a mesh whose indices are in range and whose attributes are complete: drops vertices that are not
// finite with their faces and faces whose corners repeat, makes normals unit vectors, confines colours, describes the faults.
// Throws Error ("cannot read `file`: ...") where no face is left; `bytes` is the size of the file.
void finish_mesh(Mesh& mesh, MeshFaults faults, std::size_t bytes, const std::string& file, int threads);

// "byte N, its end: ", for complaints about a file as a whole.
std::string end_of(std::size_t bytes);

// Throws Error for text in UTF-16 or UTF-32 and for bytes that are no text, as found among the first ones.
void refuse_binary_text(std::string_view bytes, const std::string& file, const std::string& format);

// "line 17" for the place of a byte in a text.
std::string line_of(std::string_view text, std::size_t byte);

}  // namespace relievo
