// The ways of finding a shadow: the GPU's against the same text on the CPU, and each against the exact share of an area light.
#include "gpu_fixture.h"

#include "pipeline/reference_picture.h"
#include "render/cpu_renderer.h"
#include "techniques/catalogue.h"

namespace relievo {
namespace {

class ShadowModes : public test::MaterialFixture {
protected:
    static DrawOptions with(int shadow) {
        DrawOptions options;
        options.shadow = shadow;
        options.numbers.light_radius = 0.06f;
        return options;
    }
    static double mean_error(const Frame& a, const Frame& b) {
        double sum = 0;
        int n = 0;
        for (std::size_t i = 0; i < a.coverage.texels.size(); ++i) {
            if (a.coverage.texels[i] != 1 || b.coverage.texels[i] != 1) continue;
            sum += std::abs(a.shadow.texels[i] - b.shadow.texels[i]);
            ++n;
        }
        return sum / n;
    }
};

TEST_F(ShadowModes, drawWhatTheCpuTraces) {
    const std::size_t modes = find_modifier("shadow")->values.size();
    constexpr int across = 160;
    constexpr int down = 90;
    for (const char* id : {"normal_mapping", "relief_mapping", "max_mip_tracing"}) {
        const Technique& technique = *find_technique(id);
        for (std::size_t mode = 0; mode < modes; ++mode) {
            DrawOptions options = with(static_cast<int>(mode));
            options.numbers.shadow_samples = 5;
            const Stage stage = stage_at(35);
            const RayField rays = renderer->rays(stage, *material, across, down, {0, 0});
            const Frame gpu = renderer->draw(stage, *material, technique, default_params(technique),
                                             {.width = across, .height = down, .options = options});
            const Frame cpu = cpu_trace(rays, maps, height_scale, zero_level, stage.lighting, technique, default_params(technique), options, 0);
            int covered = 0;
            int different = 0;
            for (std::size_t i = 0; i < gpu.shadow.texels.size(); ++i) {
                if (gpu.coverage.texels[i] != 1) continue;
                ++covered;
                // Half floats of the horizon (1/2048 of 90 degrees) beside a disc of 0.06 radians: a 40th of its share at most.
                different += std::abs(gpu.shadow.texels[i] - cpu.shadow.texels[i]) > 0.03f;
            }
            EXPECT_LE(different, covered / 200) << id << ' ' << find_modifier("shadow")->values[mode].id;
        }
    }
}

// Rays need a technique that finds hits; everything else works even on a flat polygon (Max 1988 had nothing more).
TEST_F(ShadowModes, onlyRaysNeedATracingTechnique) {
    const Technique& flat = *find_technique("normal_mapping");
    const auto darkest = [&](int mode) {
        const Frame f = renderer->draw(stage_at(35), *material, flat, default_params(flat), {.width = width, .height = height, .options = with(mode)});
        float least = 1;
        for (std::size_t i = 0; i < f.shadow.texels.size(); ++i)
            if (f.coverage.texels[i] == 1) least = std::min(least, f.shadow.texels[i]);
        return least;
    };
    for (const int mode : {glsl::shadow_none, glsl::shadow_hard, glsl::shadow_area}) EXPECT_EQ(darkest(mode), 1.0f) << mode;
    for (const int mode : {glsl::shadow_soft, glsl::shadow_tatarchuk, glsl::shadow_horizon}) EXPECT_LT(darkest(mode), 0.1f) << mode;
}

// Under an exact search only the shadow's own way errs. Brute force is right; the horizon map is nearly so, for what it blurs between
// its directions (mean over pixels that are mostly lit); eight heights are not.
TEST_F(ShadowModes, areScoredByAnAreaLight) {
    const Technique& exact = *find_technique("max_mip_tracing");
    const Stage stage = stage_at(60);
    const RayField rays = renderer->rays(stage, *material, width, height, {0, 0});
    for (const float radius : {0.06f, 0.25f}) {
        const auto of = [&](int mode) {
            DrawOptions options = with(mode);
            options.numbers.light_radius = radius;
            options.numbers.shadow_samples = 32;
            return options;
        };
        const Frame truth = reference_picture(stage, maps, {&rays, 1},
                                              {.height_scale = height_scale, .zero_level = zero_level, .options = of(glsl::shadow_area)});
        const auto error = [&](int mode) {
            return mean_error(renderer->draw(stage, *material, exact, default_params(exact), {.width = width, .height = height, .options = of(mode)}), truth);
        };
        const double hard = error(glsl::shadow_hard);
        const double horizon = error(glsl::shadow_horizon);
        EXPECT_LT(error(glsl::shadow_area), 0.01) << radius;
        EXPECT_LT(horizon, 0.03) << radius;
        EXPECT_LT(horizon, 0.5 * error(glsl::shadow_tatarchuk)) << radius;
        EXPECT_GT(error(glsl::shadow_none), 2 * hard) << radius;
        if (radius > 0.1f) {
            EXPECT_LT(horizon, hard) << "a light this large is no point";
        }
    }
}

// Twice the light, twice the penumbra; no size at all, the hard shadow.
TEST_F(ShadowModes, penumbraGrowsWithTheLight) {
    const Technique& exact = *find_technique("max_mip_tracing");
    for (const int mode : {glsl::shadow_horizon, glsl::shadow_area}) {
        const auto between = [&](float radius) {
            DrawOptions options = with(mode);
            options.numbers.light_radius = radius;
            const Frame f = renderer->draw(stage_at(60), *material, exact, default_params(exact), {.width = width, .height = height, .options = options});
            return std::ranges::count_if(f.shadow.texels, [](float s) { return s > 0.1f && s < 0.9f; });
        };
        const auto none = between(1e-4f);
        const auto small = between(0.03f);
        const auto large = between(0.06f);
        EXPECT_LT(none, small / 4) << mode;
        EXPECT_GT(static_cast<double>(large), 1.5 * static_cast<double>(small)) << mode;
    }
}

// Fewer steps leave hits deeper below the field, which must not read as shadow: of the ground that is lit, as little turns dark as with all
// steps, and some more where walls are met late.
TEST_F(ShadowModes, fewerStepsDoNotShadeThemselves) {
    const Technique& exact = *find_technique("max_mip_tracing");
    const Technique& linear = *find_technique("linear_search");
    const auto drawn = [&](const Technique& technique, int steps) {
        DrawOptions options = with(glsl::shadow_hard);
        options.steps = steps;
        return renderer->draw(stage_at(60), *material, technique, default_params(technique), {.width = width, .height = height, .options = options});
    };
    const Frame truth = drawn(exact, glsl::steps_fixed);
    const auto darkened = [&](int steps) {
        const Frame f = drawn(linear, steps);
        int lit = 0, dark = 0;
        for (std::size_t i = 0; i < f.shadow.texels.size(); ++i) {
            if (f.coverage.texels[i] != 1 || truth.shadow.texels[i] < 1) continue;
            ++lit;
            dark += f.shadow.texels[i] < 1;
        }
        return static_cast<double>(dark) / lit;
    };
    const double with_all = darkened(glsl::steps_fixed);
    for (const int steps : {glsl::steps_cosine, glsl::steps_texel}) EXPECT_LT(darkened(steps), with_all + 0.03) << steps;
}

// Beyond the border nothing casts a shadow, whichever way the shadow is found: where the relief without end would shade a point and the
// one that ends does not, it is lit.
TEST_F(ShadowModes, endWithTheRelief) {
    constexpr int across = 160;
    constexpr int down = 90;
    const Technique& exact = *find_technique("max_mip_tracing");
    Stage stage = stage_at(25);
    stage.lighting.lights.resize(1);
    stage.lighting.lights[0].position = normalize(Vec3f{0.3f, 0.9f, 0.12f});  // from beyond the far edge, and low
    const RayField rays = renderer->rays(stage, *material, across, down, {0, 0});
    const auto truth_of = [&](int border) {
        DrawOptions options = with(glsl::shadow_area);
        options.border = border;
        return reference_picture(stage, maps, {&rays, 1}, {.height_scale = height_scale, .zero_level = zero_level, .options = options});
    };
    const Frame right = truth_of(glsl::border_chart);
    const Frame endless = truth_of(glsl::border_repeat);
    for (const int mode : {glsl::shadow_soft, glsl::shadow_tatarchuk, glsl::shadow_horizon}) {
        DrawOptions options = with(mode);
        options.border = glsl::border_chart;
        const Frame f = renderer->draw(stage, *material, exact, default_params(exact), {.width = across, .height = down, .options = options});
        int lit_by_it = 0;
        double light = 0;
        for (std::size_t i = 0; i < f.shadow.texels.size(); ++i) {
            if (f.coverage.texels[i] != 1 || right.coverage.texels[i] != 1 || endless.coverage.texels[i] != 1) continue;
            if (right.shadow.texels[i] < endless.shadow.texels[i] + 0.5f) continue;
            ++lit_by_it;
            light += f.shadow.texels[i];
        }
        EXPECT_GT(lit_by_it, 20);
        EXPECT_GT(light, 0.9 * lit_by_it) << find_modifier("shadow")->values[static_cast<std::size_t>(mode)].id;
        if (mode == glsl::shadow_horizon) {
            EXPECT_LT(mean_error(f, right), 0.05);
        }
    }
}

// An exact search needs no distance from its hit: hard shadows are the reference's to the pixel, feet and all.
TEST_F(ShadowModes, hardOnesOfAnExactSearchAreTheReferences) {
    for (const char* id : {"max_mip_tracing", "cell_cone_tracing"}) {
        const Technique& exact = *find_technique(id);
        int compared = 0;
        int different = 0;
        for (const double elevation : {15.0, 35.0, 65.0}) {
            const Stage stage = stage_at(elevation);
            const RayField rays = renderer->rays(stage, *material, width, height, {0, 0});
            const DrawOptions options = with(glsl::shadow_hard);
            const Frame f = renderer->draw(stage, *material, exact, default_params(exact), {.width = width, .height = height, .options = options});
            const Frame right = reference_picture(stage, maps, {&rays, 1}, {.height_scale = height_scale, .zero_level = zero_level, .options = options});
            for (std::size_t i = 0; i < f.shadow.texels.size(); ++i) {
                if (f.coverage.texels[i] != 1 || right.coverage.texels[i] != 1) continue;
                ++compared;
                different += std::abs(f.shadow.texels[i] - right.shadow.texels[i]) > 0.5f;
            }
        }
        EXPECT_GT(compared, 50000);
        EXPECT_LE(different, compared / 5000) << id << " of " << compared;  // pixels whose hits float puts on the other side of a shadow's line
    }
}

}  // namespace
}  // namespace relievo
