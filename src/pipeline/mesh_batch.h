// A folder of meshes prepared with every combination of normals, indexing and order, into a table of figures.
#pragma once

#include "core/progress.h"

#include <filesystem>
#include <string>
#include <vector>

namespace relievo {

struct MeshBatchSettings {
    std::filesystem::path folder;  // its files that have the ending of a mesh; not those of folders inside
    std::filesystem::path out;     // folder, made if it is not there
    int threads = 0;
    int runs = 3;         // of each combination; the table keeps the fastest
    bool frames = false;  // draw each form as well
    std::string device;   // that draws
};

struct MeshBatchResult {
    std::string json;  // what was written to meshes.json
    std::size_t meshes = 0, taken_over = 0;  // of which an earlier run had the rows
    std::vector<std::string> notes;
};

// Writes meshes.json, meshes.csv and meshes.html, anew after every mesh: a run that was stopped goes on where it was, taking over the
// rows of files that have not changed since. Files that cannot be read are listed with the reason. Throws Error, and Cancelled.
MeshBatchResult batch_meshes(const MeshBatchSettings& settings, const Progress& progress);

}  // namespace relievo
