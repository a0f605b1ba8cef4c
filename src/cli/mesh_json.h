// What `relievo mesh --json` prints of one mesh.
#pragma once

#include "pipeline/prepare_mesh.h"

#include <nlohmann/json.hpp>

namespace relievo {

// Analyses the mesh (topology and drawing cost; their time is in no step). Its first keys are a promise to scripts: faces,
// vertices_before and bytes_before (as a list, three vertices a face), vertices_after, bytes_after, acmr, atvr, ms and report.
nlohmann::ordered_json mesh_json(const PreparedMesh& prepared, const MeshSteps& steps);

}  // namespace relievo
