// Films of fur: what stands still does not change, what moves is the same for any threads, and the traced strands move along.
#include "pipeline/fur_film.h"

#include "core/error.h"
#include "mesh/made_up_scan.h"
#include "pipeline/fur_path.h"
#include "pipeline/fur_score.h"
#include "render/gpu_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace relievo {
namespace {

class FurFilms : public testing::Test {
protected:
    static void SetUpTestSuite() {
        if (std::ranges::none_of(gpu_devices(), [](const GpuDevice& d) { return d.lacks.empty(); })) return;
        for (const FurKind kind : {FurKind::strands, FurKind::shells}) painters.push_back(std::make_unique<FurPainter>(kind, ""));
    }
    static void TearDownTestSuite() { painters.clear(); }
    void SetUp() override {
        if (painters.empty()) GTEST_SKIP() << "no Vulkan device: install a driver (mesa-vulkan-drivers is a software one)";
    }

    static FurView small_view(int layers, int height = 48) {
        FurView view{.camera = view_of_sphere({0, 0, 0}, 1.1, height * 4 / 3, height)};
        view.layers = layers;
        view.passes = 2;
        return view;
    }
    static std::optional<FurSteadiness> filmed(FurPainter& painter, const FurFilm& film, const FurForces& forces = {}, bool layers_adapt = false, int threads = 0, int height = 48) {
        GrownFur fur = grown_fur(made_up_scan({.faces = 2000, .relief = 0.1, .noise = 0}), coat, {}, threads);
        const FurView view = small_view(layers_adapt ? layers_for(painter.kind(), small_view(1, height).camera, coat) : 6, height);
        painter.load(fur, coat, forces, nearest_view(view, film, painter.kind(), coat, layers_adapt), threads);
        return film_fur({.painter = painter, .fur = fur, .coat = coat, .forces = forces, .view = view, .layers_adapt = layers_adapt}, film, threads);
    }

