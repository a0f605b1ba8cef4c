// A mesh drawn as a list and through its indices: the same picture, of a size that can be said beforehand, for fewer vertices.
#include "render/mesh_renderer.h"

#include "core/error.h"
#include "render/gpu_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relievo {
namespace {

// A sphere of radius 1 of `rows` rings, with its radii for normals.
Mesh ball(std::uint32_t rows) {
    Mesh mesh;
    const std::uint32_t columns = 2 * rows;
    for (std::uint32_t r = 0; r <= rows; ++r)
        for (std::uint32_t c = 0; c < columns; ++c) {
            const double polar = std::numbers::pi * r / rows, azimuth = 2 * std::numbers::pi * c / columns;
            mesh.positions.emplace_back(static_cast<float>(std::sin(polar) * std::sin(azimuth)), static_cast<float>(std::cos(polar)),
                                        static_cast<float>(std::sin(polar) * std::cos(azimuth)));
        }
    mesh.normals = mesh.positions;
    for (std::uint32_t r = 0; r < rows; ++r)
        for (std::uint32_t c = 0; c < columns; ++c) {
            const std::uint32_t a = r * columns + c, b = r * columns + (c + 1) % columns;
            mesh.indices.insert(mesh.indices.end(), {a, a + columns, b + columns, a, b + columns, b});
        }
    return mesh;
}

class MeshOnGpu : public testing::Test {
protected:
    void SetUp() override {
        if (std::ranges::none_of(gpu_devices(), [](const GpuDevice& d) { return d.lacks.empty(); }))
            GTEST_SKIP() << "no Vulkan device: install a driver (mesa-vulkan-drivers is a software one)";
        renderer = std::make_unique<MeshRenderer>("", true);
    }
    void TearDown() override {
        if (!renderer) return;
        for (const std::string& message : renderer->validation_messages()) ADD_FAILURE() << message;
    }
    std::unique_ptr<MeshRenderer> renderer;
};

TEST_F(MeshOnGpu, ListAndIndicesGiveTheSamePictureForFewerVertices) {
    const Mesh mesh = ball(40);
    const MeshForm forms[] = {{&mesh, true}, {&mesh, false}};
    const MeshView view = view_of_sphere({0, 0, 0}, 1, 320, 200);
    const std::vector<MeshFrames> frames = renderer->draw(forms, view, 2);
    ASSERT_EQ(frames.size(), 2u);
    EXPECT_EQ(frames[0].picture.texels, frames[1].picture.texels);
    EXPECT_EQ(frames[0].frame_ms.runs, 2);
    EXPECT_GT(frames[0].frames_per_second, 0);
    if (frames[0].vertex_invocations) {
        EXPECT_GE(*frames[0].vertex_invocations, mesh.indices.size());
        EXPECT_GE(*frames[1].vertex_invocations, mesh.positions.size());
        EXPECT_LT(*frames[1].vertex_invocations, *frames[0].vertex_invocations / 2);
    }
    // The sphere in the picture: sin of half its angle is radius over distance, and it is cut by the plane of the picture as a circle.
    const Image8& picture = frames[0].picture;
    const auto covered = [&](int x, int y) { return picture(x, y, 0) != picture(0, 0, 0) || picture(x, y, 2) != picture(0, 0, 2); };
    const double distance = length(view.camera.eye), radius_px = 100 / std::tan(0.3) * std::tan(std::asin(1 / distance));
    int count = 0;
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 320; ++x) {
            const double from_centre = std::hypot(x + 0.5 - 160, y + 0.5 - 100);
            if (from_centre < radius_px - 1.5) {
                EXPECT_TRUE(covered(x, y)) << x << ' ' << y;
            }
            if (from_centre > radius_px + 0.5) {
                EXPECT_FALSE(covered(x, y)) << x << ' ' << y;
            }
            count += covered(x, y);
        }
    EXPECT_NEAR(count, std::numbers::pi * radius_px * radius_px, 0.02 * count);
    // The light is above and to the left of the eye.
    EXPECT_GT(picture(120, 60, 0), picture(200, 140, 0) + 20);
}

// Of two faces the nearer one is seen, whichever is drawn first.
TEST_F(MeshOnGpu, NearerFacesWin) {
    Mesh mesh = ball(12);
    const MeshView view = view_of_sphere({0, 0, 0}, 1, 160, 100);
    const std::size_t behind = mesh.positions.size();
    for (const Vec3f p : {Vec3f(-3, -3, -0.9f), Vec3f(3, -3, -0.9f), Vec3f(0, 4, -0.9f)}) {
        mesh.positions.push_back(p);
        mesh.normals.emplace_back(0.0f, 0.0f, 1.0f);
    }
    Mesh last = mesh, first = mesh;
    const std::uint32_t b = static_cast<std::uint32_t>(behind);
    last.indices.insert(last.indices.end(), {b, b + 1, b + 2});
    first.indices.insert(first.indices.begin(), {b, b + 1, b + 2});
    const MeshForm forms[] = {{&last, false}, {&first, false}};
    const std::vector<MeshFrames> frames = renderer->draw(forms, view, 0);
    EXPECT_EQ(frames[0].picture.texels, frames[1].picture.texels);
}

TEST_F(MeshOnGpu, PicturesOfImpossibleSizeAreRefused) {
    const Mesh mesh = ball(4);
    const MeshForm form{&mesh, false};
    EXPECT_THROW(renderer->draw({&form, 1}, view_of_sphere({0, 0, 0}, 1, 1 << 20, 4), 1), Error);
}

}  // namespace
}  // namespace relievo
