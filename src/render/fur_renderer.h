// Fur in shells, headless: the mesh, its layers, and light that finds its way between strands.
#pragma once

#include "core/mesh.h"
#include "fur/coat.h"
#include "fur/strand_grid.h"
#include "render/fur_frames.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace relievo {

// Everything in fur space: the mesh's smallest sphere is the unit sphere around the origin.
struct FurModel {
    const Mesh* mesh = nullptr;          // with unit normals; what is pushed out
    const std::vector<Vec3f>* comb = nullptr;     // of its vertices
    const std::vector<float>* lengths = nullptr;  // of its vertices, shares of the coat's length; null: 1 everywhere
    const std::vector<Vec3f>* pushes = nullptr;   // of its vertices, as in fur/fur_motion.h; null: none
    const StrandGrid* grid = nullptr;
    Coat coat;
    float spacing = 0.01f;               // mean distance between roots
};

// How far a strand may be from where its root alone would put it, in fur space.
float strand_reach(const Coat& coat, float spacing, double layers);

class FurRenderer {
public:
    // Devices are chosen as by GpuRenderer. Throws Error.
    explicit FurRenderer(const std::string& device, bool validation = false);
    ~FurRenderer();

    std::string device_name() const;
    std::vector<std::string> validation_messages() const;

    // Copies what a model needs to the device; the model before is forgotten. The model's own data may go afterwards.
    void load(const FurModel& model);

    // Bends the model loaded last otherwise: a push for each of its vertices.
    void push(std::span<const Vec3f> pushes);

    // The model loaded last. Throws Error, for pictures the device cannot draw too.
    FurFrames draw(const FurView& view);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace relievo