    static inline std::vector<std::unique_ptr<FurPainter>> painters;
    static constexpr Coat coat{.strands = 3000, .length = 0.2f, .softness = 1};
};

TEST_F(FurFilms, StillFurDoesNotChange) {
    for (const auto& painter : painters)
        // Not moved at all; and swinging without a force.
        for (const bool swings : {false, true}) {
            const FurSteadiness s = *filmed(*painter, {.frames = 3, .swings = swings, .passes = {1, 3}, .samples = 2});
            ASSERT_EQ(s.rows.size(), 2u);
            ASSERT_EQ(s.steps.size(), 2u);
            for (const FurSteadiness::Row& r : s.rows) {
                EXPECT_EQ(r.mean.picture, 0);
                EXPECT_EQ(r.mean.reference, 0);
                EXPECT_EQ(r.mean.error, 0);
                EXPECT_EQ(r.worst_over_median, 1);
                EXPECT_EQ(r.pop, 0);
                EXPECT_TRUE(r.inside());
            }
        }
}

TEST_F(FurFilms, AreTheSameForAnyThreads) {
    const FurForces forces{.gravity = {0, -1, 0}, .wind = {2, 0, 1}, .gusts = 0.5};
    for (const auto& painter : painters) {
        std::vector<Image8> first;
        std::optional<FurSteadiness> one;
        for (const int threads : {1, 3}) {
            std::vector<Image8> frames;
            FurFilm film{.frames = 3, .dolly = {0.6, 1.5}, .swings = true, .turns_per_second = 1, .passes = {1, 2}, .samples = 2};
            film.shown = [&](int frame, const Image8& picture) {
                EXPECT_EQ(frame, static_cast<int>(frames.size()));
                frames.push_back(picture);
            };
            const std::optional<FurSteadiness> s = filmed(*painter, film, forces, true, threads);
            ASSERT_TRUE(s);
            if (first.empty()) {
                first = frames;
                one = s;
                EXPECT_NE(frames[0].texels, frames[1].texels);
                continue;
            }
            for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_EQ(frames[i].texels, first[i].texels) << i;
            for (std::size_t i = 0; i < s->steps.size(); ++i) {
                EXPECT_EQ(s->steps[i].change.picture, one->steps[i].change.picture);
                EXPECT_EQ(s->steps[i].change.reference, one->steps[i].change.reference);
                EXPECT_EQ(s->steps[i].change.error, one->steps[i].change.error);
            }
        }
    }
}

// Under a camera that stays, only the wind changes anything; the traced strands follow it, and a picture is nearer to those than
// the pictures of another moment are.
TEST_F(FurFilms, MoveTheTracedStrandsByTheSamePushes) {
    const FurForces forces{.gravity = {0, -2, 0}, .wind = {6, 0, 0}};
    for (const auto& painter : painters) {
        const FurFilm film{.frames = 4, .swings = true, .passes = {16}, .samples = 16};
        const FurSteadiness s = *filmed(*painter, film, forces);
        for (const FurSteadiness::Step& step : s.steps) {
            EXPECT_GT(step.change.picture, 0);
            EXPECT_GT(step.change.reference, 0);
            // Were one of the two standing still, the difference would change as much as the other.
            EXPECT_LT(step.change.error, 0.9 * std::hypot(step.change.picture, step.change.reference)) << step.change.picture << ' ' << step.change.reference;
        }
    }
}

// Nearer fur has more layers; what a change of their number does is told apart.
TEST_F(FurFilms, TellWhatTheNumberOfLayersDoes) {
    for (const auto& painter : painters) {
        const FurSteadiness s = *filmed(*painter, {.frames = 8, .dolly = {0.4, 4}, .passes = {1, 4}, .samples = 1}, {}, true, 0, 180);
        int changed = 0;
        const FurView view = small_view(1, 180);
        for (std::size_t i = 0; i < s.steps.size(); ++i) {
            const FurSteadiness::Step& step = s.steps[i];
            EXPECT_NEAR(step.distance, 0.4 * std::pow(10.0, (static_cast<double>(i) + 1) / 7), 1e-9);
            FurView seen = view;
            seen.camera.camera.eye = view.camera.camera.eye * step.distance;
            EXPECT_NEAR(step.layers, layers_for(painter->kind(), seen.camera, coat), 1e-6);
            const double before = i > 0 ? s.steps[i - 1].layers : 0;
            if (i > 0) {
                EXPECT_LE(step.layers, before);
                EXPECT_EQ(step.change.layers > 0, step.layers != before);
            }
            changed += step.change.layers > 0;
        }
        EXPECT_GT(changed, 0);
    }
}

// At steps of 4 % and at steps of a fiftieth of that, past a whole number of layers, their number changes no more than a small part of what each step does. A layer
// that came in at once would: that is drawn, too.
TEST_F(FurFilms, ShellsDoNotPop) {
    FurPainter& painter = *painters[1];
    ASSERT_EQ(painter.kind(), FurKind::shells);
    const FurView view = small_view(1, 180);
    const double near = 0.5, layers = layers_for(painter.kind(), from_afar(view, near).camera, coat);  // falling as the distance grows
    const FurDolly walks{near * layers / 8.9, near * layers / 7.3}, creeps{near * layers / 8.016, near * layers / 7.984};
    for (const FurDolly dolly : {walks, creeps}) {
        const FurSteadiness s = *filmed(painter, {.frames = 6, .dolly = dolly, .passes = {1, 4}, .samples = 1}, {}, true, 0, 180);
        EXPECT_GT(s.steps.front().layers, 8);
        EXPECT_LT(s.steps.back().layers, 8);
        for (const FurSteadiness::Step& step : s.steps) EXPECT_GT(step.change.layers, 0);
        for (const FurSteadiness::Row& r : s.rows) {
            EXPECT_LE(r.pop, most_pop) << r.passes << " passes from " << dolly.first;
            if (dolly.first != creeps.first) continue;
            EXPECT_LE(r.pop, most_pop / 5) << r.passes;
            FurView seen = from_afar(view, dolly.last);
            seen.passes = r.passes;
            const FurFrames fewer = painter.draw(with_layers(seen, 8)), more = painter.draw(with_layers(seen, 9));
            SteadinessMeter meter({r.passes}, 1);
            meter.add({.distance = 1, .layers = 8, .pictures = {fewer}, .reference = fewer, .as_layered_before = {}});
            meter.add({.distance = 1, .layers = 9, .pictures = {more}, .reference = fewer, .as_layered_before = {fewer}});
            EXPECT_GT(meter.result()->rows[0].mean.layers, most_pop * r.mean.picture) << r.passes;
        }
    }
}

}  // namespace
}  // namespace relievo
