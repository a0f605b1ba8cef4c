// Fur that gives way: where the answer is known in closed form, that energy is never made, and that strands bend as they are said to.
#include "fur/fur_motion.h"

#include "fur/comb.h"
#include "mesh/made_up_scan.h"
#include "mesh/normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relievo {
namespace {

// One face that looks up; strands stand upright on it.
struct Meadow {
    Mesh mesh;
    std::vector<Vec3f> comb = std::vector<Vec3f>(3);
    Coat coat{.length = 0.2f, .tilt = 0.3f, .bend = 0.4f, .spread = 0, .length_variation = 0, .lock = 0, .guard_hairs = 0, .softness = 0.5f, .beat = 2, .damping = 0.2f};
    Meadow() {
        mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
        mesh.normals.assign(3, {0, 1, 0});
        mesh.indices = {0, 1, 2};
    }
    FurSkin skin() const { return {mesh, comb, {}, coat}; }
};

// x'' = -w^2 x - 2 z w x', let go at x0.
double swing(double x0, double w, double z, double t) {
    const double d = w * std::sqrt(1 - z * z);
    return x0 * std::exp(-z * w * t) * (std::cos(d * t) + z * w / d * std::sin(d * t));
}

double error_of_swing(const Meadow& meadow, double h) {
    FurMotion motion = at_rest(meadow.skin());
    for (Vec3d& p : motion.push) p = {0.5, 0, 0};
    double worst = 0;
    const double w = 2 * std::numbers::pi * 2;
    for (int i = 1; i * h <= 1.0 + 1e-9; ++i) {
        motion = after(motion, meadow.skin(), {}, h);
        worst = std::max(worst, std::abs(motion.push[0].x - swing(0.5, w, 0.2, i * h)));
    }
    return worst;
}

TEST(FurMotion, SwingsAsADampedOscillator) {
    const Meadow meadow;
    const double coarse = error_of_swing(meadow, 1.0 / 120), fine = error_of_swing(meadow, 1.0 / 240);
    // Implicit midpoint is late by (w h)^2 / 12 of the way it has gone: 0.00023 of the 12.6 radians of a second, of a swing of 0.5 that is damped.
    EXPECT_LT(fine, 5e-4);
    EXPECT_NEAR(coarse / fine, 4, 0.3);  // second order
}

TEST(FurMotion, ComesToRestWhereForcesBalance) {
    Meadow meadow;
    for (const double pull : {0.2, 1.0, 2.0}) {
        // Across an upright strand: angle = softness pull cos(angle).
        double angle = 0.5;
        for (int i = 0; i < 200; ++i) angle += 0.3 * (0.5 * pull * std::cos(angle) - angle);
        const FurForces wind{.wind = {pull, 0, 0}};
        const FurMotion still = settled(meadow.skin(), wind);
        EXPECT_NEAR(still.push[0].x, angle, 1e-7);
        EXPECT_NEAR(still.push[0].z, 0, 1e-12);
        // And the swing ends there.
        FurMotion motion = at_rest(meadow.skin());
        for (int i = 0; i < 1200; ++i) motion = after(motion, meadow.skin(), wind, 1.0 / 120);
        EXPECT_NEAR(motion.push[0].x, angle, 1e-6);
        EXPECT_LT(length(motion.speed[0]), 1e-5);
    }
    // What hangs straight down along the strands does not bend them; what lifts strands that lean sets them up.
    EXPECT_EQ(length(settled(meadow.skin(), {.gravity = {0, -1, 0}}).push[0]), 0);
    meadow.comb.assign(3, {1, 0, 0});
    EXPECT_GT(settled(meadow.skin(), {.gravity = {0, -1, 0}}).push[0].x, 0.1);
    EXPECT_LT(settled(meadow.skin(), {.gravity = {0, 1, 0}}).push[0].x, -0.1);
}

TEST(FurMotion, NeverMakesEnergy) {
    Mesh mesh = made_up_scan({.faces = 400});
    mesh.normals = continuous_normals(mesh, NormalMode::angle);
    std::vector<float> lengths;
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) lengths.push_back(static_cast<float>(v % 11) / 10);
    for (const CoatPreset& preset : coat_presets())
        for (const double h : {1.0 / 250, 1.0 / 25}) {
            Coat coat = preset.coat;
            coat.damping *= 0.1f;
            const std::vector<Vec3f> comb = combed(mesh, mean_lean(coat));
            const FurSkin skin{mesh, comb, lengths, coat};
            const FurForces forces{.gravity = {0, -1, 0}, .wind = {0.7, 0.1, -0.4}};
            FurMotion motion = at_rest(skin);
            for (std::size_t v = 0; v < motion.push.size(); ++v) motion.speed[v] = cross(Vec3d(mesh.normals[v]), Vec3d(0.3, 0.5, 0.2)) * 4.0;
            std::vector<double> energy = energies(motion, skin, forces);
            for (int step = 0; step < 100; ++step) {
                motion = after(motion, skin, forces, h);
                const std::vector<double> next = energies(motion, skin, forces);
                for (std::size_t v = 0; v < next.size(); ++v)
                    ASSERT_LE(next[v], energy[v] + 1e-6 * std::max(1.0, std::abs(energy[v]))) << preset.id << " step " << step << " of " << h << ", vertex " << v;
                energy = next;
            }
        }
}

