// The 3D distance map by compute programs: the bits of maps/distance_map.h.
#pragma once

#include "render/bake_program.h"
#include "render/device_bake.h"

namespace relievo {

class DistanceBake : public MapProgram {
public:
    explicit DistanceBake(const gpu::Device& device);
    ImageF bake(const HeightField& field, const MapBake& bake) override;

private:
    const gpu::Device& device_;
    BakeProgram down_, along_, stored_;
};

}  // namespace relievo
