// Pictures by the GPU against the camera's own geometry and against the same text run on the CPU.
#include "render/gpu_renderer.h"
#include "core/error.h"
#include "render/cpu_renderer.h"
#include "small_maps.h"
#include "techniques/catalogue.h"

#include <gtest/gtest.h>

#include <random>

namespace relievo {
namespace {

constexpr float height_scale = 0.1f;
constexpr float zero_level = 0.8f;  // neither end, so that a mistaken sign shows
constexpr int width = 320;
constexpr int height = 180;

std::string device_or_empty() {
    for (const GpuDevice& d : gpu_devices())
        if (d.lacks.empty()) return d.name;
    return {};
}

// One renderer, under validation, and one material for all tests.
class OnGpu : public testing::Test {
protected:
    static void SetUpTestSuite() {
        if (device_or_empty().empty()) return;
        maps = small_maps_made();
        renderer = std::make_unique<GpuRenderer>("", true);
        material = renderer->upload(maps, height_scale, zero_level);
    }
    static void TearDownTestSuite() {
        material.reset();
        renderer.reset();
    }
    void SetUp() override {
        if (!renderer) GTEST_SKIP() << "no Vulkan device: install a driver (mesa-vulkan-drivers is a software one)";
    }
    void TearDown() override {
        if (!renderer) return;
        const auto messages = renderer->validation_messages();
        for (; messages_seen < messages.size(); ++messages_seen) ADD_FAILURE() << messages[messages_seen];
    }
    static MapSet small_maps_made() { return test::small_maps(64, height_scale); }

    static inline std::size_t messages_seen = 0;
    static inline MapSet maps;
    static inline std::unique_ptr<GpuRenderer> renderer;
    static inline std::shared_ptr<const GpuMaterial> material;
};

Stage stage_at(double elevation_deg) { return stage_for(View{.id = "test", .elevation_deg = elevation_deg}); }

TEST_F(OnGpu, raysAreTheCameras) {
    for (const double elevation : {15.0, 35.0, 65.0, 90.0}) {
        for (const Vec2f offset : {Vec2f{0, 0}, Vec2f{0.375f, -0.25f}}) {
            const Stage stage = stage_at(elevation);
            const RayField gpu = renderer->rays(stage, *material, width, height, offset);
            const RayField exact = quad_rays(stage, width, height, Vec2d(offset));
            int covered = 0;
            int edge = 0;
            for (int y = 0; y < height; ++y) {
                for (int x = 0; x < width; ++x) {
                    covered += exact.coverage(x, y);
                    if (gpu.coverage(x, y) != exact.coverage(x, y)) {
                        ++edge;
                        continue;
                    }
                    if (exact.coverage(x, y) == 0) continue;
                    // Rasterisers place vertices on a grid of 1/256 pixel; a share of 1/32 of a pixel's footprint leaves room for
                    // interpolation in float at grazing views and is far below what any judgement of pictures resolves.
                    const float pixel = std::exp2(exact.lod(x, y));
                    ASSERT_NEAR(gpu.uv(x, y, 0), exact.uv(x, y, 0), pixel / 32) << elevation << " at " << x << ", " << y;
                    ASSERT_NEAR(gpu.uv(x, y, 1), exact.uv(x, y, 1), pixel / 32) << elevation << " at " << x << ", " << y;
                    for (int c = 0; c < 3; ++c) ASSERT_NEAR(gpu.view(x, y, c), exact.view(x, y, c), 1e-4f);
                    // Differences between neighbours are taken to either side: the footprint itself changes from pixel to pixel.
                    ASSERT_NEAR(gpu.lod(x, y), exact.lod(x, y), 0.1f);
                }
            }
            EXPECT_GT(covered, width * height / 8);
            // Pixels whose centre lies on the base's edge to within the vertex grid.
            EXPECT_LE(edge, covered / 500) << elevation;
        }
    }
}

// Row 0 is the top of the screen and u grows to the right: the far edge is up, and nothing is mirrored.
TEST_F(OnGpu, pictureIsUpright) {
    Stage stage = stage_at(60);
    stage.camera.eye = {0, -1.5, 2.6};
    const RayField rays = renderer->rays(stage, *material, width, height, {0, 0});
    EXPECT_GT(rays.uv(width / 2, height / 4, 1), rays.uv(width / 2, 3 * height / 4, 1));
    EXPECT_GT(rays.uv(3 * width / 4, height / 2, 0), rays.uv(width / 4, height / 2, 0));
    // The letter F of the colour map, seen almost from above: its stem is left of its open side, its arms in the upper half.
    const Technique& plain = *find_technique("texture_mapping");
    const Frame frame = renderer->draw(stage, *material, plain, default_params(plain), {.width = width, .height = height});
    const auto red_at = [&](float u, float v) {
        float best = 1e9f;
        bool red = false;
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                if (frame.coverage(x, y) == 0) continue;
                const float d = std::hypot(rays.uv(x, y, 0) - u, rays.uv(x, y, 1) - v);
                if (d < best) {
                    best = d;
                    red = frame.colour(x, y, 0) > 1.5f * frame.colour(x, y, 1);
                }
            }
        }
        return red;
    };
    EXPECT_TRUE(red_at(1.19f, 1.2f));   // foot of the stem
    EXPECT_FALSE(red_at(1.7f, 1.2f));   // right of it
    EXPECT_TRUE(red_at(1.7f, 1.8f));    // upper arm
    EXPECT_FALSE(red_at(1.7f, 1.45f));  // right of the short arm
}

