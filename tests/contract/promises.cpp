// Contract 2: on random fields, from grazing to steep views, no more of a technique's hits are astray than its row allows, judged
// against everything that the rays pass through; and a technique that got worse by a fifth would not pass.
#include "contract/random_fields.h"
#include "contract/trace.h"
#include "measure/astray.h"
#include "measure/steepness.h"
#include "reference/solids.h"

#include <array>
#include <functional>

namespace relievo::contract {
namespace {

constexpr float height_scale = 0.1f;
constexpr int rays_per_view = 2000;

struct Question {
    std::string name;
    const MapSet* maps;
    double elevation_deg;
    double exposure;
    std::vector<SurfaceRay> rays;
    RaySolids truth;
};

// Rolling, rough and built ground, noise and bare walls, each from three views.
const std::vector<Question>& questions() {
    static const std::array<MapSet, 5> fields{baked_maps(smooth_field(11), height_scale), baked_maps(rough_field(12), height_scale),
                                              baked_maps(blocks_field(15), height_scale), baked_maps(noise_field(16), height_scale),
                                              baked_maps(coins_field(17), height_scale)};
    static const std::vector<Question> all = [] {
        const std::array<const char*, 5> names{"smooth", "rough", "blocks", "noise", "coins"};
        std::vector<Question> list;
        for (std::size_t f = 0; f < fields.size(); ++f) {
            for (const double elevation : {15.0, 35.0, 65.0}) {
                Question q{.name = names[f] + std::string(" at ") + std::to_string(static_cast<int>(elevation)),
                           .maps = &fields[f],
                           .elevation_deg = elevation,
                           .exposure = wall_exposure(rms_slope(fields[f].height, static_cast<double>(height_scale)), elevation),
                           .rays = random_rays(rays_per_view, elevation, height_scale, 0.8f, 13),
                           .truth = {}};
                for (const SurfaceRay& ray : q.rays)
                    append_solids(q.truth, fields[f].height, {.uv = Vec2d(ray.uv), .uv_per_height = Vec2d(ray.uv_per_height), .zero_level = ray.zero_level});
                list.push_back(std::move(q));
            }
        }
        return list;
    }();
    return all;
}

using Search = std::function<SurfaceHit(const SurfaceRay&, const MapSet&)>;

// The share of a search's hits that break what the technique promises at its defaults.
double astray_of(const Technique& technique, const Question& question, const Search& search) {
    const Vec2d size{static_cast<double>(question.maps->height.width()), static_cast<double>(question.maps->height.height())};
    const MarchParams params = default_params(technique);
    int astray = 0;
    for (std::size_t i = 0; i < question.rays.size(); ++i) {
        const SurfaceRay& ray = question.rays[i];
        const SurfaceHit hit = search(ray, *question.maps);
        const Vec2d speed = Vec2d(ray.uv_per_height);
        const double z = static_cast<double>(ray.zero_level) + dot(Vec2d(hit.uv) - Vec2d(ray.uv), speed) / dot(speed, speed);
        const AstrayRay asked{.solids = question.truth.of(i),
                              .lowest = question.truth.rays[i].lowest,
                              .highest = question.truth.rays[i].highest,
                              .zero_level = static_cast<double>(ray.zero_level),
                              .texels_per_height = length(speed * size),
                              .rounding = 4e-5};
        astray += !hit.found || is_astray(asked, z, promise_of(technique, params, ray.view.z)) ? 1 : 0;
    }
    return astray / static_cast<double>(question.rays.size());
}

Search searched(const Technique& technique, const MarchParams& params) {
    return [&technique, params](const SurfaceRay& ray, const MapSet& maps) { return trace(technique, maps, ray, params).hit; };
}

class Promises : public EveryTechnique {};

TEST_P(Promises, are_kept) {
    double most = 0;
    std::string shares;
    for (const Question& question : questions()) {
        const double astray = astray_of(technique(), question, searched(technique(), defaults()));
        const double allowed = astray_budget(technique(), question.exposure);
        EXPECT_LE(astray, allowed) << question.name;
        most = std::max(most, astray / allowed);
        shares += question.name + ": " + std::to_string(astray) + " of " + std::to_string(allowed) + "\n";
    }
    RecordProperty("most_of_budget", std::to_string(most));
    // Rounding is allowed to all; what a row asks for beyond that, it has to need.
    if (technique().budget.astray > 0 || technique().budget.per_wall > 0) {
        EXPECT_GE(most, 0.4) << "tighten the row's budget\n" << shares;
    }
}

// A fifth fewer steps, judged by what the full number promises; where there are no steps to take away, hits a fiftieth of the slab
// farther off (an exact search: a thousandth).
TEST_P(Promises, notice_a_search_that_got_worse) {
    const auto broken = [&](const Search& worse) {
        for (const Question& question : questions())
            if (astray_of(technique(), question, worse) > astray_budget(technique(), question.exposure)) return true;
        return false;
    };
    if (!technique().exact && technique().budget.per_wall == 0) {
        for (const Knob* knob : technique().converges) {
            MarchParams params = defaults();
            knob->set(params, std::min(std::floor(knob->get(params) * 0.8f), knob->get(params) - 1));
            EXPECT_TRUE(broken(searched(technique(), params))) << "fewer " << knob->id << " break no promise";
        }
    }
    const auto push = [this](const SurfaceRay& ray, const MapSet& maps) {
        const Promise promise = promise_of(technique(), defaults(), ray.view.z);
        const Vec2d texels = Vec2d(ray.uv_per_height) * Vec2d{static_cast<double>(maps.height.width()), static_cast<double>(maps.height.height())};
        return technique().exact ? 1e-3 : 0.02 + 1.5 * promise.texels / length(texels);
    };
    const auto farther = [&](double way) -> Search {
        return [this, push, way](const SurfaceRay& ray, const MapSet& maps) {
            SurfaceHit hit = trace(technique(), maps, ray, defaults()).hit;
            hit.uv = hit.uv + static_cast<float>(way * push(ray, maps)) * ray.uv_per_height;
            return hit;
        };
    };
    EXPECT_TRUE(broken(farther(1))) << "hits that are too early break no promise";
    EXPECT_TRUE(broken(farther(-1))) << "hits that are too late break no promise";
}

FOR_EVERY_TECHNIQUE(Promises);

}  // namespace
}  // namespace relievo::contract
