// Dummer's cone map by a compute program: the bits of maps/cone_map.h.
#pragma once

#include "render/bake_program.h"
#include "render/device_bake.h"

namespace relievo {

class ConeBake : public MapProgram {
public:
    explicit ConeBake(const gpu::Device& device);
    ImageF bake(const HeightField& field, const MapBake& bake) override;

private:
    const gpu::Device& device_;
    BakeProgram program_;
};

}  // namespace relievo
