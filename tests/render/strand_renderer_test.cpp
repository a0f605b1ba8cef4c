// Strands plotted: a strand alone covers what its form says, near and far, and a coat hangs together.
#include "render/strand_renderer.h"

#include "fur/comb.h"
#include "mesh/made_up_scan.h"
#include "mesh/normals.h"
#include "render/gpu_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace relievo {
namespace {

class StrandsOnGpu : public testing::Test {
protected:
    void SetUp() override {
        if (std::ranges::none_of(gpu_devices(), [](const GpuDevice& d) { return d.lacks.empty(); }))
            GTEST_SKIP() << "no Vulkan device: install a driver (mesa-vulkan-drivers is a software one)";
        renderer = std::make_unique<StrandRenderer>("", true);
    }
    void TearDown() override {
        if (!renderer) return;
        for (const std::string& message : renderer->validation_messages()) ADD_FAILURE() << message;
    }
    void grow(const Mesh& mesh, const Coat& coat) { grow(mesh, coat, grow_roots(mesh, {.count = static_cast<std::uint32_t>(coat.strands)})); }
    void grow(const Mesh& mesh, const Coat& coat, const Roots& roots, float lengths = 1) {
        const std::vector<Vec3f> comb = combed(mesh, 0);
        const RootedStrands strands = rooted_strands(mesh, comb, std::vector<float>(mesh.positions.size(), lengths), roots);
        const auto spacing = static_cast<float>(std::sqrt(roots.area / static_cast<double>(strands.places.size())));
        renderer->load({.mesh = &mesh, .comb = &comb, .strands = &strands, .coat = coat, .spacing = spacing});
    }
    static double sum(const ImageF& image) {
        double s = 0;
        for (const float v : image.texels) s += static_cast<double>(v);
        return s;
    }
    std::unique_ptr<StrandRenderer> renderer;
};

Mesh ball(std::uint32_t faces) {
    Mesh mesh = made_up_scan({.faces = faces, .relief = 0, .noise = 0});
    mesh.normals = continuous_normals(mesh, NormalMode::angle);
    return mesh;
}

const Coat upright{.strands = 6000, .length = 0.2f, .tilt = 0, .bend = 0, .spread = 0, .width = 0.35f, .length_variation = 0, .lock = 0, .guard_hairs = 0};

// Strands that stand one beside the other in a row, seen from its side, cover the sum of their own areas.
TEST_F(StrandsOnGpu, StrandsAloneCoverTheAreaOfTheirForm) {
    Mesh strip;
    strip.positions = {{-1, 0, 0}, {1, 0, 0}, {1, 0, -1e-4f}, {-1, 0, -1e-4f}};
    strip.indices = {0, 1, 2, 0, 2, 3};
    strip.normals = std::vector<Vec3f>(4, {0, 1, 0});
    Roots row;
    for (int i = 0; i < 19; ++i) row.roots.push_back({.position = {-0.9f + 0.1f * static_cast<float>(i), 0, 0}, .face = 0});
    row.area = static_cast<double>(row.roots.size());  // so that distances between roots are units
    Coat coat = upright;
    coat.length = 0.5f;
    coat.taper = 0;  // cones
    coat.width = 0.01f;
    grow(strip, coat, row);
    FurView view{.camera = {.camera = {.eye = {0, 0.25, 4}, .target = {0, 0.25, 0}, .up = {0, 1, 0}, .fov_y_rad = 0.4}, .width = 400, .height = 200}, .layers = 4, .passes = 64};
    const double pixels_per_unit = view.camera.height / (2 * 4 * std::tan(0.2)), all = 19 * 0.5 * 0.01 * pixels_per_unit * pixels_per_unit;
    EXPECT_NEAR(sum(renderer->draw(view).coverage) / all, 1, 0.01);
    // From so far away that each is a quarter of a pixel wide, fewer are drawn and thicker: as much in the mean.
    view.camera.width = 40;
    view.camera.height = 20;
    view.passes = 256;
    EXPECT_NEAR(sum(renderer->draw(view).coverage) * 100 / all, 1, 0.03);
    // Half as long, as wide at the root: half the area.
    grow(strip, coat, row, 0.5f);
    view.camera.width = 400;
    view.camera.height = 200;
    view.passes = 64;
    EXPECT_NEAR(sum(renderer->draw(view).coverage) / all, 0.5, 0.01);
}

TEST_F(StrandsOnGpu, CoversTheBallAndARingAroundIt) {
    grow(ball(2000), upright);
    const FurView view{.camera = view_of_sphere({0, 0, 0}, 1.25, 240, 200), .layers = 3, .passes = 8};
    const FurFrames f = renderer->draw(view);
    ASSERT_EQ(f.frame_ms.size(), 8u);
    ASSERT_EQ(f.stages.size(), 8u);
    const double distance = length(view.camera.camera.eye), half = std::tan(view.camera.camera.fov_y_rad / 2);
    const auto covered = [&](double inner, double outer) {
        double total = 0;
        int pixels = 0;
        for (int y = 0; y < f.coverage.height; ++y)
            for (int x = 0; x < f.coverage.width; ++x) {
                const double px = (2 * x + 1 - f.coverage.width) * half / f.coverage.height, py = (2 * y + 1 - f.coverage.height) * half / f.coverage.height;
                const double radius = distance * std::sin(std::atan(std::hypot(px, py)));
                if (radius < inner || radius > outer) continue;
                total += static_cast<double>(f.coverage(x, y));
                ++pixels;
            }
        EXPECT_GT(pixels, 20);
        return total / pixels;
    };
    EXPECT_NEAR(covered(0, 0.97), 1, 1e-5);   // skin at least
    EXPECT_GT(covered(1.01, 1.08), 0.95);     // many strands one behind the other: no gaps
    EXPECT_LT(covered(1.17, 1.2), 0.6);       // few, and pointed
    EXPECT_EQ(covered(1.21, 1.3), 0);
    for (const float c : f.colour.texels) ASSERT_TRUE(std::isfinite(c) && c >= 0);
}

// Room made beforehand, whether it fits or not, changes no picture, and the second is no sum of two.
TEST_F(StrandsOnGpu, ExpectingAPictureDoesNotChangeIt) {
    const Mesh mesh = ball(2000);
    const FurView view{.camera = view_of_sphere({0, 0, 0}, 1.25, 240, 200), .layers = 3, .passes = 2};
    grow(mesh, upright);
    const FurFrames plain = renderer->draw(view);
    for (const std::size_t strands : {std::size_t{1}, std::size_t{7000}, std::size_t{50000}})
        for (const int width : {240, 100, 400}) {
            FurView expected = view;
            expected.camera.width = width;
            expected.layers = 5;
            renderer->expect(expected, strands);
            grow(mesh, upright);
            for (int time = 0; time < 2; ++time) {
                const FurFrames again = renderer->draw(view);
                ASSERT_EQ(again.colour.texels, plain.colour.texels) << strands << ' ' << width << ' ' << time;
                ASSERT_EQ(again.coverage.texels, plain.coverage.texels);
            }
        }
}

TEST_F(StrandsOnGpu, IsTheSameEveryTimeAndDependsOnItsCoat) {
    const Mesh mesh = ball(2000);
    const FurView view{.camera = view_of_sphere({0, 0, 0}, 1.25, 160, 120), .layers = 8, .passes = 1};
    grow(mesh, upright);
    const FurFrames once = renderer->draw(view), again = renderer->draw(view);
    EXPECT_EQ(once.colour.texels, again.colour.texels);
    for (const Coat& other : {Coat{.strands = 6000, .length = 0.2f}, Coat{.strands = 6000, .length = 0.2f, .lock = 0}, Coat{.strands = 6000, .length = 0.2f, .curl_radius = 0.5f, .curl_turns = 3}}) {
        grow(mesh, other);
        EXPECT_NE(renderer->draw(view).colour.texels, once.colour.texels);
    }
    grow(mesh, upright);
    EXPECT_EQ(renderer->draw(view).colour.texels, once.colour.texels);  // nothing of the models in between is left
}

// A turned camera whose frame is drawn after another's size and number of pieces.
TEST_F(StrandsOnGpu, ForgetsTheViewBefore) {
    grow(ball(2000), Coat{.strands = 6000, .length = 0.2f});
    const FurView small{.camera = view_of_sphere({0, 0, 0}, 1.25, 90, 70), .layers = 4, .passes = 1}, large{.camera = view_of_sphere({0, 0, 0}, 1.25, 160, 120), .layers = 7, .passes = 2};
    const FurFrames first = renderer->draw(small);
    renderer->draw(large);
    EXPECT_EQ(renderer->draw(small).colour.texels, first.colour.texels);
}

TEST_F(StrandsOnGpu, NothingIsSeenOfABallBehindTheEye) {
    grow(ball(500), upright);
    FurView view{.camera = view_of_sphere({0, 0, 0}, 1.25, 64, 48), .layers = 3, .passes = 1};
    view.camera.camera.target = view.camera.camera.eye * 2.0;
    EXPECT_EQ(sum(renderer->draw(view).coverage), 0);
    // Within the fur nothing breaks: strands that pass the eye are left out.
    view.camera.camera = {.eye = {0, 0, 1.1}, .target = {0, 0, 0}, .up = {0, 1, 0}};
    for (const float c : renderer->draw(view).colour.texels) ASSERT_TRUE(std::isfinite(c) && c >= 0);
}

}  // namespace
}  // namespace relievo
