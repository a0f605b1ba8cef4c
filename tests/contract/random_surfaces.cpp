// Contract 5: on random fields, judged against the reference, turning up a knob that a technique claims to converge in never makes its
// mean error worse.
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

double mean_uv_error_texels(const Technique& technique, const Question& question, const MarchParams& params) {
    const Vec2d size{static_cast<double>(question.maps.height.width()), static_cast<double>(question.maps.height.height())};
    std::vector<double> off;
    for (std::size_t i = 0; i < question.rays.size(); ++i) {
        const SurfaceRay& ray = question.rays[i];
        const SurfaceHit hit = trace(technique, question.maps, ray, params).hit;
        const Vec2d error = (Vec2d(hit.uv) - question.answers[i].uv) * size;
        off.push_back(length(error));
    }
    double mean = 0;
    for (const double e : off) mean += e / static_cast<double>(off.size());
    return mean;
}

class RandomSurfaces : public EveryTechnique {};

TEST_P(RandomSurfaces, gets_no_worse_with_more_steps) {
    for (const Knob* knob : technique().converges) {
        for (const Question& question : questions()) {
            double before = 1e30;
            std::string history;
            for (float value = std::max(knob->min, 1.0f); value <= std::min(knob->max, 512.0f); value *= 2) {
                MarchParams params = defaults();
                knob->set(params, value);
                const double mean = mean_uv_error_texels(technique(), question, params);
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
