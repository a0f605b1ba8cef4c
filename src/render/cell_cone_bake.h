// The cell cone map by compute programs: the bits of maps/cell_cone.h.
#pragma once

#include "render/bake_program.h"
#include "render/device_bake.h"

namespace relievo {

class CellConeBake : public MapProgram {
public:
    explicit CellConeBake(const gpu::Device& device);
    ImageF bake(const HeightField& field, const MapBake& bake) override;

private:
    const gpu::Device& device_;
    BakeProgram largest_, roof_, quadrants_;
    gpu::Buffer levels_;
};

}  // namespace relievo
