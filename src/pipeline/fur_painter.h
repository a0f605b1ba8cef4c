// Grown fur on a device, ready to be drawn from anywhere, plotted or in shells.
#pragma once

#include "fur/fur_modes.h"
#include "fur/fur_motion.h"
#include "fur/rooted_strands.h"
#include "pipeline/grown_fur.h"
#include "render/fur_frames.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace relievo {

class FurRenderer;
class StrandRenderer;

class FurPainter {
public:
    // kind: strands or shells. Devices are chosen as by GpuRenderer. Throws Error.
    FurPainter(FurKind kind, const std::string& device, bool validation = false);
    ~FurPainter();

    std::string device_name() const;
    FurKind kind() const { return kind_; }
    std::vector<std::string> validation_messages() const;

    // Makes room for pictures like `view` of about so many strands, where that saves time later. Throws Error.
    void expect(const FurView& view, std::size_t strands);

    struct Loaded {
        double grid_ms = 0;
        std::size_t layer_faces = 0;  // of the mesh that light meets, and that shells push out
    };
    // For pictures like `view`, whose `layers` count, as the forces hold the fur; gives the fur's mesh its normals. Fur and coat must stay where
    // they are while they are drawn.
    Loaded load(GrownFur& fur, const Coat& coat, const FurForces& forces, const FurView& view, int threads = 0);

    // What forces move: of plotted strands the skin that they stand on, of shells the layers' mesh.
    FurSkin skin() const;
    // Bends the fur otherwise: a push for each vertex of the skin.
    void push(const std::vector<Vec3f>& pushes);

    FurFrames draw(const FurView& view);

private:
    FurKind kind_;
    const GrownFur* fur_ = nullptr;
    const Coat* coat_ = nullptr;
    Mesh layers_;
    std::vector<Vec3f> layers_comb_, skin_comb_;
    std::vector<float> layers_lengths_;
    RootedStrands strands_on_skin_;
    std::vector<std::int64_t> skin_vertex_;  // of plotted strands, for each vertex of the layers' mesh the same place on the skin, or -1; filled when first pushed
    int threads_ = 0;
    std::unique_ptr<FurRenderer> shells_;
    std::unique_ptr<StrandRenderer> strands_;
};

// As many layers as the fur needs in this picture. Of shells: one for every two pixels of its height; then little shows between them at
// silhouettes. Of plotted strands, which are as many straight pieces: so many that none is off its curve by more than a quarter of a pixel.
double layers_for(FurKind kind, const MeshView& view, const Coat& coat);

}  // namespace relievo
