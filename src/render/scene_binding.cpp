#include "render/scene_binding.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace relievo {

namespace {

glsl::SceneUniforms scene_uniforms(const Stage& stage, int width, int height, Vec2f offset) {
    const Vec3f eye(stage.camera.eye);
    const auto axes = stage.camera.axes();
    const Vec3f right(axes.right);
    const Vec3f up(axes.up);
    const Vec3f back(axes.back);
    const double scale = 1 / std::tan(stage.camera.fov_y_rad / 2);
    const Lighting& light = stage.lighting;
    return {
        .eye_x = eye.x,
        .eye_y = eye.y,
        .eye_z = eye.z,
        .right_x = right.x,
        .right_y = right.y,
        .right_z = right.z,
        .up_x = up.x,
        .up_y = up.y,
        .up_z = up.z,
        .back_x = back.x,
        .back_y = back.y,
        .back_z = back.z,
        .scale_x = static_cast<float>(scale * height / width),
        .scale_y = static_cast<float>(scale),
        // A sample to the right of the pixel's centre sees what a picture moved to the left shows at the centre.
        .shift_x = -2 * offset.x / static_cast<float>(width),
        .shift_y = -2 * offset.y / static_cast<float>(height),
        .near_z = 1e-3f,  // a thousandth of a repeat: nearer than any useful view, far enough for float
        .periods = stage.base.periods,
        .ambient_r = light.ambient.x,
        .ambient_g = light.ambient.y,
        .ambient_b = light.ambient.z,
        .specular = light.specular,
        .shininess = light.shininess,
        .background_r = light.background.x,
        .background_g = light.background.y,
        .background_b = light.background.z,
        .padding_a = 0,
        .padding_b = 0,
    };
}

glsl::LightUniforms light_uniforms(const Light& light) {
    return {.x = light.position.x,
            .y = light.position.y,
            .z = light.position.z,
            .directional = light.directional ? 1 : 0,
            .r = light.colour.x,
            .g = light.colour.y,
            .b = light.colour.z,
            .constant = light.constant,
            .linear = light.linear,
            .quadratic = light.quadratic,
            .padding_a = 0,
            .padding_b = 0};
}

// shaders/hosts/heightfield/scene.glsl's uniform block.
struct SceneBlock {
    glsl::SceneUniforms scene;
    glsl::LightUniforms first_lights[glsl::first_lights_count];
};
static_assert(offsetof(SceneBlock, first_lights) == sizeof(glsl::SceneUniforms));

}  // namespace

SceneBinding::SceneBinding(const gpu::Device& device, const FamilyLayout& layout)
    : device_(&device),
      scene_(gpu::make_buffer(device, sizeof(SceneBlock), vk::BufferUsageFlagBits::eUniformBuffer)),
      set_(make_descriptor_set(device, layout.scene,
                               {{vk::DescriptorType::eUniformBuffer, 1}, {vk::DescriptorType::eStorageBuffer, 1}})) {
    const vk::DescriptorBufferInfo scene{.buffer = *scene_.handle, .range = VK_WHOLE_SIZE};
    device.handle().updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = set_.handle,
                                                                .dstBinding = 0,
                                                                .descriptorCount = 1,
                                                                .descriptorType = vk::DescriptorType::eUniformBuffer,
                                                                .pBufferInfo = &scene},
                                         {});
}

void SceneBinding::update(const Stage& stage, int width, int height, Vec2f offset) {
    const auto& lights = stage.lighting.lights;
    light_count_ = static_cast<std::uint32_t>(lights.size());
    periods_ = stage.base.periods;
    from_behind_ = stage.camera.from_behind;
    constexpr std::size_t first = glsl::first_lights_count;
    SceneBlock block{scene_uniforms(stage, width, height, offset), {}};
    for (std::size_t i = 0; i < std::min(first, lights.size()); ++i) block.first_lights[i] = light_uniforms(lights[i]);
    std::memcpy(scene_.mapped, &block, sizeof block);

    // A storage buffer has at least one element, so that a stage without further lights binds something.
    const std::size_t further = lights.size() > first ? lights.size() - first : 0;
    const std::size_t needed = std::max<std::size_t>(1, further) * sizeof(glsl::LightUniforms);
    if (further_lights_.size < needed) {
        further_lights_ = gpu::make_buffer(*device_, needed, vk::BufferUsageFlagBits::eStorageBuffer);
        const vk::DescriptorBufferInfo buffer{.buffer = *further_lights_.handle, .range = VK_WHOLE_SIZE};
        device_->handle().updateDescriptorSets(vk::WriteDescriptorSet{.dstSet = set_.handle,
                                                                      .dstBinding = 1,
                                                                      .descriptorCount = 1,
                                                                      .descriptorType = vk::DescriptorType::eStorageBuffer,
                                                                      .pBufferInfo = &buffer},
                                               {});
    }
    for (std::size_t i = 0; i < further; ++i) further_lights_.as<glsl::LightUniforms>()[i] = light_uniforms(lights[first + i]);
}

}  // namespace relievo
