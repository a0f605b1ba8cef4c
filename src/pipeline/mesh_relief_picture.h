// One picture of a relief on an unwrapped mesh.
#pragma once

#include "core/frame.h"
#include "core/progress.h"
#include "pipeline/render_picture.h"

namespace relievo {

struct MeshReliefPicture {
    Frame frame;
    MeshFacts facts;
    std::vector<std::string> notes;
};

// settings.mesh: the id of a made-up shape (mesh/made_up_atlas.h) or a file. The eye looks at its bounding sphere from the view's
// elevation and azimuth, y up. Throws Error for meshes without texture coordinates, UsageError for modifiers that meshes do not have.
MeshReliefPicture mesh_relief_picture(const RenderSettings& settings, const Progress& progress);

}  // namespace relievo
