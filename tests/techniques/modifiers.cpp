// The modifiers' own formulas, run from the shader text: ends and middles that can be written down.
#include "techniques/modifiers.h"

#include "techniques/catalogue.h"

#include <gtest/gtest.h>

#include <random>

namespace relievo::glsl {
namespace {

thread_local HeightFieldFunction technique = nullptr;  // what the text calls

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include "shading/edge_blend.glsl"
#include "shading/light_disc.glsl"
#include "shading/own_cell.glsl"
#include "surface/by_angle.glsl"
#include "surface/chart.glsl"
#include "surface/hit_footprint.glsl"
#pragma GCC diagnostic pop

TEST(Modifiers, idsAreUniqueAndDefaultsChangeNothing) {
    const DrawOptions usual;
    EXPECT_EQ(described(usual), "");
    std::vector<std::string_view> ids;
    for (const Modifier& m : modifiers()) {
        EXPECT_EQ(usual.*m.choice, m.usual) << m.id;
        ids.push_back(m.id);
        for (std::size_t i = 0; i < m.values.size(); ++i) {
            DrawOptions options;
            options.*m.choice = static_cast<int>(i);
            EXPECT_EQ(described(options).empty(), static_cast<int>(i) == m.usual) << m.id;
        }
    }
    for (const ModifierNumber& n : modifier_numbers()) {
        ids.push_back(n.id);
        DrawOptions options;
        EXPECT_NEAR(n.get(options), n.initial, 1e-5f * (1 + n.initial)) << n.id;
        n.set(options, 1e9f);
        EXPECT_NEAR(n.get(options), n.max, 1e-5f * n.max) << n.id;
        n.set(options, -1e9f);
        EXPECT_NEAR(n.get(options), n.min, 1e-5f) << n.id;
        EXPECT_LT(n.values, 1u << n.of->values.size()) << n.id;
        EXPECT_NE(n.values, 0u) << n.id;
    }
    std::ranges::sort(ids);
    EXPECT_EQ(std::ranges::adjacent_find(ids), ids.end());
}

TEST(Modifiers, stepsRunFromFewestToMost) {
    EXPECT_EQ(steps_by_angle(64, 0.3f, 500, steps_fixed, 8), 64);
    EXPECT_EQ(steps_by_angle(64, 1, 500, steps_cosine, 8), 8);
    EXPECT_EQ(steps_by_angle(64, 0, 500, steps_cosine, 8), 64);
    EXPECT_EQ(steps_by_angle(64, 0.5f, 500, steps_cosine, 8), 36);
    EXPECT_EQ(steps_by_angle(64, 0.9f, 0, steps_texel, 8), 8);
    EXPECT_EQ(steps_by_angle(64, 0.9f, 20.5f, steps_texel, 8), 21);
    EXPECT_EQ(steps_by_angle(64, 0.1f, 500, steps_texel, 8), 64);
    EXPECT_EQ(steps_by_angle(4, 1, 0, steps_texel, 8), 4) << "the technique's own limit holds";
}

TEST(Modifiers, scaleCurvesMeetTheirEnds) {
    for (const float z : {0.0f, 0.3f, 1.0f}) EXPECT_EQ(scale_by_angle(z, scale_fixed, 0.25f, 4), 1.0f);
    EXPECT_FLOAT_EQ(scale_by_angle(1, scale_cosine, 0.25f, 4), 1);
    EXPECT_FLOAT_EQ(scale_by_angle(0, scale_cosine, 0.25f, 4), 0.25f);
    EXPECT_FLOAT_EQ(scale_by_angle(0.5f, scale_cosine, 0.25f, 4), 0.625f);
    EXPECT_FLOAT_EQ(scale_by_angle(1, scale_power, 0, 4), 1);
    EXPECT_FLOAT_EQ(scale_by_angle(0, scale_power, 0, 4), 0);
    EXPECT_FLOAT_EQ(scale_by_angle(0.5f, scale_power, 0, 4), 1 - 1.0f / 16);
    EXPECT_FLOAT_EQ(scale_by_footprint(8, 8, 32), 1);
    EXPECT_FLOAT_EQ(scale_by_footprint(20, 8, 32), 0.5f);
    EXPECT_FLOAT_EQ(scale_by_footprint(100, 8, 32), 0);
}

SurfaceRay ray_from(vec2 uv, vec3 view, float height_scale, float zero_level) { return view_ray(uv, normalize(view), height_scale, zero_level, -8); }

// Over the chart between the two heights, and nowhere else on the ray.
TEST(Modifiers, chartKeepsExactlyWhatIsOverIt) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> unit(0, 1);
    int cut = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const SurfaceRay ray = ray_from({3 * unit(random) - 1, 3 * unit(random) - 1}, {2 * unit(random) - 1, 2 * unit(random) - 1, 0.05f + unit(random)},
                                        0.2f, unit(random));
        const SurfaceRay over = over_chart(ray, 1);
        cut += over.z_start < ray.z_start || over.z_end > ray.z_end;
        for (int k = 0; k <= 20; ++k) {
            const float z = 0.05f * static_cast<float>(k);
            const vec2 uv = uv_at(ray, z);
            const float inside = std::min(std::min(uv.x, 1 - uv.x), std::min(uv.y, 1 - uv.y));
            if (std::abs(inside) < 1e-4f) continue;
            EXPECT_EQ(z >= over.z_end && z <= over.z_start, inside > 0) << trial << ' ' << z;
        }
    }
    EXPECT_GT(cut, 500);
    EXPECT_FALSE(on_chart({1.01f, 0.5f}, 1));
    EXPECT_TRUE(on_chart({1.01f, 0.5f}, 0)) << "without a chart everything is on it";
}

