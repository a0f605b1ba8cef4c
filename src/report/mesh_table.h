// What preparing many meshes with many options gave, as one value, and its texts: JSON (all of it), CSV (a line per row) and a page
// that opens from disk, with the columns of tables 7.1 to 7.5 of the 2009 thesis and, where a mesh is one of its own, its figures.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace relievo {

// One mesh with one combination of options, centred first. Times in milliseconds.
struct MeshRow {
    std::string file;     // in the folder
    std::string input;    // size and time of the file: a row of another input is out of date
    std::string normals;  // mode
    bool index = false;
    std::string order;

    std::size_t faces = 0;
    double sphere_radius = 0;     // of the smallest sphere
    double half_diagonal = 0;     // of the box: what the thesis calls the radius
    std::size_t vertices_before = 0, vertices_after = 0;
    std::size_t bytes_before = 0, bytes_after = 0;
    double load_ms = 0, centre_ms = 0, normals_ms = 0, index_ms = 0, order_ms = 0;
    double acmr_fifo16 = 0, acmr_fifo32 = 0, acmr_batched = 0, overdraw = 0;
    std::optional<double> frames_per_second;
    std::optional<std::size_t> vertex_invocations;  // a frame, by the device's own count
};

struct MeshTable {
    std::string version, date, device;  // device: that drew, or empty
    int threads = 0;
    std::vector<MeshRow> rows;
    std::vector<std::string> skipped;  // files that are no meshes, with the reason
};

std::string mesh_table_json(const MeshTable& table);
std::string mesh_table_csv(const MeshTable& table);
std::string mesh_table_page(const MeshTable& table);

// The reverse of mesh_table_json. `source` names the text in errors. Throws Error.
MeshTable parse_mesh_table(std::string_view json, const std::string& source);

// What the thesis published of a mesh (GeForce 8600 GT, two cores of 2.1 GHz); times in seconds, sizes in KB of 1024 bytes.
struct PublishedMesh {
    std::string_view name;
    int level;
    std::size_t faces;
    double radius;
    double load_s, centre_s, normals_s, index_s;
    std::optional<double> d3dx_s, lin_s;  // none: it did not return
    std::size_t vertices_after;
    double kilobytes_before, kilobytes_after;
    int fps_original, fps_indexed;
    std::optional<int> fps_d3dx, fps_lin;
};

// The mesh of the thesis with exactly so many faces, or none.
const PublishedMesh* published_mesh(std::size_t faces);

}  // namespace relievo
