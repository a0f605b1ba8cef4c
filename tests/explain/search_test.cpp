// Searches explained: every fetch has its place on the section, and what is drawn from it is true of the field.
#include "contract/baked_maps.h"
#include "contract/random_fields.h"
#include "core/error.h"
#include "explain/search_figure.h"
#include "figure/clip.h"
#include "figure/font.h"
#include "reference/cast.h"
#include "techniques/catalogue.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace relievo {
namespace {

RayQuestion ray_from(double u, double v, double elevation_deg, double azimuth_deg, float height_scale, float zero_level = 1) {
    const double e = elevation_deg * std::numbers::pi / 180, a = azimuth_deg * std::numbers::pi / 180;
    return {.uv = {u, v}, .view = {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)}, .height_scale = height_scale, .zero_level = zero_level};
}

Section section_for(const MapSet& maps, const RayQuestion& q) {
    const Vec2d uv_per_height = Vec2d{q.view.x, q.view.y} * (static_cast<double>(q.height_scale) / q.view.z);
    const ReferenceHit truth = reference_cast(maps.height, {.uv = q.uv, .uv_per_height = uv_per_height, .zero_level = q.zero_level});
    return section_of(maps, q, truth.uv, truth.height);
}

Search run(const MapSet& maps, const Section& section, const char* id, MarchParams params) { return search_along(section, *find_technique(id), params, maps); }
Search run(const MapSet& maps, const Section& section, const char* id) { return run(maps, section, id, default_params(*find_technique(id))); }

std::vector<RayQuestion> some_rays(float height_scale) {
    std::vector<RayQuestion> rays;
    std::mt19937 random(4);
    const auto unit = [&] { return static_cast<double>(random() >> 8) / 16777216.0; };
    for (const double elevation : {8.0, 25.0, 60.0})
        for (int i = 0; i < 12; ++i) {
            const double u = 3 * unit(), v = 3 * unit();
            rays.push_back(ray_from(u, v, elevation, 360 * unit(), height_scale, static_cast<float>(i % 3) / 2));
        }
    return rays;
}

constexpr float rough_scale = 0.1f;
const MapSet& rough() {
    static const MapSet maps = contract::baked_maps(contract::rough_field(31), rough_scale);
    return maps;
}

// A level field at 0.25 seen at 45 degrees along +u, amplitude 1/8: heights and texels are known in closed form. 64 texels across
// a repeat, so a height is 8 texels of way.
TEST(Explain, LevelFieldInClosedForm) {
    const MapSet maps = contract::baked_maps(HeightField(64, 64, 0.25f), 0.125f);
    const Section section = section_for(maps, ray_from(0.5, 0.5, 45, 0, 0.125f));
    EXPECT_NEAR(section.drop_per_texel, 1.0 / 8, 1e-6);
    EXPECT_NEAR(section.truth.x, 6, 1e-4);
    EXPECT_NEAR(section.truth.z, 0.25, 1e-6);
    EXPECT_NEAR(section.polygon_x, 0, 1e-9);
    EXPECT_NEAR(section.texels_per_uv, 64, 1e-4);

    MarchParams params = default_params(*find_technique("linear_search"));
    params.max_steps = 10;
    const Search linear = run(maps, section, "linear_search", params);
    ASSERT_EQ(linear.steps.size(), 9u);  // 1.0, 0.9, ... 0.2
    for (std::size_t i = 0; i < linear.steps.size(); ++i) {
        EXPECT_EQ(linear.steps[i].kind, StepKind::sample);
        EXPECT_EQ(linear.steps[i].number, static_cast<int>(i) + 1);
        EXPECT_NEAR(linear.steps[i].x, 0.8 * static_cast<double>(i), 1e-3);
        EXPECT_NEAR(linear.steps[i].z, 1 - 0.1 * static_cast<double>(i), 1e-4);
        EXPECT_NEAR(linear.steps[i].value, 0.25, 1e-6);
    }
    EXPECT_NEAR(linear.texels_off, 0.4, 1e-3);  // stops at 0.2: behind
    EXPECT_NE(search_sentence(linear).find("9 fetches (9 samples); stops at height 0.200, 0.40 texels behind the first hit"), std::string::npos) << search_sentence(linear);

    const Search shift = run(maps, section, "parallax_mapping");
    ASSERT_EQ(shift.steps.size(), 1u);
    ASSERT_EQ(shift.chord.size(), 1u) << "the level line it takes for the surface";
    EXPECT_NEAR(shift.chord[0].z0, 0.25, 1e-6);
    EXPECT_NEAR(shift.chord[0].z1, 0.25, 1e-6);
    EXPECT_NEAR(shift.texels_off, 0, 1e-3);

    const Search flat = run(maps, section, "texture_mapping");
    EXPECT_EQ(flat.fetches, 0);
    EXPECT_NEAR(flat.texels_off, -6, 1e-3);
    EXPECT_NE(search_sentence(flat).find("no fetch; stops at height 1.000, 6.00 texels before the first hit"), std::string::npos) << search_sentence(flat);
}