// Analytic: a flat field of height 0.5 under polygon level 0.8 is hit where the ray is 0.3 of the relief's height below it.
TEST_F(OnGpu, flatFieldIsHitWhereGeometrySays) {
    MapSet flat;
    flat.height = HeightField(16, 16, 0.5f);
    flat.max_pyramid = test::brute_force_pyramid(flat.height);
    flat.cone = test::brute_force_cones(flat.height);
    const auto on_device = renderer->upload(flat, height_scale, zero_level);
    const Stage stage = stage_at(35);
    const RayField rays = renderer->rays(stage, *on_device, width, height, {0, 0});
    for (const char* id : {"parallax_mapping", "relief_mapping", "parallax_occlusion_mapping", "max_mip_tracing"}) {
        const Technique& technique = *find_technique(id);
        const Frame frame =
            renderer->draw(stage, *on_device, technique, default_params(technique), {.width = width, .height = height});
        for (int y = 0; y < height; y += 7) {
            for (int x = 0; x < width; x += 5) {
                if (rays.coverage(x, y) == 0) continue;
                const float* view = rays.view.at(x, y);
                const float shift = (0.5f - zero_level) * height_scale / view[2];
                // One bisection's last interval, 1 / (30 * 64), along the ray.
                const float tolerance = height_scale * std::hypot(view[0], view[1]) / view[2] / 1920 + 1e-5f;
                ASSERT_NEAR(frame.hit_uv(x, y, 0), rays.uv(x, y, 0) + shift * view[0], tolerance) << id;
                ASSERT_NEAR(frame.hit_uv(x, y, 1), rays.uv(x, y, 1) + shift * view[1], tolerance) << id;
                ASSERT_EQ(frame.normal(x, y, 2), 1.0f) << "a missing normal map is flat";
                ASSERT_EQ(frame.shadow(x, y), 1.0f) << id << ": nothing rises above a flat field";
            }
        }
    }
}

