// Contract 2 and 5: on random fields a technique stays inside the budget of its row, judged against the reference, and turning up
// a knob it claims to converge in never makes its mean error worse.
#include "contract/random_fields.h"
#include "contract/trace.h"

#include <array>

namespace relievo::contract {
namespace {

constexpr float height_scale = 0.1f;
constexpr double elevation_deg = 30;
constexpr int rays_per_field = 6000;

struct Question {
    std::string name;
    MapSet maps;
    std::vector<SurfaceRay> rays;
    std::vector<ReferenceHit> answers;
};

// One rolling and one rough field, their zero level at the top, and the true hits.
const std::array<Question, 2>& questions() {
    static const std::array<Question, 2> both = [] {
        std::array<Question, 2> q{Question{.name = "smooth", .maps = baked_maps(smooth_field(11), height_scale), .rays = {}, .answers = {}},
                                  Question{.name = "rough", .maps = baked_maps(rough_field(12), height_scale), .rays = {}, .answers = {}}};
        for (Question& one : q) {
            one.rays = random_rays(rays_per_field, elevation_deg, height_scale, 1.0f, 13);
            for (const SurfaceRay& ray : one.rays) one.answers.push_back(truth(one.maps.height, ray));
        }
        return q;
    }();
    return both;
}

struct Errors {
    double missed = 0;  // share of first hits late by more than half a texel along the ray, or not found
    double uv_p99_texels = 0;
    double uv_mean_texels = 0;
};

Errors errors_of(const Technique& technique, const Question& question, const MarchParams& params) {
    const Vec2d size{static_cast<double>(question.maps.height.width()), static_cast<double>(question.maps.height.height())};
    std::vector<double> off;
    int missed = 0;
    for (std::size_t i = 0; i < question.rays.size(); ++i) {
        const SurfaceRay& ray = question.rays[i];
        const SurfaceHit hit = trace(technique, question.maps, ray, params).hit;
        const Vec2d error = (Vec2d(hit.uv) - question.answers[i].uv) * size;
        const Vec2d descent = normalize(-(Vec2d(ray.uv_per_height) * size));
        missed += !hit.found || dot(error, descent) > 0.5 ? 1 : 0;
        off.push_back(length(error));
    }
    std::ranges::sort(off);
    Errors errors;
    errors.missed = missed / static_cast<double>(off.size());
    errors.uv_p99_texels = off[off.size() * 99 / 100];
    for (const double e : off) errors.uv_mean_texels += e / static_cast<double>(off.size());
    return errors;
}

class RandomSurfaces : public EveryTechnique {};

TEST_P(RandomSurfaces, stays_inside_its_budget) {
    double missed = 0;
    double uv_p99_texels = 0;
    for (const Question& question : questions()) {
        const Errors errors = errors_of(technique(), question, defaults());
        RecordProperty(question.name + "_missed", std::to_string(errors.missed));
        RecordProperty(question.name + "_uv_p99_texels", std::to_string(errors.uv_p99_texels));
        EXPECT_LE(errors.missed, technique().budget.missed) << question.name;
        EXPECT_LE(errors.uv_p99_texels, technique().budget.uv_p99_texels) << question.name;
        missed = std::max(missed, errors.missed);
        uv_p99_texels = std::max(uv_p99_texels, errors.uv_p99_texels);
    }
    // A budget nobody comes near would let a technique rot unseen. Exact searches are allowed their rounding.
    if (technique().exact) return;
    EXPECT_GE(missed, 0.5 * static_cast<double>(technique().budget.missed)) << "tighten the row's budget";
    EXPECT_GE(uv_p99_texels, 0.5 * static_cast<double>(technique().budget.uv_p99_texels)) << "tighten the row's budget";
}

TEST_P(RandomSurfaces, gets_no_worse_with_more_steps) {
    for (const Knob* knob : technique().converges) {
        for (const Question& question : questions()) {
            double before = 1e30;
            std::string history;
            for (float value = std::max(knob->min, 1.0f); value <= std::min(knob->max, 512.0f); value *= 2) {
                MarchParams params = defaults();
                knob->set(params, value);
                const double mean = errors_of(technique(), question, params).uv_mean_texels;
                history += std::string(knob->id) + " " + std::to_string(static_cast<int>(value)) + ": " + std::to_string(mean) + " texels\n";
                // A hundredth of a texel, or a hundredth of the error, is chance and rounding.
                EXPECT_LE(mean, before * 1.01 + 0.01) << question.name << "\n" << history;
                before = mean;
            }
            EXPECT_LT(before, 1.0) << question.name << ": the search does not arrive\n" << history;
        }
    }
}

TEST_P(RandomSurfaces, converges_only_in_knobs_it_has) {
    for (const Knob* knob : technique().converges)
        EXPECT_TRUE(std::ranges::any_of(technique().knobs, [&](const KnobDefault& d) { return d.knob == knob; })) << knob->id;
}

FOR_EVERY_TECHNIQUE(RandomSurfaces);

}  // namespace
}  // namespace relievo::contract