// The slope that a normal shows is that of the field: a ramp of 1/2 height over 32 texels along u.
TEST(Explain, NormalsShowTheSlopeOfTheSection) {
    HeightField ramp(64, 8);
    for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 64; ++i) ramp.texels(i, j) = 0.2f + 0.5f * static_cast<float>(i < 32 ? i : 63 - i) / 32;
    const MapSet maps = contract::baked_maps(ramp, 0.1f);
    const Section up = section_for(maps, ray_from(20.0 / 64, 0.5, 60, 180, 0.1f));  // the eye at -u: the ray runs along +u, uphill
    for (const Step& step : run(maps, up, "parallax_slope").steps)
        if (step.kind == StepKind::normal) {
            EXPECT_NEAR(step.size, 0.5 / 32, 1e-3);
        }
}

TEST(Explain, TellsWhatRefines) {
    const Technique& relief = *find_technique("relief_mapping");
    for (const RayQuestion& q : some_rays(rough_scale)) {
        const Section section = section_for(rough(), q);
        const Search halving = run(rough(), section, "binary_search");
        for (const Step& step : halving.steps) EXPECT_EQ(step.kind, StepKind::bisection);
        const MarchParams params = default_params(relief);
        const Search search = run(rough(), section, "relief_mapping");
        int refining = 0;
        for (const Step& step : search.steps) refining += step.kind != StepKind::sample;
        // A ray that is below the field at its first sample has no point above it, so its halvings look like a march.
        if (search.steps.front().z > search.steps.front().value) {
            EXPECT_EQ(refining, params.refine_steps);
        }
        // A secant's answer is where its chord meets the ray.
        const Search pom = run(rough(), section, "parallax_occlusion_mapping");
        for (const Chord& c : pom.chord) {
            const double z = section.ray_height(pom.found.x);
            EXPECT_NEAR(c.z0 + (c.z1 - c.z0) * (pom.found.x - c.x0) / (c.x1 - c.x0), z, 1e-3);
        }
    }
}

// Each cone is the one that the next step used: the ray leaves it where the next point stands.
TEST(Explain, ConesEndWhereTheNextStepBegins) {
    int checked = 0;
    for (const RayQuestion& q : some_rays(rough_scale)) {
        const Section section = section_for(rough(), q);
        const Search search = run(rough(), section, "cone_step_mapping");
        for (std::size_t i = 0; i + 1 < search.steps.size(); ++i) {
            const Step &a = search.steps[i], &b = search.steps[i + 1];
            ASSERT_EQ(a.kind, StepKind::cone);
            if (a.size < 1e-3) continue;
            EXPECT_NEAR(b.x - a.x, a.size * (b.z - a.value), 2e-3 + 1e-3 * (b.x - a.x));
            ++checked;
        }
    }
    EXPECT_GT(checked, 100);
}

