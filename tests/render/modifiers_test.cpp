// What each modifier does to a picture: the GPU's against the same text on the CPU, and against the exact picture under the same
// modifier.
#include "gpu_fixture.h"

#include "maps/back_side.h"
#include "measure/flip.h"
#include "pipeline/compare.h"
#include "pipeline/map_set_bake.h"
#include "pipeline/reference_picture.h"
#include "render/cpu_renderer.h"
#include "techniques/catalogue.h"

namespace relievo {
namespace {

constexpr auto hit_value = static_cast<std::uint8_t>(Coverage::hit);

class Modified : public test::MaterialFixture {
protected:
    static Frame drawn(const Technique& t, double elevation, const DrawOptions& options, std::vector<Vec2f> offsets = {{0, 0}}) {
        return renderer->draw(stage_at(elevation), *material, t, default_params(t),
                              {.width = across, .height = down, .options = options, .offsets = std::move(offsets)});
    }
    static Frame truth(double elevation, const DrawOptions& options, int samples = 1) {
        const Stage stage = stage_at(elevation);
        std::vector<RayField> rays;
        for (const Vec2f o : sample_offsets(samples)) rays.push_back(renderer->rays(stage, *material, across, down, o));
        return reference_picture(stage, maps, rays, {.height_scale = height_scale, .zero_level = zero_level, .options = options});
    }
    static double mean_difference(const ImageF& a, const ImageF& b) {
        double sum = 0;
        for (std::size_t i = 0; i < a.texels.size(); ++i) sum += std::abs(a.texels[i] - b.texels[i]);
        return sum / static_cast<double>(a.texels.size());
    }
    // Intersection over union of the pixels that show relief.
    static double overlap(const Frame& a, const Frame& b) {
        int both = 0;
        int either = 0;
        for (std::size_t i = 0; i < a.coverage.texels.size(); ++i) {
            const bool in_a = a.coverage.texels[i] == hit_value;
            const bool in_b = b.coverage.texels[i] == hit_value;
            both += in_a && in_b;
            either += in_a || in_b;
        }
        return static_cast<double>(both) / either;
    }
    static constexpr int across = 240;
    static constexpr int down = 136;
};

TEST_F(Modified, everyValueDrawsWhatTheCpuTraces) {
    for (const Modifier& m : modifiers()) {
        // shadow_modes_test.cpp has the shadows; what only colours is compared with the reference below.
        if (m.id == "shadow" || m.id == "edge" || m.id == "mip" || m.id == "shading" || m.id == "sheet" || m.id == "sides") continue;
        for (std::size_t value = 0; value < m.values.size(); ++value)
            for (const char* id : {"relief_mapping", "max_mip_tracing"}) {
                if (static_cast<int>(value) == m.usual) continue;  // gpu_renderer_test.cpp
                const Technique& t = *find_technique(id);
                DrawOptions options;
                options.*m.choice = static_cast<int>(value);
                options.numbers.fade_near = 0.5f;
                options.numbers.fade_far = 2;
                const Stage stage = stage_at(25);
                const RayField rays = renderer->rays(stage, *material, across, down, {0, 0});
                const Frame gpu = drawn(t, 25, options);
                DrawOptions on_cpu = options;
                on_cpu.numbers.chart = chart_of(options, stage.base.periods);
                const Frame cpu = cpu_trace(rays, maps, height_scale, zero_level, stage.lighting, t, default_params(t), on_cpu, 0);
                int covered = 0;
                int different = 0;
                for (std::size_t i = 0; i < gpu.coverage.texels.size(); ++i) {
                    if (rays.coverage.texels[i] == 0) continue;
                    ++covered;
                    different += gpu.coverage.texels[i] != cpu.coverage.texels[i] ||
                                 std::abs(gpu.hit_uv.texels[2 * i] - cpu.hit_uv.texels[2 * i]) > 1e-4f ||
                                 std::abs(gpu.hit_uv.texels[2 * i + 1] - cpu.hit_uv.texels[2 * i + 1]) > 1e-4f ||
                                 std::abs(gpu.shadow.texels[i] - cpu.shadow.texels[i]) > 0.03f;
                }
                EXPECT_LE(different, covered / 200) << id << ' ' << m.id << '=' << m.values[value].id << " of " << covered;
            }
    }
}

// Each way of reflecting gives the reference's colours, and no two the same.
TEST_F(Modified, shadingIsTheReferences) {
    const Technique& exact = *find_technique("max_mip_tracing");
    const Modifier& shading = *find_modifier("shading");
    std::vector<ImageF> pictures;
    for (std::size_t value = 0; value < shading.values.size(); ++value) {
        DrawOptions options;
        options.shading = static_cast<int>(value);
        options.shadow = glsl::shadow_none;
        options.numbers.facets = 16;
        options.numbers.metallic = 0.5f;
        const Frame gpu = drawn(exact, 35, options);
        const Frame right = truth(35, options);
        // Texels of 8 bits, half-float normals and filters of 8 bits: below a hundredth of the brightness of a lit surface.
        EXPECT_LT(mean_difference(gpu.colour, right.colour), 0.004) << shading.values[value].id;
        for (std::size_t other = 0; other < pictures.size(); ++other)
            EXPECT_GT(mean_difference(gpu.colour, pictures[other]), value == glsl::shading_blinn_phong ? 1e-4 : 1e-3)
                << shading.values[value].id << " as " << shading.values[other].id;
        pictures.push_back(gpu.colour);
    }
}

// A relief that ends has the exact silhouette, and without it has not.
TEST_F(Modified, clippingGivesTheSilhouette) {
    for (const int border : {glsl::border_clip, glsl::border_chart}) {
        for (const double elevation : {10.0, 30.0}) {
            DrawOptions options;
            options.border = border;
            const Frame right = truth(elevation, options);
            const auto iou = [&](const char* id, const DrawOptions& with) { return overlap(drawn(*find_technique(id), elevation, with), right); };
            EXPECT_GT(iou("max_mip_tracing", options), 0.999) << border << ' ' << elevation;
            EXPECT_GT(iou("relief_mapping", options), 0.99) << border << ' ' << elevation;
            EXPECT_LT(iou("max_mip_tracing", {}), 0.995) << border << ' ' << elevation << ": there is a silhouette to have";
            EXPECT_GT(std::ranges::count(right.coverage.texels, static_cast<std::uint8_t>(Coverage::no_hit)), 50);
        }
    }
}

// Beyond the border nothing casts a shadow.
TEST_F(Modified, clippingEndsShadowsToo) {
    const Technique& exact = *find_technique("max_mip_tracing");
    Stage stage = stage_at(25);
    stage.lighting.lights.resize(1);
    stage.lighting.lights[0].position = normalize(Vec3f{0.3f, 0.9f, 0.12f});  // from beyond the far edge, and low
    const std::vector<RayField> rays{renderer->rays(stage, *material, across, down, {0, 0})};
    DrawOptions options;
    options.border = glsl::border_chart;
    const auto exactly = [&](const DrawOptions& with) {
        return reference_picture(stage, maps, rays, {.height_scale = height_scale, .zero_level = zero_level, .options = with});
    };
    const Frame gpu = renderer->draw(stage, *material, exact, default_params(exact), {.width = across, .height = down, .options = options});
    const Frame right = exactly(options);
    const Frame endless = exactly({});
    int lit_by_it = 0;
    int lit_here_too = 0;
    for (std::size_t i = 0; i < gpu.shadow.texels.size(); ++i) {
        if (gpu.coverage.texels[i] != hit_value || right.coverage.texels[i] != hit_value) continue;
        if (right.shadow.texels[i] < endless.shadow.texels[i] + 0.5f) continue;
        ++lit_by_it;
        lit_here_too += gpu.shadow.texels[i] > 0.5f;
    }
    EXPECT_GT(lit_by_it, 20);
    EXPECT_GT(lit_here_too, 0.9 * lit_by_it);
}

// Against many samples a pixel, edges that are mixed are nearer the truth than those that are not, from every view. Each published form
// mends the pixels on one side of an edge, which is nearer in the mean square but moves the edge; FLIP, which sees where edges are, may
// find that no better. Both sides together are better by it too.
TEST_F(Modified, mixedEdgesAreBetterThanNone) {
    const Technique& exact = *find_technique("max_mip_tracing");
    for (const char* text : {"10", "35", "65", "20@0.3", "25@3"}) {
        const Stage stage = stage_for(*parse_view(text));
        std::vector<RayField> rays;
        for (const Vec2f o : sample_offsets(25)) rays.push_back(renderer->rays(stage, *material, across, down, o));
        const Frame right = reference_picture(stage, maps, rays, {.height_scale = height_scale, .zero_level = zero_level, .options = {}});
        struct Errors {
            double flip, square;
        };
        const auto errors = [&](int edge) {
            DrawOptions options;
            options.edge = edge;
            const Frame f = renderer->draw(stage, *material, exact, default_params(exact), {.width = across, .height = down, .options = options});
            double sum = 0;
            for (std::size_t i = 0; i < f.colour.texels.size(); ++i) sum += std::pow(f.colour.texels[i] - right.colour.texels[i], 2);
            return Errors{flip(f.colour, right.colour).mean, sum};
        };
        const Errors none = errors(glsl::edge_none);
        const Errors covered = errors(glsl::edge_covered_mode);
        EXPECT_LT(covered.flip, 0.99 * none.flip) << text;
        EXPECT_LT(covered.square, 0.95 * none.square) << text;
        EXPECT_LT(errors(glsl::edge_behind_mode).square, none.square) << text;
        EXPECT_LT(errors(glsl::edge_passed_mode).square, none.square) << text;
    }
}

// Fewer steps where fewer are needed; the exact technique's do not err for it.
TEST_F(Modified, stepsByAngleSaveFetches) {
    const Technique& t = *find_technique("linear_search");
    const auto fetches = [&](double elevation, int steps) {
        DrawOptions options;
        options.steps = steps;
        const Frame f = drawn(t, elevation, options);
        double sum = 0;
        for (const float n : f.fetches.texels) sum += n;
        return sum;
    };
    EXPECT_LT(fetches(75, glsl::steps_cosine), 0.5 * fetches(75, glsl::steps_fixed));
    EXPECT_LT(fetches(75, glsl::steps_texel), 0.5 * fetches(75, glsl::steps_fixed));
    EXPECT_GT(fetches(10, glsl::steps_cosine), 0.7 * fetches(10, glsl::steps_fixed));
}

// A sheet of water that meets the relief is hidden where the relief is higher, pixel by pixel; by the polygon's depth it is hidden
// nowhere or everywhere.
TEST_F(Modified, depthOfTheHitHidesOtherGeometry) {
    const Technique& exact = *find_technique("max_mip_tracing");
    for (const double elevation : {20.0, 50.0}) {
        DrawOptions options;
        options.numbers.sheet_level = 0.4f;
        const auto is_water = [](const Frame& f, std::size_t i) {
            return std::abs(f.colour.texels[3 * i] - 0.02f) + std::abs(f.colour.texels[3 * i + 2] - 0.12f) < 1e-4f;
        };
        const RayField rays = renderer->rays(stage_at(elevation), *material, across, down, {0, 0});
        for (const int sheet : {glsl::sheet_polygon, glsl::sheet_relief}) {
            options.sheet = sheet;
            const Frame f = drawn(exact, elevation, options);
            const Frame right = truth(elevation, options);
            int water = 0, land = 0, wrong = 0;
            for (std::size_t i = 0; i < f.coverage.texels.size(); ++i) {
                if (f.coverage.texels[i] != hit_value || std::abs(f.hit_height.texels[i] - 0.4f) < 2e-3f) continue;
                water += is_water(f, i);
                land += !is_water(f, i);
                wrong += is_water(f, i) != (f.hit_height.texels[i] < 0.4f);
            }
            if (sheet == glsl::sheet_relief) {
                EXPECT_GT(water, 1000);
                EXPECT_GT(land, 1000);
                // The sheet is smaller than the base's picture along the rim, where it lies deeper.
                EXPECT_LT(wrong, (water + land) / 50);
                EXPECT_LT(mean_difference(f.colour, right.colour), 0.004);
            } else {
                EXPECT_EQ(water, 0) << "the sheet lies below the polygon, whose depth hides it all";
            }
        }
    }
}

// From behind the picture is that of the front's own surface, looked for from below: a camera that stands there, the front's heights, and
// a plain march upward. Without the second side there is nothing.
TEST_F(Modified, bothSidesShowOneSheet) {
    const Technique& exact = *find_technique("max_mip_tracing");
    Material front;
    front.height = maps.height;
    front.normal = maps.normal.front();
    front.colour = maps.colour.front();
    front.height_scale = height_scale;
    front.zero_level = zero_level;
    DrawOptions both;
    both.sides = sides_both;
    const Technique* const drawn_by[] = {&exact};
    const BakedMaps back = bake_maps(back_side(front), maps_to_draw(drawn_by, {&both, 1}), {.use_cache = false});
    const auto uploaded = renderer->upload(back.maps, back.height_scale, back.zero_level);
    const Stage stage = stage_at(-35);
    const PictureSettings picture{.width = across, .height = down, .options = both};
    const Frame f = renderer->draw(stage, *uploaded, exact, default_params(exact), picture);

    Camera below = stage.camera;
    below.from_behind = false;
    below.eye.z = -below.eye.z;
    int hits = 0;
    int right = 0;
    double dot_of_normals = 0;
    for (int y = 0; y < down; y += 3)
        for (int x = 0; x < across; x += 3) {
            if (f.coverage(x, y) != hit_value) continue;
            ++hits;
            const Vec3d d = below.ray({x + 0.5, y + 0.5}, across, down);
            const double half = stage.base.periods / 2.0;
            const auto uv_of = [&](double z) {  // at height z of the front's relief
                const double t = ((z - zero_level) * height_scale - below.eye.z) / d.z;
                return Vec2d{below.eye.x + t * d.x + half, below.eye.y + t * d.y + half};
            };
            double z = 0;
            while (z < 1 && z < maps.height.sample(uv_of(z))) z += 1.0 / 4000;
            const Vec2d uv = uv_of(z);
            right += std::hypot(uv.x - f.hit_uv(x, y, 0), uv.y - f.hit_uv(x, y, 1)) < 0.25 / maps.height.width() &&
                     std::abs(1 - z - f.hit_height(x, y)) < 0.005;
            // The front's normal there, reversed: in the mirrored world its z is up again.
            const float* n = maps.normal.front().at(wrap_index(static_cast<int>(std::floor(uv.x * maps.height.width())), maps.height.width()),
                                                    wrap_index(static_cast<int>(std::floor(uv.y * maps.height.height())), maps.height.height()));
            dot_of_normals += -n[0] * f.normal(x, y, 0) - n[1] * f.normal(x, y, 1) + n[2] * f.normal(x, y, 2);
        }
    EXPECT_GT(hits, 1500);
    EXPECT_GT(right, 0.995 * hits);
    EXPECT_GT(dot_of_normals, 0.9 * hits) << "filtered, and of a finer level, but the same";

    for (const int sides : {sides_front, sides_both}) {
        PictureSettings settings = picture;
        settings.options.sides = sides;
        const Frame shown = renderer->draw(stage, *uploaded, exact, default_params(exact), settings);
        std::vector<RayField> rays{renderer->rays(stage, *uploaded, across, down, {0, 0})};
        const Frame truth = reference_picture(stage, back.maps, rays, {.height_scale = back.height_scale, .zero_level = back.zero_level, .options = settings.options});
        EXPECT_EQ(std::ranges::count(shown.coverage.texels, hit_value) > 0, sides == sides_both);
        EXPECT_EQ(std::ranges::count(truth.coverage.texels, hit_value) > 0, sides == sides_both);
        EXPECT_LT(mean_difference(shown.colour, truth.colour), 0.006) << sides;
    }
}

// The relief flattens toward the horizon, and far away: hits come nearer to the polygon.
TEST_F(Modified, scaleAndFadeFlatten) {
    const Technique& exact = *find_technique("max_mip_tracing");
    const RayField rays = renderer->rays(stage_at(15), *material, across, down, {0, 0});
    const auto shift = [&](const DrawOptions& options) {
        const Frame f = drawn(exact, 15, options);
        double sum = 0;
        for (std::size_t i = 0; i < f.coverage.texels.size(); ++i)
            if (f.coverage.texels[i] == hit_value)
                sum += std::hypot(f.hit_uv.texels[2 * i] - rays.uv.texels[2 * i], f.hit_uv.texels[2 * i + 1] - rays.uv.texels[2 * i + 1]);
        return sum;
    };
    DrawOptions cosine;
    cosine.scale = glsl::scale_cosine;
    DrawOptions power;
    power.scale = glsl::scale_power;
    DrawOptions fade;
    fade.fade = glsl::fade_footprint;
    fade.numbers.fade_near = 0;
    fade.numbers.fade_far = 1e-3f;
    EXPECT_LT(shift(cosine), 0.7 * shift({}));
    EXPECT_LT(shift(power), shift({}));
    EXPECT_GT(shift(power), shift(cosine)) << "keeps the height for longer";
    EXPECT_LT(shift(fade), 1e-3 * shift({})) << "every pixel is far";
}

}  // namespace
}  // namespace relievo