// A point of the polygon seen at the polygon's own slope has the polygon's footprint; a flank that faces the eye a smaller one.
TEST(Modifiers, footprintOfTheHitIsThePolygonsOnThePolygon) {
    for (const float z : {0.1f, 0.4f, 0.9f}) {
        const vec3 view = normalize(vec3(0.6f, -0.8f, 0) * std::sqrt(1 - z * z) + vec3(0, 0, z));
        const float pixel_angle = 0.002f;
        const float distance = 1.7f;
        EXPECT_NEAR(std::exp2(hit_lod(view, {0, 0, 1}, pixel_angle, distance)), pixel_angle * distance / z, 1e-5f);
        EXPECT_LT(hit_lod(view, view, pixel_angle, distance), hit_lod(view, {0, 0, 1}, pixel_angle, distance));
        EXPECT_NEAR(hit_lod(view, {0, 0, 1}, pixel_angle, 2 * distance), hit_lod(view, {0, 0, 1}, pixel_angle, distance) + 1, 1e-4f);
    }
}

TEST(Modifiers, discIsRoundAndOnTheLight) {
    const vec3 light = normalize(vec3(0.5f, -0.3f, 0.6f));
    for (const vec2 p : {vec2(1, 0), vec2(0, 1), vec2(-0.6f, 0.8f), vec2(0, 0)}) {
        const vec3 d = disc_direction(light, 0.05f, p);
        EXPECT_NEAR(length(d), 1, 1e-5f);
        EXPECT_NEAR(std::acos(std::min(1.0f, dot(d, light))), 0.05f * length(p), 2e-3f);
    }
    EXPECT_FLOAT_EQ(disc_above(-2), 0);
    EXPECT_FLOAT_EQ(disc_above(0), 0.5f);
    EXPECT_FLOAT_EQ(disc_above(2), 1);
    EXPECT_NEAR(disc_above(0.5f), 0.80450f, 1e-4f);  // 1/2 + (sqrt(3)/4 + pi/6) / pi
}

// The patch under a ray that starts on it, by a thousand samples of the cell in double: clear to the cell's wall, or met again before.
TEST(Modifiers, ownCellIsSolvedForItsSecondRoot) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0, 1);
    MapSet maps;
    maps.height = HeightField(16, 8);
    for (float& h : maps.height.texels.texels) h = unit(random);
    bound_maps = BoundMaps{.maps = &maps, .readable = MapFlags().set(index_of(Map::height))};
    int hidden = 0, returning = 0, clear = 0;
    for (int trial = 0; trial < 4000; ++trial) {
        SurfaceHit hit;
        hit.uv = {2 * unit(random) - 1, 2 * unit(random) - 1};
        const vec2 pace{unit(random) * 0.5f - 0.25f, trial % 10 == 0 ? 0 : unit(random) * 0.5f - 0.25f};
        const double x = hit.uv.x * 16 - 0.5, y = hit.uv.y * 8 - 0.5;
        const double from = maps.height.sample(Vec2d(hit.uv));
        const auto to_wall = [](double at, double by) { return by == 0 ? 1e9 : (by > 0 ? std::floor(at) + 1 - at : at - std::floor(at)) / std::abs(by); };
        const double wall = std::min(to_wall(x, pace.x * 16.0), to_wall(y, pace.y * 8.0));
        double first = 0, most = -1;
        for (int k = 1; k < 1000; ++k) {
            const double t = wall * k / 1000;
            const double gap = maps.height.sample({hit.uv.x + t * pace.x, hit.uv.y + t * pace.y}) - from - t;
            if (k == 1) first = gap;
            most = std::max(most, gap);
        }
        hit.height = static_cast<float>(from);
        const float climb = climb_out_of_cell(hit, pace);
        if (std::abs(most) < 1e-4) continue;  // touches, or hardly leaves
        EXPECT_EQ(climb < 0, most > 0) << trial << " gap " << most;
        if (climb >= 0) {
            EXPECT_NEAR(climb, wall, 1e-3 * (1 + wall));
        }
        clear += climb >= 0;
        hidden += climb < 0;
        returning += climb < 0 && first < 0;
    }
    bound_maps = {};
    EXPECT_GT(clear, 500);
    EXPECT_GT(hidden, 300);
    EXPECT_GT(returning, 20) << "leave the patch and meet it again";
}