// What a pyramid search passes over is empty up to there, and together with the cell it solves it reaches from the entry to the hit.
TEST(Explain, BoxesHoldTheFieldAndLeaveNoGap) {
    int boxes = 0;
    for (const RayQuestion& q : some_rays(rough_scale)) {
        const Section section = section_for(rough(), q);
        const Search search = run(rough(), section, "max_mip_tracing");
        EXPECT_NEAR(search.texels_off, 0, 1e-2);
        double vouched = 0;
        for (const Step& step : search.steps) {
            ASSERT_TRUE(step.kind == StepKind::node || step.kind == StepKind::cell);
            ASSERT_LE(step.x, step.x_end);
            // A box whose corner the ray only touches may be another one by rounding.
            if (step.x_end - step.x > 1e-3) {
                for (int s = 0; s <= 20; ++s) {
                    const double x = step.x + 1e-4 + (step.x_end - step.x - 2e-4) * s / 20;
                    ASSERT_LE(rough().height.sample(section.uv_at(x)), step.value + 1e-4) << "box of level " << step.size;
                }
                ++boxes;
            }
            EXPECT_LE(step.x, vouched + 2e-2) << "a gap before step " << step.number;
            // An opened node vouches for the way until the ray is as low as its top.
            const double down = (1 - step.value) / section.drop_per_texel;
            vouched = std::max(vouched, step.skipped || step.solved ? step.x_end : std::min(step.x_end, down));
        }
        EXPECT_GE(vouched, section.truth.x - 1e-2);
    }
    EXPECT_GT(boxes, 300);
}

TEST(Explain, RaysStraightDownAreRefused) {
    EXPECT_THROW(section_for(rough(), ray_from(0.3, 0.3, 90, 0, rough_scale)), Error);
    EXPECT_NO_THROW(section_for(rough(), ray_from(0.3, 0.3, 89, 0, rough_scale)));
}

Rect box_of(const Label& label) {
    const double width = text_width(label.text, label.size, label.bold);
    const double left = label.at.x - (label.anchor == Anchor::middle ? width / 2 : label.anchor == Anchor::end ? width : 0);
    return {left, label.at.y - cap_height * label.size, left + width, label.at.y};
}

// Of every technique on rays of every kind: all marks inside the drawing, all numbers finite, no label on another.
TEST(Explain, FiguresKeepOrder) {
    std::vector<RayQuestion> rays = some_rays(rough_scale);
    for (std::size_t i = 0; i < rays.size(); i += 4) {
        const Section section = section_for(rough(), rays[i]);
        std::vector<Search> searches;
        for (const Technique& t : techniques()) {
            searches.push_back(search_along(section, t, default_params(t), rough()));
            ASSERT_EQ(static_cast<int>(searches.back().steps.size()), searches.back().fetches);
            for (const Step& step : searches.back().steps) {
                ASSERT_TRUE(std::isfinite(step.x) && std::isfinite(step.z) && std::isfinite(step.value) && std::isfinite(step.size)) << t.id;
                EXPECT_NE(step.kind, StepKind::other) << t.id << ": this map is drawn as a bare point; give it a StepKind";
            }
        }
        const Drawing figure = search_figure(section, searches, rough().height, {.heading = "rough", .where = "a ray"});
        std::vector<Rect> labels;
        for (const Mark& mark : figure.marks) {
            const auto inside = [&](Vec2d p) {
                ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y));
                EXPECT_TRUE(p.x > -1 && p.x < figure.width + 1 && p.y > -1 && p.y < figure.height + 1) << p.x << " " << p.y;
            };
            if (const auto* path = std::get_if<Path>(&mark)) {
                for (const Vec2d p : path->points) inside(p);
            } else if (const auto* dot = std::get_if<Dot>(&mark)) {
                inside(dot->centre);
            } else {
                const auto& label = std::get<Label>(mark);
                const Rect box = box_of(label);
                inside({box.left, box.top});
                inside({box.right, box.bottom});
                for (const Rect& other : labels) EXPECT_FALSE(box.overlaps(other)) << label.text << " lies on another label";
                labels.push_back(box);
            }
        }
        EXPECT_GT(labels.size(), 4 * techniques().size());
    }
}

}  // namespace
}  // namespace relievo
