// A material's maps on the device, in the formats the accessors expect (shaders/hosts/heightfield/maps.glsl).
#pragma once

#include "core/map_set.h"
#include "gpu/image.h"
#include "render/family_layout.h"

namespace relievo {

class GpuMaterial {
public:
    // Maps that are missing from the set are bound as one texel: height 0, normal (0,0,1), mid-grey, pyramid 1, cone (0, 0),
    // cell cone (1, 0, 1, 1) in 16 bits.
    // Throws Error if a mip chain does not halve from level to level or a map is larger than the device takes.
    GpuMaterial(const gpu::Device& device, const FamilyLayout& layout, const MapSet& maps, float height_scale, float zero_level);

    float height_scale() const { return height_scale_; }
    // For the draws recorded from now on; normals that were made for another scale stay as they are.
    void set_height_scale(float height_scale) { height_scale_ = height_scale; }
    float zero_level() const { return zero_level_; }
    vk::DescriptorSet maps() const { return set_.handle; }
    bool has(Map map) const { return has_[index_of(map)]; }

private:
    float height_scale_;
    float zero_level_;
    MapFlags has_;
    gpu::Image images_[map_count];  // the order of enum Map and of the bindings
    DescriptorSet set_;
};

}  // namespace relievo
