// Any way of growing fur on a mesh in memory: what comparisons, the contract and the table of effects ask of every mode alike.
#pragma once

#include "core/mesh.h"
#include "fur/coat.h"
#include "fur/evenness.h"
#include "fur/fur_modes.h"
#include "fur/painted_comb.h"
#include "render/fur_frames.h"

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace relievo {

// Whether a mode's light is a setting of its own, as that of textured layers is; others compute their light from the coat.
bool light_is_fitted(FurKind kind);

class CoatPainter {
public:
    // Devices are chosen as by GpuRenderer. Throws Error.
    explicit CoatPainter(FurKind kind, const std::string& device = {}, bool validation = false);
    ~CoatPainter();

    std::string device_name() const;
    std::vector<std::string> validation_messages() const;

    // The comb that is painted on what is worn from now on; its picture has been read.
    void paint(const CombPaint& comb);

    struct Worn {
        std::size_t faces = 0;  // of the mesh on which it grew
        double layers = 0;      // with which it is drawn
    };
    // Grows as much of the coat as the mode can say. `layers` 0: as many as the mode chooses by itself. A coat without length or without
    // strands leaves the skin bare. Throws Error for meshes on which nothing can grow, and where paint does not fit the mesh.
    Worn wear(Mesh mesh, const Coat& coat, const MeshView& camera, int layers = 0, int threads = 0);

    // Gives a mode of light_is_fitted the light that brings it nearest to these traced strands, which the view shows; others keep theirs.
    void fit_light(const FurView& view, const FurFrames& traced);

    // What was worn last. The view's layers should be those of `wear`.
    FurFrames draw(const FurView& view);

    struct Counted {
        std::size_t strands = 0;
        Evenness evenness;
    };
    // The strands of what was worn last. Throws Error where there are none.
    Counted counted(int threads = 0) const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace relievo
