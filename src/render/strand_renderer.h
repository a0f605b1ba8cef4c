// Fur plotted strand by strand, headless: every strand finds its pixels, where in layers every pixel looks for its strands.
#pragma once

#include "core/mesh.h"
#include "fur/coat.h"
#include "fur/rooted_strands.h"
#include "render/fur_frames.h"

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace relievo {

// Everything in fur space: the mesh's smallest sphere is the unit sphere around the origin.
struct StrandModel {
    const Mesh* mesh = nullptr;                   // with unit normals; the skin, and where light meets the fur
    const std::vector<Vec3f>* comb = nullptr;     // of its vertices
    const std::vector<float>* lengths = nullptr;  // of its vertices, shares of the coat's length; null: 1 everywhere
    const RootedStrands* strands = nullptr;  // at least one
    Coat coat;
    float spacing = 0.01f;                        // mean distance between roots
};

class StrandRenderer {
public:
    // Devices are chosen as by GpuRenderer. Throws Error, for devices without atomic minima of 64 bits too.
    explicit StrandRenderer(const std::string& device, bool validation = false);
    ~StrandRenderer();

    std::string device_name() const;
    std::vector<std::string> validation_messages() const;

    // Makes room for pictures like this one of a model of about so many strands, and touches it: the first picture then does not wait for
    // memory, which takes systems about as long to hand out as fur takes to be plotted. Throws Error.
    void expect(const FurView& view, std::size_t strands);

    // Copies what a model needs to the device; the model before is forgotten. The model's own data may go afterwards.
    void load(const StrandModel& model);

    // Bends the model loaded last otherwise: a push for each of its strands (three numbers and a 0), and for each vertex of its mesh.
    void push(std::span<const std::array<float, 4>> strands, std::span<const Vec3f> vertices);

    // The model loaded last, each strand in as many straight pieces as the view has layers. Throws Error, for pictures the device cannot draw too.
    FurFrames draw(const FurView& view);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace relievo