// A plateau and floor behind it. Rays over its far edge at a known gap see of it what is left of half their pixel; rays just under
// the edge see of the floor the same.
class Edges : public testing::Test {
protected:
    Edges() {
        maps.height = HeightField(256, 4, 0.0f);
        for (int j = 0; j < 4; ++j)
            for (int i = 100; i < 140; ++i) maps.height.texels(i, j) = 0.5f;
        bound_maps = BoundMaps{.maps = &maps, .readable = MapFlags().set(index_of(Map::height))};
        technique = find_technique("linear_search")->heightfield;
        params = default_params(*find_technique("linear_search"));
        params.max_steps = 400;
    }
    ~Edges() override {
        bound_maps = {};
        technique = nullptr;
    }
    // Comes from +u over the plateau's left edge, which it passes `gap` heights above.
    SurfaceRay passing(float gap) const {
        SurfaceRay ray = ray_from({0, 0.3f}, {0.94f, 0, 0.34f}, 0.1f, 1);
        ray.uv.x = 100.5f / 256 + (1 - (0.5f + gap)) * ray.uv_per_height.x;
        ray.lod = std::log2(0.2f * ray.uv_per_height.x);  // a pixel is 0.2 heights
        return ray;
    }
    MapSet maps;
    MarchParams params;
};

TEST_F(Edges, coveredSharesThePixelByTheGap) {
    int seen = 0;
    for (const float gap : {0.01f, 0.03f, 0.05f, 0.08f, 0.095f, 0.12f, 0.2f}) {
        const SurfaceRay ray = passing(gap);
        const SurfaceHit hit = technique(ray, params);
        ASSERT_TRUE(hit.found);
        ASSERT_LT(hit.height, 0.4f) << "the floor behind the plateau";
        const EdgeNeighbour other = edge_covered(ray, hit, params, 0, 48);
        EXPECT_NEAR(other.share, std::max(0.0f, 0.5f - gap / 0.2f), 0.03f) << gap;
        if (other.share > 0) {
            EXPECT_NEAR(other.hit.height, 0.5f, 0.01f) << "the plateau";
            ++seen;
        }
    }
    EXPECT_GE(seen, 4);
    for (const float gap : {-0.02f, -0.05f, -0.08f}) {
        const SurfaceRay ray = passing(gap);
        const SurfaceHit hit = technique(ray, params);
        ASSERT_NEAR(hit.height, 0.5f, 0.02f);
        const EdgeNeighbour other = edge_covered(ray, hit, params, 0, 48);
        EXPECT_NEAR(other.share, 0.5f + gap / 0.2f, 0.06f) << gap;
        ASSERT_TRUE(other.hit.found);
        EXPECT_LT(other.hit.height, 0.4f) << "the floor";
    }
}

TEST_F(Edges, passedSharesThePixelByTheWidth) {
    const SurfaceRay ray = passing(0.02f);
    const EdgeNeighbour other = edge_passed(ray, technique(ray, params), 0.05f, 64);
    EXPECT_NEAR(other.share, 0.5f - 0.5f * 0.02f / 0.05f, 0.05f);
    EXPECT_NEAR(other.hit.height, 0.5f, 0.01f);
    EXPECT_EQ(edge_passed(passing(0.1f), technique(passing(0.1f), params), 0.05f, 64).share, 0.0f) << "too far above";
    SurfaceRay near = ray;  // a pixel is 0.03 heights
    near.lod = std::log2(0.03f * ray.uv_per_height.x);
    EXPECT_EQ(edge_passed(near, technique(near, params), 0.05f, 64).share, 0.0f) << "more than half a pixel away";
}

TEST_F(Edges, behindSharesThePixelThatMetAnEdge) {
    const SurfaceRay met = passing(-0.005f);
    const EdgeNeighbour other = edge_behind(met, technique(met, params), params, 0);
    EXPECT_EQ(other.share, 0.375f);
    EXPECT_LT(other.hit.height, 0.4f);
    SurfaceRay near = met;  // a pixel is 0.004 heights: the edge is more than one away
    near.lod = std::log2(0.004f * met.uv_per_height.x);
    EXPECT_EQ(edge_behind(near, technique(near, params), params, 0).share, 0.0f);
    const SurfaceRay deep = passing(-0.3f);
    EXPECT_EQ(edge_behind(deep, technique(deep, params), params, 0).share, 0.0f);
}

// In the middle of a level field there is no edge.
TEST_F(Edges, levelFieldsHaveNone) {
    SurfaceRay ray = ray_from({0.1f, 0.3f}, {0.2f, 0.1f, 0.9f}, 0.1f, 1);
    ray.lod = -8;
    const SurfaceHit hit = technique(ray, params);
    for (const int mode : {edge_behind_mode, edge_passed_mode, edge_covered_mode})
        EXPECT_EQ(edge_neighbour(ray, hit, params, mode, 0.05f, 48, 0).share, 0.0f) << mode;
}

}  // namespace
}  // namespace relievo::glsl
