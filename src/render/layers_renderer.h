// Fur in uniform layers, headless: a texture that a direction looks up, on copies of the mesh pushed out along its normals; or one that lapped
// patches look up, pushed out along their strands.
#pragma once

#include "core/mesh.h"
#include "fur/direction_map.h"
#include "render/fur_frames.h"

#include <memory>
#include <string>
#include <vector>

namespace relievo {

// Kajiya and Kay's light (shaders/fur/kajiya_kay.glsl): colour (ambient + diffuse sin(t,l)) + specular cos(...)^power.
struct LayersLight {
    float ambient = 0.1f, diffuse = 1, specular = 1, power = 32;  // as the thesis' Algorithm 10 has them
};

// In fur space: the mesh's smallest sphere is the unit sphere around the origin.
struct LayersModel {
    const Mesh* mesh = nullptr;           // with unit normals, continuous or layers tear
    const DirectionMap* fur = nullptr;    // alpha: where strands stand
    const DirectionMap* colour = nullptr; // of the same shape
    Addressing addressing = Addressing::normal_plus_position;
    const std::vector<Vec3f>* comb = nullptr;  // given: strands lean that way; on a mesh with uvs, which is one of lapped patches, those look up maps of shape sphere
    float tilt = 0, bend = 0;             // along the comb, as in shaders/fur/strand_shape.glsl
    bool filtered = false;                // through the mip levels; else the finest alone, as the thesis does
    float height = 0.05f;                 // of the outermost layer, in radii; 0: bare skin
    LayersLight light;
    Vec3f skin{0.1f, 0.08f, 0.06f};       // linear albedo of the mesh under the fur
};

class LayersRenderer {
public:
    // Devices are chosen as by GpuRenderer. Throws Error.
    explicit LayersRenderer(const std::string& device, bool validation = false);
    ~LayersRenderer();

    std::string device_name() const;
    std::vector<std::string> validation_messages() const;

    // Copies what a model needs to the device; the model before is forgotten. The model's own data may go afterwards.
    void load(const LayersModel& model);
    // Of the model loaded last.
    void set_light(const LayersLight& light);

    // The skin, then view.layers layers at equal steps, the innermost first, blended by alpha with depth tested and written: the thesis'
    // states. There is one light, to_key. Throws Error, for pictures the device cannot draw too.
    FurFrames draw(const FurView& view);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace relievo
