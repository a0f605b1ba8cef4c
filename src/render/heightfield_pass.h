// The draw calls of the height-field family: one pipeline per host and technique, made when first used.
#pragma once

#include "gpu/image.h"
#include "render/gpu_material.h"
#include "render/scene_binding.h"
#include "techniques/modifiers.h"

#include <array>
#include <map>
#include <string>
#include <tuple>
#include <vector>

namespace relievo {

// A fragment host and what it writes.
struct FragmentHost {
    const char* file;
    std::vector<vk::Format> targets;
};

// A host's targets at a size, and buffers to read them with.
struct TargetSet {
    vk::Extent2D extent;
    std::vector<gpu::Image> images;
    std::vector<gpu::Buffer> read;  // tightly packed rows, top to bottom; made on first reading
};

class HeightFieldPass {
public:
    explicit HeightFieldPass(const gpu::Device& device) : device_(device), layout_(device) {}

    const FamilyLayout& layout() const { return layout_; }

    struct Draw {
        const FragmentHost& host;
        const Technique* technique = nullptr;  // null for a host that runs none
        MarchParams params{};
        DrawOptions options{};
        const GpuMaterial& material;
        const SceneBinding& scene;
        Vec3f background{};  // clear value of the first target
    };

    // Draws the base into views that are in the layout colour-attachment and are cleared first.
    void record(const vk::raii::CommandBuffer& commands, const Draw& draw, std::span<const vk::ImageView> targets,
                vk::Extent2D extent);

    // The pipeline of a draw, so that it can be made before times are taken.
    vk::Pipeline pipeline(const Draw& draw);
    vk::Pipeline cast_pipeline(const Technique& technique);

private:
    vk::Pipeline sheet_pipeline(const Draw& draw);

    using Key = std::tuple<std::string, std::string, std::vector<std::uint32_t>, std::vector<vk::Format>, bool>;
    const gpu::Device& device_;
    FamilyLayout layout_;
    std::map<Key, vk::raii::Pipeline> pipelines_;
    gpu::Image depth_;  // of the last size drawn with other geometry
};

TargetSet make_targets(const gpu::Device& device, const FragmentHost& host, int width, int height);

}  // namespace relievo
