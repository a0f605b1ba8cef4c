// Meshes under Phong's model, headless: pictures, frames a second, and how many vertices the device computed for them.
#pragma once

#include "core/camera.h"
#include "core/image.h"
#include "core/measurement.h"
#include "core/mesh.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace relievo {

struct MeshForm {
    const Mesh* mesh = nullptr;
    bool as_list = false;  // three vertices a face and no indices, else through its indices (16 bit where they fit)
};

struct MeshView {
    Camera camera;
    int width = 1280, height = 800;
    double near = 0.1, far = 10;  // distances along the view that are drawn
};

// The whole sphere in the picture, seen from the front, a little from the right and above; +y is up, as scanners have it.
MeshView view_of_sphere(Vec3d centre, double radius, int width = 1280, int height = 800);

struct MeshFrames {
    Image8 picture;  // sRGB, rows top to bottom, three channels
    TimeSpread frame_ms;  // from the submission of a frame to its end, nothing shown and nothing read back
    double frames_per_second = 0;  // 1000 / median
    Measured<std::uint64_t> vertex_invocations;  // of one frame
};

class MeshRenderer {
public:
    // Devices are chosen as by GpuRenderer. Throws Error.
    explicit MeshRenderer(const std::string& device, bool validation = false);
    ~MeshRenderer();

    std::string device_name() const;
    std::vector<std::string> validation_messages() const;

    // Every form once unmeasured, then `runs` times in turn, A B C A B C. Throws Error, for pictures the device cannot draw too.
    std::vector<MeshFrames> draw(std::span<const MeshForm> forms, const MeshView& view, int runs);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace relievo
