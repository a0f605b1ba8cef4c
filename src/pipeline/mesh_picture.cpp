#include "pipeline/mesh_picture.h"

#include "assets/image_file.h"
#include "core/error.h"

#include <array>

namespace relievo {

MeshPicture draw_mesh_picture(const PreparedMesh& prepared, const std::filesystem::path& file, const std::string& device) {
    if (prepared.mesh.faces() == 0) throw Error("draw", prepared.mesh.name, "it has no faces");
    MeshRenderer renderer(device);
    const std::array forms{MeshForm{&prepared.mesh, true}, MeshForm{&prepared.mesh, false}};
    std::vector<MeshFrames> frames = renderer.draw(forms, view_of_sphere(prepared.sphere.centre, prepared.sphere.radius), 15);
    write_png(file, frames[1].picture, FirstRow::top);
    return {std::move(frames[0]), std::move(frames[1]), renderer.device_name()};
}

}  // namespace relievo
