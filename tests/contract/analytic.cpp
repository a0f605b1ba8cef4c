// Contract 1: on a level field, a ramp, a wedge and a step the hit is the analytic one, within the precision the row states, and
// a row that does not claim a field is measured to be wrong on it.
#include "contract/profile.h"
#include "contract/trace.h"

namespace relievo::contract {
namespace {

// Rounding of uv in float, in height along the flattest ray below.
constexpr double rounding = 3e-5;

struct Verdict {
    int rays = 0;
    int wrong = 0;
    double worst = 0;  // largest distance from an accepted height, in height
};

// How far the hit is from what the precision allows; 0 where it is allowed.
double excess(const Profile& profile, const SurfaceRay& ray, const SurfaceHit& hit, Precision precision) {
    if (!hit.found) return 1;
    // The height a hit is judged by is that at which the ray stands over its uv: a shift off the ray's height is an error.
    const double reach = std::max(std::hypot(ray.uv_per_height.x, ray.uv_per_height.y), 1e-4f);
    const double off = length(Vec2d(hit.uv) - Vec2d(glsl::uv_at(ray, hit.height))) / reach;
    const double z = hit.height;
    double nearest = 1;
    for (const Solid& solid : profile.solids(ray)) {
        if (z > solid.enter) {
            const double early = std::min(z - solid.enter, std::abs(profile.gap(ray, z)));
            return off + std::max(0.0, std::min(nearest, early - precision.error - rounding));
        }
        nearest = std::max(0.0, solid.enter - z - precision.error - rounding);
        if (nearest == 0) return off > rounding / reach ? off : 0;
        if (solid.enter - solid.leave > precision.stride + rounding) break;
    }
    return off + nearest;
}

Verdict judge(const Technique& technique, const MarchParams& params, const Profile& profile) {
    Verdict verdict;
    for (const float height_scale : {0.05f, 0.15f}) {
        const MapSet maps = baked_maps(profile.field(), height_scale);
        for (const float zero_level : {0.0f, 0.5f, 1.0f}) {
            for (const double elevation : {90.0, 60.0, 30.0, 10.0}) {
                for (const double azimuth : {0.0, 180.0, 25.0, 140.0}) {
                    for (int i = 0; i < 48; ++i) {
                        const glsl::vec3 view = view_from(elevation, azimuth);
                        const SurfaceRay ray = glsl::view_ray({(static_cast<float>(i) + 0.37f) / 48, 0.4f}, view, height_scale, zero_level, finest);
                        if (!profile.contains(ray)) continue;
                        const Precision precision = technique.precision ? technique.precision(params, view.z) : Precision{};
                        const double e = excess(profile, ray, trace(technique, maps, ray, params).hit, precision);
                        ++verdict.rays;
                        verdict.wrong += e > 0 ? 1 : 0;
                        verdict.worst = std::max(verdict.worst, e);
                    }
                }
            }
        }
    }
    return verdict;
}

// A claim holds for every ray of every profile; without the claim some ray of some profile is wrong.
void expect_claim(const Technique& technique, const MarchParams& params, bool claimed, const std::vector<Profile>& profiles) {
    int wrong = 0;
    for (const Profile& profile : profiles) {
        const Verdict verdict = judge(technique, params, profile);
        ASSERT_GT(verdict.rays, 100) << profile.name;
        wrong += verdict.wrong;
        if (claimed) {
            EXPECT_EQ(verdict.wrong, 0) << profile.name << ": wrong of " << verdict.rays << " rays, by up to " << verdict.worst
                                        << " of the relief's height beyond the row's precision";
        }
    }
    if (!claimed) {
        EXPECT_GT(wrong, 0) << "the row does not claim this field, yet every hit is right: claim it";
    }
}

std::vector<Profile> levels() {
    std::vector<Profile> all;
    for (const double h : {0.0, 0.3, 0.995, 1.0}) all.push_back({.name = "level at " + std::to_string(h), .kinks = {{0, h}}});
    return all;
}

std::vector<Profile> ramps() {
    return {
        {.name = "gentle ramp", .kinks = {{8, 0.2}, {56, 0.8}}, .first = 8, .last = 56},
        {.name = "steep ramp", .kinks = {{4, 0.0}, {30, 1.0}, {60, 1.0}}, .first = 4, .last = 30},
    };
}

std::vector<Profile> wedges() {
    return {
        {.name = "wide wedge", .kinks = {{16, 0.1}, {32, 0.95}, {48, 0.1}}},
        {.name = "narrow wedge", .kinks = {{28, 0.0}, {32, 1.0}, {36, 0.0}}},
    };
}

std::vector<Profile> steps() {
    return {
        {.name = "step", .kinks = {{20, 0.2}, {21, 0.8}, {44, 0.8}, {45, 0.2}}},
        {.name = "step from floor to top", .kinks = {{20, 0.0}, {21, 1.0}, {30, 1.0}, {31, 0.0}}},
    };
}

class Analytic : public EveryTechnique {};

TEST_P(Analytic, finds_a_level_field) { expect_claim(technique(), defaults(), technique().solves.level, levels()); }
TEST_P(Analytic, finds_a_ramp) { expect_claim(technique(), defaults(), technique().solves.ramp, ramps()); }
TEST_P(Analytic, finds_a_wedge) { expect_claim(technique(), defaults(), technique().solves.wedge, wedges()); }
TEST_P(Analytic, finds_a_step) { expect_claim(technique(), defaults(), technique().solves.step, steps()); }

// Where the relief lies in the polygon there is nothing to find, and where the view is from straight above nothing shifts.
TEST_P(Analytic, shows_the_texel_under_the_ray_where_nothing_shifts) {
    for (const float zero_level : {0.0f, 0.5f, 1.0f}) {
        const MapSet level = baked_maps(HeightField(16, 16, zero_level), 0.1f);
        for (const SurfaceRay& ray : random_rays(64, 25, 0.1f, zero_level, 7)) {
            const SurfaceHit hit = trace(technique(), level, ray, defaults()).hit;
            EXPECT_TRUE(hit.found);
            const double allowed = technique().precision ? technique().precision(defaults(), ray.view.z).error : 0;
            EXPECT_NEAR(hit.height, zero_level, allowed + rounding);
            EXPECT_LE(length(hit.uv - ray.uv), (allowed + rounding) * length(ray.uv_per_height));
        }
        const MapSet hills = baked_maps(HeightField(wedges()[0].field()), 0.1f);
        for (const SurfaceRay& ray : random_rays(64, 90, 0.1f, zero_level, 8)) {
            const SurfaceHit hit = trace(technique(), hills, ray, defaults()).hit;
            EXPECT_TRUE(hit.found);
            EXPECT_LE(length(hit.uv - ray.uv), 1e-6f);
        }
    }
}

// "Exact" promises more than the closed forms above show; it cannot be claimed beside a stride or a failure.
TEST_P(Analytic, claims_agree_with_each_other) {
    const Technique& t = technique();
    const bool any = t.solves.level || t.solves.ramp || t.solves.wedge || t.solves.step;
    EXPECT_EQ(any, t.precision != nullptr) << "a precision is stated exactly where something is solved";
    if (!t.exact) return;
    EXPECT_TRUE(t.solves.level && t.solves.ramp && t.solves.wedge && t.solves.step);
    const Precision p = t.precision(defaults(), 0.5f);
    EXPECT_EQ(p.error, 0);
    EXPECT_EQ(p.stride, 0);
}

FOR_EVERY_TECHNIQUE(Analytic);

}  // namespace
}  // namespace relievo::contract