// Analytic: Lambert and Phong terms of one directional and one near light on a flat white-grey plane.
TEST_F(OnGpu, colourIsTheFormula) {
    MapSet flat;
    flat.height = HeightField(4, 4, 1.0f);
    flat.colour = {Image8(1, 1, 4, 255)};
    const auto on_device = renderer->upload(flat, height_scale, 1.0f);
    const Technique& plain = *find_technique("texture_mapping");
    for (const int copies : {1, 7}) {  // with 7 the last lights come from the storage buffer
        Stage stage = stage_at(50);
        stage.lighting.ambient = {0.1f, 0.2f, 0.3f};
        stage.lighting.specular = 0.4f;
        stage.lighting.shininess = 8;
        Light sun;
        sun.position = normalize(Vec3f{0.3f, 0.8f, 0.5f});
        sun.colour = {0.5f, 0.6f, 0.7f};
        Light lamp;
        lamp.directional = false;
        lamp.position = {0.2f, -0.3f, 0.4f};
        lamp.colour = {0.3f, 0.2f, 0.1f};
        lamp.constant = 1;
        lamp.linear = 0.5f;
        lamp.quadratic = 2;
        stage.lighting.lights.clear();
        for (int i = 0; i < copies; ++i) {
            stage.lighting.lights.push_back(sun);
            stage.lighting.lights.push_back(lamp);
        }
        const RayField rays = renderer->rays(stage, *on_device, width, height, {0, 0});
        const Frame frame = renderer->draw(stage, *on_device, plain, default_params(plain), {.width = width, .height = height});
        for (int y = 3; y < height; y += 10) {
            for (int x = 3; x < width; x += 10) {
                if (rays.coverage(x, y) == 0) {
                    ASSERT_EQ(frame.colour(x, y, 2), stage.lighting.background.z);
                    continue;
                }
                const Vec3f v{rays.view(x, y, 0), rays.view(x, y, 1), rays.view(x, y, 2)};
                const float centre = stage.base.periods / 2;
                const Vec3f position{rays.uv(x, y, 0) - centre, rays.uv(x, y, 1) - centre, 0};
                Vec3f expected = stage.lighting.ambient;
                for (const Light& light : stage.lighting.lights) {
                    const Vec3f way = light.position - position;
                    const float d = length(way);
                    const Vec3f l = light.directional ? light.position : way / d;
                    const float arrives = light.directional ? 1 : 1 / (light.constant + light.linear * d + light.quadratic * d * d);
                    const Vec3f r{-l.x, -l.y, l.z};
                    expected += light.colour * arrives * (l.z + 0.4f * std::pow(std::max(0.0f, dot(r, v)), 8.0f));
                }
                ASSERT_NEAR(frame.colour(x, y, 0), expected.x, 2e-3f * expected.x) << copies;
                ASSERT_NEAR(frame.colour(x, y, 1), expected.y, 2e-3f * expected.y) << copies;
                ASSERT_NEAR(frame.colour(x, y, 2), expected.z, 2e-3f * expected.z) << copies;
            }
        }
    }
}

// A plateau throws its shadow away from the light, exactly as far as its height demands.
TEST_F(OnGpu, shadowFallsAwayFromTheLight) {
    MapSet step;
    step.height = HeightField(256, 256, 0.0f);
    for (int j = 0; j < 256; ++j)
        for (int i = 128; i < 192; ++i) step.height.texels(i, j) = 1.0f;
    step.max_pyramid = test::brute_force_pyramid(step.height);
    const auto on_device = renderer->upload(step, height_scale, 1.0f);
    Stage stage = stage_at(89);
    stage.lighting.lights.resize(1);
    stage.lighting.lights[0].position =
        normalize(Vec3f{1, 0, 1});  // from +u, 45 degrees up: the shadow is as long as the step is high
    const Technique& exact = *find_technique("max_mip_tracing");
    const Frame frame = renderer->draw(stage, *on_device, exact, default_params(exact), {.width = width, .height = height});
    DrawOptions unshadowed;
    unshadowed.shadow = glsl::shadow_none;
    const Frame unlit = renderer->draw(stage, *on_device, exact, default_params(exact),
                                       {.width = width, .height = height, .options = unshadowed});
    int shadowed = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            if (frame.coverage(x, y) != static_cast<std::uint8_t>(Coverage::hit)) continue;
            ASSERT_EQ(unlit.shadow(x, y), 1.0f);
            const float u = frame.hit_uv(x, y, 0) - std::floor(frame.hit_uv(x, y, 0));
            if (frame.hit_height(x, y) > 0.001f) continue;
            // Walls stand between texel centres 127.5 and 128.5; the shadow of the left one's top reaches 0.1 to its left.
            const bool hidden = u > 128.5f / 256 - 0.1f && u < 0.5f;
            if (std::abs(u - (128.5f / 256 - 0.1f)) < 0.002f) continue;
            ASSERT_EQ(frame.shadow(x, y), hidden ? 0.0f : 1.0f) << u;
            shadowed += hidden;
        }
    }
    EXPECT_GT(shadowed, 100);
}

// Emboss has no normal and so no highlight; what has one shines.
TEST_F(OnGpu, embossDoesNotShine) {
    Stage dull = stage_at(35);
    dull.lighting.specular = 0;
    Stage shiny = dull;
    shiny.lighting.specular = 5;
    shiny.lighting.shininess = 2;
    const PictureSettings settings{.width = width, .height = height};
    const auto draw = [&](const char* id, const Stage& stage) {
        const Technique& t = *find_technique(id);
        return renderer->draw(stage, *material, t, default_params(t), settings).colour.texels;
    };
    EXPECT_EQ(draw("emboss_bump", dull), draw("emboss_bump", shiny));
    EXPECT_NE(draw("bump_mapping", dull), draw("bump_mapping", shiny));
    EXPECT_NE(draw("emboss_bump", dull), draw("texture_mapping", dull));
}

