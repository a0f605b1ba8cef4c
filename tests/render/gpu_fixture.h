// One renderer under validation and one small material for the tests of a file. Skips without a device; a message of the validation
// layers fails the test in which it came.
#pragma once

#include "maps/horizon_map.h"
#include "render/gpu_renderer.h"
#include "small_maps.h"

#include <gtest/gtest.h>

namespace relievo::test {

class GpuFixture : public testing::Test {
protected:
    static constexpr float height_scale = 0.1f;
    static constexpr float zero_level = 0.8f;  // neither end, so that a mistaken sign shows
    static constexpr int width = 320;
    static constexpr int height = 180;

    static void SetUpTestSuite() {
        bool usable = false;
        for (const GpuDevice& d : gpu_devices()) usable = usable || d.lacks.empty();
        if (!usable) return;
        maps = small_maps(64, height_scale);
        renderer = std::make_unique<GpuRenderer>("", true);
    }
    static void TearDownTestSuite() { renderer.reset(); }
    void SetUp() override {
        if (!renderer) GTEST_SKIP() << "no Vulkan device: install a driver (mesa-vulkan-drivers is a software one)";
    }
    void TearDown() override {
        if (!renderer) return;
        const auto messages = renderer->validation_messages();
        for (; messages_seen < messages.size(); ++messages_seen) ADD_FAILURE() << messages[messages_seen];
    }
    static Stage stage_at(double elevation_deg) { return stage_for(View{.id = "test", .elevation_deg = elevation_deg}); }

    static inline std::size_t messages_seen = 0;
    static inline MapSet maps;
    static inline std::unique_ptr<GpuRenderer> renderer;
};

// With the maps that modifiers ask for, uploaded.
class MaterialFixture : public GpuFixture {
protected:
    static void SetUpTestSuite() {
        GpuFixture::SetUpTestSuite();
        if (!renderer) return;
        maps.horizon = horizon_map(maps.height);
        material = renderer->upload(maps, height_scale, zero_level);
    }
    static void TearDownTestSuite() {
        material.reset();
        GpuFixture::TearDownTestSuite();
    }
    static inline std::shared_ptr<const GpuMaterial> material;
};

}  // namespace relievo::test
