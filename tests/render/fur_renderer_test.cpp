// Fur on a ball: where it may be and where it must be, and that it hangs together.
#include "render/fur_renderer.h"

#include "fur/comb.h"
#include "fur/roots.h"
#include "mesh/made_up_scan.h"
#include "mesh/normals.h"
#include "render/gpu_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace relievo {
namespace {

class FurOnGpu : public testing::Test {
protected:
    void SetUp() override {
        if (std::ranges::none_of(gpu_devices(), [](const GpuDevice& d) { return d.lacks.empty(); }))
            GTEST_SKIP() << "no Vulkan device: install a driver (mesa-vulkan-drivers is a software one)";
        renderer = std::make_unique<FurRenderer>("", true);
        mesh = made_up_scan({.faces = 2000, .relief = 0, .noise = 0});
        mesh.normals = continuous_normals(mesh, NormalMode::angle);
        comb = combed(mesh, 0);
    }
    void TearDown() override {
        if (!renderer) return;
        for (const std::string& message : renderer->validation_messages()) ADD_FAILURE() << message;
    }
    FurFrames draw(const Coat& coat, const FurView& view) {
        const Roots roots = grow_roots(mesh, {.count = static_cast<std::uint32_t>(coat.strands)});
        const auto spacing = static_cast<float>(std::sqrt(roots.area / static_cast<double>(roots.roots.size())));
        const StrandGrid grid = strand_grid(mesh, roots, {.reach = strand_reach(coat, spacing, view.layers)});
        renderer->load({.mesh = &mesh, .comb = &comb, .grid = &grid, .coat = coat, .spacing = spacing});
        return renderer->draw(view);
    }
    // The part of a ring of the given radii, in units of the ball's, that is covered.
    static double covered(const FurFrames& f, const FurView& view, double inner, double outer) {
        const double distance = length(view.camera.camera.eye), half = std::tan(view.camera.camera.fov_y_rad / 2);
        double sum = 0;
        int count = 0;
        for (int y = 0; y < f.coverage.height; ++y)
            for (int x = 0; x < f.coverage.width; ++x) {
                const double px = (2 * x + 1 - f.coverage.width) * half / f.coverage.height, py = (2 * y + 1 - f.coverage.height) * half / f.coverage.height;
                const double radius = distance * std::sin(std::atan(std::hypot(px, py)));
                if (radius < inner || radius > outer) continue;
                sum += f.coverage(x, y);
                ++count;
            }
        EXPECT_GT(count, 20);
        return sum / count;
    }
    std::unique_ptr<FurRenderer> renderer;
    Mesh mesh;
    std::vector<Vec3f> comb;
};

const Coat upright{.strands = 6000, .length = 0.2f, .tilt = 0, .bend = 0, .spread = 0, .width = 0.35f, .length_variation = 0, .lock = 0, .guard_hairs = 0};

TEST_F(FurOnGpu, CoversTheBallAndARingAroundIt) {
    FurView view{.camera = view_of_sphere({0, 0, 0}, 1.25, 240, 200), .layers = 16, .passes = 4};
    const FurFrames f = draw(upright, view);
    ASSERT_EQ(f.frame_ms.size(), 4u);
    EXPECT_EQ(covered(f, view, 0, 0.97), 1);        // skin at least
    EXPECT_GT(covered(f, view, 1.01, 1.08), 0.95);  // many strands one behind the other, in every layer: no gaps between them
    EXPECT_LT(covered(f, view, 1.17, 1.2), 0.6);    // few, and pointed
    EXPECT_EQ(covered(f, view, 1.21, 1.3), 0);
    for (const float c : f.colour.texels) ASSERT_TRUE(std::isfinite(c) && c >= 0);
}

TEST_F(FurOnGpu, IsTheSameEveryTimeAndDependsOnItsCoat) {
    FurView view{.camera = view_of_sphere({0, 0, 0}, 1.25, 160, 120), .layers = 8, .passes = 1};
    const FurFrames once = draw(upright, view), again = draw(upright, view);
    EXPECT_EQ(once.colour.texels, again.colour.texels);
    Coat red = upright;
    red.tip_colour = {0.6f, 0.0f, 0.0f};
    red.root_colour = {0.2f, 0.0f, 0.0f};
    const FurFrames tinted = draw(red, view);
    EXPECT_EQ(once.coverage.texels, tinted.coverage.texels);
    double r = 0, b = 0;
    for (std::size_t p = 0; p < tinted.coverage.texels.size(); ++p) {
        r += tinted.colour.texels[p * 3];
        b += tinted.colour.texels[p * 3 + 2];
    }
    EXPECT_GT(r, 3 * b);
    // Curled strands reach less far, and there are programs of their own for them.
    Coat curled = upright;
    curled.curl_radius = 0.6f;
    curled.curl_turns = 2;
    EXPECT_NE(draw(curled, view).coverage.texels, once.coverage.texels);
}

TEST_F(FurOnGpu, LightFromOneSideLightsThatSide) {
    FurView view{.camera = view_of_sphere({0, 0, 0}, 1.25, 160, 120), .to_key = {-1, 0, 0}, .layers = 8, .passes = 2};
    const FurFrames f = draw(upright, view);
    double left = 0, right = 0;
    for (int y = 40; y < 80; ++y)
        for (int x = 40; x < 120; ++x) (x < 80 ? left : right) += f.colour(x, y, 1);
    EXPECT_GT(left, 1.5 * right);
}

TEST_F(FurOnGpu, GrowsOnASingleFace) {
    mesh = {};
    mesh.positions = {{-1, -0.5f, 0}, {1, -0.5f, 0}, {0, 1, 0}};
    mesh.indices = {0, 1, 2};
    mesh.normals = continuous_normals(mesh, NormalMode::angle);
    comb = combed(mesh, 0);
    FurView view{.camera = view_of_sphere({0, 0, 0}, 1.25, 160, 120), .layers = 6, .passes = 1};
    const FurFrames f = draw(upright, view);
    EXPECT_GT(std::ranges::count_if(f.coverage.texels, [](float c) { return c > 0; }), 1000);
}

}  // namespace
}  // namespace relievo