class EveryTechnique : public OnGpu, public testing::WithParamInterface<const Technique*> {};

INSTANTIATE_TEST_SUITE_P(catalogue, EveryTechnique, testing::ValuesIn([] {
                             std::vector<const Technique*> all;
                             for (const Technique& technique : techniques()) all.push_back(&technique);
                             return all;
                         }()),
                         [](const auto& one) { return std::string(one.param->id); });

// Devices round, fuse and filter a little differently from the CPU, so a comparison that decides between two steps or two
// surfaces may fall the other way. Everything else must agree.
constexpr double allowed_flips = 0.005;  // share of pixels; Mesa 22.3's software device: none at all
constexpr float same_uv = 1e-4f;         // a hundredth of a texel of these maps (1/64), and a share of it at 512
constexpr float same_height = 1e-3f;
constexpr float same_normal = 4e-3f;  // half floats (5e-4) filtered, where the CPU filters floats

TEST_P(EveryTechnique, drawsWhatTheCpuTraces) {
    const Technique& technique = *GetParam();
    const MarchParams params = default_params(technique);
    for (const double elevation : {15.0, 35.0, 65.0}) {
        const Stage stage = stage_at(elevation);
        const RayField rays = renderer->rays(stage, *material, width, height, {0, 0});
        const Frame gpu = renderer->draw(stage, *material, technique, params, {.width = width, .height = height});
        const Frame cpu = cpu_trace(rays, maps, height_scale, zero_level, stage.lighting, technique, params, {}, 0);
        int covered = 0;
        int moved = 0;
        int turned = 0;
        int shaded = 0;
        int fetched = 0;
        double gpu_fetches = 0;
        double cpu_fetches = 0;
        for (std::size_t i = 0; i < gpu.coverage.texels.size(); ++i) {
            ASSERT_EQ(gpu.coverage.texels[i] != 0, rays.coverage.texels[i] != 0);
            if (rays.coverage.texels[i] == 0) continue;
            ++covered;
            if (gpu.coverage.texels[i] != cpu.coverage.texels[i] ||
                std::abs(gpu.hit_uv.texels[2 * i] - cpu.hit_uv.texels[2 * i]) > same_uv ||
                std::abs(gpu.hit_uv.texels[2 * i + 1] - cpu.hit_uv.texels[2 * i + 1]) > same_uv ||
                std::abs(gpu.hit_height.texels[i] - cpu.hit_height.texels[i]) > same_height) {
                ++moved;
                continue;
            }
            float angle = 0;
            for (std::size_t c = 0; c < 3; ++c)
                angle = std::max(angle, std::abs(gpu.normal.texels[3 * i + c] - cpu.normal.texels[3 * i + c]));
            turned += angle > same_normal;
            shaded += gpu.shadow.texels[i] != cpu.shadow.texels[i];
            fetched += gpu.fetches.texels[i] != cpu.fetches.texels[i];
            gpu_fetches += static_cast<double>(gpu.fetches.texels[i]);
            cpu_fetches += static_cast<double>(cpu.fetches.texels[i]);
            ASSERT_LE(gpu.fetches.texels[i], static_cast<float>(technique.max_fetches(params)));
        }
        EXPECT_LE(moved, covered * allowed_flips) << elevation << " of " << covered;
        EXPECT_LE(turned, covered * allowed_flips) << elevation;
        EXPECT_LE(shaded, covered * allowed_flips) << elevation;
        EXPECT_LE(fetched, covered * allowed_flips) << elevation;
        EXPECT_NEAR(gpu_fetches, cpu_fetches, cpu_fetches * allowed_flips) << elevation;
    }
}