TEST(FurMotion, StaysOnTheSkinAndAbove) {
    Mesh mesh = made_up_scan({.faces = 400});
    mesh.normals = continuous_normals(mesh, NormalMode::angle);
    const Coat coat{.softness = 3, .beat = 2, .damping = 0.1f};
    const std::vector<Vec3f> comb = combed(mesh, mean_lean(coat));
    const FurSkin skin{mesh, comb, {}, coat};
    FurMotion motion = at_rest(skin);
    FurForces storm{.gravity = {0, -3, 0}, .wind = {40, 0, 0}, .gusts = 1, .spin = {0, 20, 0}, .spin_change = {0, 50, 0}};
    for (int step = 0; step < 60; ++step) {
        storm.time = step / 240.0;
        motion = after(motion, skin, storm, 1.0 / 240);
        for (std::size_t v = 0; v < motion.push.size(); ++v) {
            const Vec3d n(mesh.normals[v]);
            ASSERT_LT(std::abs(dot(motion.push[v], n)), 1e-5);
            ASSERT_LE(length(Vec3d(comb[v]) * static_cast<double>(coat.tilt + coat.bend) + motion.push[v]), flattest + 1e-6);
        }
    }
    // A function of its arguments: the same again, for any number of threads.
    const FurMotion once = after(motion, skin, storm, 1.0 / 240, 1), thrice = after(motion, skin, storm, 1.0 / 240, 3);
    EXPECT_EQ(once.push, thrice.push);
    EXPECT_EQ(once.speed, thrice.speed);
}

TEST(FurMotion, SpinPullsOutward) {
    Meadow meadow;
    // At x = 1, spinning around y: outward is +x; at the axis there is nothing.
    const FurMotion still = settled(meadow.skin(), {.spin = {0, 6, 0}});
    EXPECT_GT(still.push[2].x, 0.1);
    EXPECT_EQ(length(still.push[0]), 0);
    // As it begins to turn toward +x at z = 1, fur there stays behind.
    EXPECT_LT(settled(meadow.skin(), {.spin_change = {0, 30, 0}}).push[1].x, -0.1);
}

TEST(FurMotion, BendGrowsWithTheSquareOfTheHeight) {
    Meadow meadow;
    const Roots roots = grow_roots(meadow.mesh, {.count = 50});
    const std::vector<Vec3f> pushes(3, {0.02f, 0, 0});
    const StrandCurves c = strand_curves(meadow.mesh, meadow.comb, roots, meadow.coat, 0.1, 8, 0, {.pushes = pushes});
    for (std::size_t s = 0; s < roots.roots.size(); ++s)
        for (std::size_t k = 1; k <= 8; ++k) {
            const double t = static_cast<double>(k) / 8, off = static_cast<double>(c.points[s * 9 + k].x - c.points[s * 9].x);
            ASSERT_NEAR(off, 0.2 * 0.02 * t * t / 2, 1e-6);
        }
    // Without a push both ways of writing a strand are one.
    meadow.comb.assign(3, {0.3f, 0, 0.6f});
    const StrandCurves closed = strand_curves(meadow.mesh, meadow.comb, roots, meadow.coat, 0.1), summed = strand_curves(meadow.mesh, meadow.comb, roots, meadow.coat, 0.1, 8, 0, {.pushes = std::vector<Vec3f>(3)});
    for (std::size_t i = 0; i < closed.points.size(); ++i) ASSERT_LT(length(closed.points[i] - summed.points[i]), 1e-6);
}

}  // namespace
}  // namespace relievo
