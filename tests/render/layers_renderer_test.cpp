// Uniform layers on a ball: where they may be and where they must be, what light they show, and which texel is seen where.
#include "render/layers_renderer.h"

#include "fur/fur_map.h"
#include "fur/lapped.h"
#include "mesh/made_up_scan.h"
#include "render/gpu_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace relievo {
namespace {

class LayersOnGpu : public testing::Test {
protected:
    void SetUp() override {
        if (std::ranges::none_of(gpu_devices(), [](const GpuDevice& d) { return d.lacks.empty(); }))
            GTEST_SKIP() << "no Vulkan device: install a driver (mesa-vulkan-drivers is a software one)";
        renderer = std::make_unique<LayersRenderer>("", true);
        mesh = made_up_scan({.faces = 4000, .relief = 0, .noise = 0});
        mesh.normals = mesh.positions;
        for (Vec3f& n : mesh.normals) n = normalize(n);
    }
    void TearDown() override {
        if (!renderer) return;
        for (const std::string& message : renderer->validation_messages()) ADD_FAILURE() << message;
    }
    static int faces_of(MapShape shape) { return shape == MapShape::cube ? 6 : 1; }
    static DirectionMap strands(MapShape shape, double density) {
        std::vector<Image8> faces;
        for (int f = 0; f < faces_of(shape); ++f) faces.push_back(fur_map({.width = 64, .height = 64, .density = density, .seed = static_cast<std::uint32_t>(f)}).texels);
        return direction_map(shape, faces, false);
    }
    static DirectionMap plain(MapShape shape, std::uint8_t value) { return direction_map(shape, std::vector(static_cast<std::size_t>(faces_of(shape)), Image8(64, 64, 4, value)), true); }
    FurFrames draw(const DirectionMap& fur, const DirectionMap& colour, const FurView& seen, LayersModel model = {}) {
        model.mesh = &mesh;
        model.fur = &fur;
        model.colour = &colour;
        model.height = 0.2f;
        renderer->load(model);
        return renderer->draw(seen);
    }
    static double radius_at(const FurView& view, int x, int y) {
        const double half = std::tan(view.camera.camera.fov_y_rad / 2);
        const double px = (2 * x + 1 - view.camera.width) * half / view.camera.height, py = (2 * y + 1 - view.camera.height) * half / view.camera.height;
        return length(view.camera.camera.eye) * std::sin(std::atan(std::hypot(px, py)));
    }
    const FurView view{.camera = view_of_sphere({0, 0, 0}, 1.25, 160, 120), .layers = 8, .passes = 1};
    std::unique_ptr<LayersRenderer> renderer;
    Mesh mesh;
};

TEST_F(LayersOnGpu, CoverTheBallAndUpToTheirHeight) {
    for (const MapShape shape : {MapShape::cube, MapShape::sphere}) {
        const FurFrames full = draw(strands(shape, 1), plain(shape, 255), view);
        for (int y = 0; y < 120; ++y)
            for (int x = 0; x < 160; ++x) {
                const double r = radius_at(view, x, y);
                // The sphere's disc ends in a rim of its own: behind the ball.
                if (r < 1.18) { ASSERT_EQ(full.coverage(x, y), 1) << x << ' ' << y; }
                if (r > 1.22) { ASSERT_EQ(full.coverage(x, y), 0) << x << ' ' << y; }
            }
        const FurFrames bald = draw(strands(shape, 0), plain(shape, 255), view);
        for (int y = 0; y < 120; ++y)
            for (int x = 0; x < 160; ++x) {
                const double r = radius_at(view, x, y);
                if (r < 0.97) { ASSERT_EQ(bald.coverage(x, y), 1); }
                if (r > 1.02) { ASSERT_EQ(bald.coverage(x, y), 0); }
            }
    }
}

TEST_F(LayersOnGpu, BlendByAlphaFromTheInsideOut) {
    // Every texel half transparent: n layers leave 2^-n of the skin, which is black here. Seen in the middle, where the ball faces the eye.
    DirectionMap half = plain(MapShape::cube, 255);
    half.colours = false;
    for (auto& face : half.faces)
        for (Image8& level : face)
            for (std::size_t t = 3; t < level.texels.size(); t += 4) level.texels[t] = 128;
    const DirectionMap white = plain(MapShape::cube, 255);
    for (const int layers : {1, 2, 5}) {
        FurView some = view;
        some.layers = layers;
        const FurFrames f = draw(half, white, some, {.light = {.ambient = 0.5f, .diffuse = 0, .specular = 0}, .skin = {0, 0, 0}});
        EXPECT_NEAR(f.colour(80, 60, 0), 0.5 * (1 - std::pow(127.0 / 255, layers)), 0.012) << layers;
        EXPECT_EQ(f.coverage(80, 60), 1);
        // Beyond the ball only layers are met: the outermost one twice at the most.
        EXPECT_LT(f.coverage(80, 60 - 47), 1);
    }
}

TEST_F(LayersOnGpu, AreLitByKajiyaAndKay) {
    const DirectionMap full = strands(MapShape::cube, 1), grey = plain(MapShape::cube, 188);  // 0.5 linear
    FurView lit = view;
    const Vec3d eye = normalize(lit.camera.camera.eye);
    const auto middle = [&](LayersLight light) { return static_cast<double>(draw(full, grey, lit, {.light = light}).colour(80, 60, 1)); };
    lit.to_key = eye;  // along the strands in the middle of the picture
    EXPECT_NEAR(middle({.ambient = 0.6f, .diffuse = 0, .specular = 0}), 0.3, 0.006);
    EXPECT_NEAR(middle({.ambient = 0, .diffuse = 1, .specular = 0}), 0, 0.03);
    lit.to_key = cross(eye, Vec3d(0, 1, 0));  // square to them
    EXPECT_NEAR(middle({.ambient = 0, .diffuse = 1, .specular = 0}), 0.5, 0.006);
    EXPECT_NEAR(middle({.ambient = 0, .diffuse = 0, .specular = 0.7f, .power = 8}), 0, 0.03);
    // At 60 degrees from the light's mirrored cone: cos^power.
    lit.to_key = eye * -std::cos(3.14159265 / 3) + cross(eye, Vec3d(0, 1, 0)) * std::sin(3.14159265 / 3);
    const double cosine = 0.5;  // the strand there points to the eye, so that only t.l (-1 * -0.5) is left
    EXPECT_NEAR(middle({.ambient = 0, .diffuse = 0, .specular = 0.8f, .power = 2}), 0.8 * cosine * cosine, 0.05);  // the pixel lies 2 degrees beside the middle
}

TEST_F(LayersOnGpu, LookTexelsUpWhereTheTableSays) {
    // Each face of the cube in a grey of its own, on a ball, where all addressings mean one direction.
    std::vector<Image8> faces;
    for (int f = 0; f < 6; ++f) {
        faces.emplace_back(64, 64, 4, 255);
        for (std::size_t t = 0; t < faces.back().texels.size(); t += 4) std::fill_n(&faces.back().texels[t], 3, static_cast<std::uint8_t>(40 + 35 * f));
    }
    const DirectionMap greys = direction_map(MapShape::cube, faces, true), full = strands(MapShape::cube, 1);
    for (const AddressingEntry& a : addressings)
        for (const bool filtered : {false, true}) {
            const FurFrames f = draw(full, greys, view, {.addressing = a.addressing, .filtered = filtered, .light = {.ambient = 1, .diffuse = 0, .specular = 0}});
            int seen = 0;
            for (int y = 0; y < 120; y += 3)
                for (int x = 0; x < 160; x += 3) {
                    if (radius_at(view, x, y) > 1.1) continue;
                    // Where the ray meets the outermost layer.
                    const Vec3d eye = view.camera.camera.eye, ray = view.camera.camera.ray({x + 0.5, y + 0.5}, 160, 120);
                    const double b = dot(eye, ray), t = -b - std::sqrt(b * b - dot(eye, eye) + 1.44);
                    const MapPoint p = map_point(MapShape::cube, eye + ray * t);
                    if (std::min({p.u, p.v, 1 - p.u, 1 - p.v}) < 0.05) continue;
                    const double v = (40 + 35 * p.face) / 255.0, linear = std::pow((v + 0.055) / 1.055, 2.4);
                    EXPECT_NEAR(f.colour(x, y, 0), linear, 0.02) << a.id << ' ' << x << ' ' << y;
                    ++seen;
                }
            EXPECT_GT(seen, 300);
        }
}

TEST_F(LayersOnGpu, LappedPatchesLeaveNoSeams) {
    // A square full of strands: wherever patches meet, one of them covers.
    const std::vector<Vec3f> comb(mesh.positions.size());
    const Lapped patches = lapped(mesh, comb, {.radius = 0.35});
    const DirectionMap full = direction_map(MapShape::sphere, {patch_texture(64, 1, 1)}, false), grey = plain(MapShape::sphere, 188);
    renderer->load({.mesh = &patches.mesh, .fur = &full, .colour = &grey, .comb = &patches.comb, .height = 0.2f, .light = {.ambient = 1, .diffuse = 0, .specular = 0}, .skin = {0, 0, 0}});
    const FurFrames f = renderer->draw(view);
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x) {
            const double r = radius_at(view, x, y);
            if (r < 1.1) { ASSERT_NEAR(f.colour(x, y, 0), 0.5, 0.01) << x << ' ' << y; }  // no skin, which is black
            if (r < 1.17) { ASSERT_GT(f.coverage(x, y), 0.9) << x << ' ' << y; }
            if (r > 1.22) { ASSERT_EQ(f.coverage(x, y), 0) << x << ' ' << y; }
        }
    // Strands that lean reach less far.
    renderer->load({.mesh = &patches.mesh, .fur = &full, .colour = &grey, .comb = &patches.comb, .tilt = 0, .bend = 0, .height = 0.2f});
    std::vector<Vec3f> side;
    for (const Vec3f& n : patches.mesh.normals) side.push_back(cross(n, Vec3f(0, 1, 0)));
    renderer->load({.mesh = &patches.mesh, .fur = &full, .colour = &grey, .comb = &side, .tilt = 1, .bend = 0.3f, .height = 0.2f});
    const FurFrames leaning = renderer->draw(view);
    double upright_sum = 0, leaning_sum = 0;
    for (std::size_t p = 0; p < f.coverage.texels.size(); ++p) {
        upright_sum += f.coverage.texels[p];
        leaning_sum += leaning.coverage.texels[p];
    }
    EXPECT_LT(leaning_sum, 0.97 * upright_sum);
}

TEST_F(LayersOnGpu, AreTheSameEveryTime) {
    FurView several = view;
    several.passes = 3;
    const DirectionMap some = strands(MapShape::sphere, 0.2), white = plain(MapShape::sphere, 255);
    const FurFrames once = draw(some, white, several), again = draw(some, white, several);
    EXPECT_EQ(once.colour.texels, again.colour.texels);
    EXPECT_EQ(once.frame_ms.size(), 3u);
}

}  // namespace
}  // namespace relievo