TEST_P(EveryTechnique, castsLikeTheFunction) {
    const Technique& technique = *GetParam();
    const MarchParams params = default_params(technique);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<glsl::SurfaceRay> rays(2000);
    for (auto& ray : rays) {
        const float z = 0.05f + 0.9f * unit(random);
        const float angle = 6.2831853f * unit(random);
        ray.uv = {4 * unit(random) - 2, 4 * unit(random) - 2};
        ray.view = {std::sqrt(1 - z * z) * std::cos(angle), std::sqrt(1 - z * z) * std::sin(angle), z};
        ray.height_scale = height_scale;
        ray.uv_per_height = Vec2f(ray.view) * (height_scale / z);
        ray.zero_level = zero_level;
        ray.z_start = 1;
        ray.z_end = unit(random) < 0.5f ? 0.0f : 0.5f * unit(random);  // half of them like shadow rays
        ray.lod = -6;
    }
    const auto casts = renderer->cast(*material, technique, params, rays);
    ASSERT_EQ(casts.size(), rays.size());
    int different = 0;
    glsl::bound_maps = glsl::BoundMaps{.maps = &maps, .readable = MapFlags().set()};
    for (std::size_t i = 0; i < rays.size(); ++i) {
        glsl::fetch_count = 0;
        const auto hit = technique.heightfield(rays[i], params);
        const auto& cast = casts[i];
        ASSERT_TRUE(std::isfinite(cast.hit.uv.x) && std::isfinite(cast.hit.uv.y) && std::isfinite(cast.hit.height));
        ASSERT_LE(cast.fetches, technique.max_fetches(params));
        different += cast.hit.found != hit.found || length(cast.hit.uv - hit.uv) > same_uv ||
                     std::abs(cast.hit.height - hit.height) > same_height ||
                     cast.fetches != glsl::fetch_count;
    }
    glsl::bound_maps = {};
    EXPECT_LE(different, static_cast<int>(2000 * allowed_flips));
}

TEST_P(EveryTechnique, drawsTheSameTwice) {
    const Technique& technique = *GetParam();
    const PictureSettings settings{.width = 96, .height = 64, .offsets = {{-0.25f, 0.25f}, {0.25f, -0.25f}}};
    const Frame a = renderer->draw(stage_at(35), *material, technique, default_params(technique), settings);
    const Frame b = renderer->draw(stage_at(35), *material, technique, default_params(technique), settings);
    EXPECT_EQ(a.colour.texels, b.colour.texels);
    EXPECT_EQ(a.hit_uv.texels, b.hit_uv.texels);
    EXPECT_EQ(a.fetches.texels, b.fetches.texels);
    EXPECT_EQ(a.shadow.texels, b.shadow.texels);
}

TEST_F(OnGpu, timesEveryRun) {
    const Technique& cheap = *find_technique("texture_mapping");
    const Technique& dear = *find_technique("relief_mapping");
    MarchParams many = default_params(dear);
    many.max_steps = 300;
    const GpuRenderer::Timed timed[] = {{&cheap, default_params(cheap)}, {&dear, many}};
    const auto frames = renderer->draw_timed(stage_at(35), *material, timed, {.width = width, .height = height}, 3);
    ASSERT_EQ(frames.size(), 2u);
    ASSERT_EQ(frames[0].gpu_ms.size(), 3u);
    EXPECT_GT(*std::ranges::min_element(frames[0].gpu_ms), 0);
    EXPECT_GT(*std::ranges::min_element(frames[1].gpu_ms), 2 * *std::ranges::min_element(frames[0].gpu_ms));
}

// Timed runs double as samples; the picture must be the one that is drawn without a stopwatch, however many runs there are.
TEST_F(OnGpu, timingLeavesThePictureAlone) {
    const Technique& t = *find_technique("relief_mapping");
    const PictureSettings settings{.width = width, .height = height, .offsets = {{0, 0}, {0.25f, 0.25f}, {-0.25f, 0.125f}}};
    const Frame plain = renderer->draw(stage_at(35), *material, t, default_params(t), settings);
    const GpuRenderer::Timed timed[] = {{&t, default_params(t)}};
    for (const int runs : {1, 2, 7}) {
        const auto frames = renderer->draw_timed(stage_at(35), *material, timed, settings, runs);
        EXPECT_EQ(frames[0].gpu_ms.size(), static_cast<std::size_t>(runs));
        EXPECT_EQ(frames[0].colour.texels, plain.colour.texels);
        EXPECT_EQ(frames[0].hit_uv.texels, plain.hit_uv.texels);
    }
}

TEST_F(OnGpu, refusesPicturesOfNoSize) {
    const Technique& plain = *find_technique("texture_mapping");
    EXPECT_THROW(renderer->draw(stage_at(35), *material, plain, default_params(plain), {.width = 0, .height = 10}), Error);
    EXPECT_THROW(renderer->draw(stage_at(35), *material, plain, default_params(plain), {.width = 1 << 20, .height = 10}), Error);
}

TEST_F(OnGpu, refusesAChainThatDoesNotHalve) {
    MapSet broken = maps;
    broken.normal[1] = ImageF(3, 3, 3, 0.5f);
    EXPECT_THROW(renderer->upload(broken, height_scale, zero_level), Error);
}

}  // namespace
}  // namespace relievo
