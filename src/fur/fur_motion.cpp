#include "fur/fur_motion.h"

#include "core/parallel_for.h"
#include "fur/lock_noise.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace relievo {

namespace {

// One strand's numbers.
struct Spring {
    Vec3d normal, grown;  // unit; the lean it grew with
    double rate = 1, softness = 0, damping = 0;
};

Spring spring_at(const FurSkin& skin, std::size_t v) {
    Spring s;
    s.normal = Vec3d(skin.mesh.normals[v]);
    const Vec3d comb(skin.comb[v]), flat = comb - s.normal * dot(comb, s.normal);
    const double l = length(flat);
    s.grown = flat * (static_cast<double>(skin.coat.tilt + skin.coat.bend) / std::max(l, 1.0));
    // Below a quarter of its length a strand is as good as stiff: its swing would ask for ever shorter steps and could not be seen.
    const double share = skin.lengths.empty() ? 1.0 : std::clamp(static_cast<double>(skin.lengths[v]), 0.25, 1.0);
    s.softness = static_cast<double>(skin.coat.softness) * share * share * share;
    s.rate = 2 * std::numbers::pi * static_cast<double>(skin.coat.beat) / (share * share);
    s.damping = static_cast<double>(skin.coat.damping);
    return s;
}

// f.s(a), and its gradient in the skin.
struct Pull {
    double along;    // the normal
    Vec3d across;    // in the skin
    Pull(const Spring& s, Vec3d f) : along(dot(f, s.normal)), across(f - s.normal * along) {}

    double work(Vec3d a) const {
        const double r = length(a);
        return std::cos(r) * along + sinc(r) * dot(a, across);
    }
    Vec3d gradient(Vec3d a) const {
        const double r = length(a), c = sinc(r);
        // (r cos r - sin r) / r^3
        const double turn = r > 1e-2 ? (std::cos(r) - c) / (r * r) : -1.0 / 3 + r * r / 30;
        return across * c + a * (turn * dot(a, across) - c * along);
    }
    static double sinc(double r) { return r > 1e-4 ? std::sin(r) / r : 1 - r * r / 6; }
};

// Earth's gravity in fur space: the coats are those of animals whose smallest sphere is 25 cm in radius.
constexpr double radii_per_gravity = 9.81 / 0.25;

struct Field {
    const FurForces& forces;
    LockNoise noise;
    double wind = 0;
    explicit Field(const FurForces& f) : forces(f), wind(length(f.wind)) {
        if (f.gusts > 0 && wind > 0) noise = lock_noise();
    }
    Vec3d at(Vec3d p) const {
        Vec3d f = forces.gravity + forces.wind;
        if (!noise.texels.empty()) {
            // Hills half a radius wide, carried along at two radii a second.
            const Vec3d seen = (p - forces.wind * (2 * forces.time / wind)) * (1 / (0.5 * LockNoise::hills));
            f += forces.wind * std::clamp(1.6 * forces.gusts * lock_noise_at(noise, seen).x, -1.0, 1.0);
        }
        const Vec3d outward = cross(forces.spin, cross(forces.spin, p)) + cross(forces.spin_change, p);
        return f + outward * (-1 / radii_per_gravity);
    }
};

// A lean beyond the flattest is brought back to it.
bool held_up(const Spring& s, Vec3d& push) {
    const Vec3d a = s.grown + push;
    const double r = length(a);
    if (r <= std::max(flattest, length(s.grown))) return false;
    push = a * (std::max(flattest, length(s.grown)) / r) - s.grown;
    return true;
}

}  // namespace

FurMotion at_rest(const FurSkin& skin) {
    FurMotion motion;
    motion.push.resize(skin.mesh.positions.size());
    motion.speed.resize(skin.mesh.positions.size());
    return motion;
}

FurMotion after(const FurMotion& motion, const FurSkin& skin, const FurForces& forces, double seconds, int threads) {
    const std::size_t count = skin.mesh.positions.size();
    assert(motion.push.size() == count && motion.speed.size() == count && skin.comb.size() == count && skin.mesh.normals.size() == count && seconds > 0);
    assert(skin.lengths.empty() || skin.lengths.size() == count);
    const Field field(forces);
    FurMotion next;
    next.push.resize(count);
    next.speed.resize(count);
    parallel_for(static_cast<int>(count), 2048, threads, [&](int begin, int end) {
        for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
            const Spring s = spring_at(skin, v);
            const Pull pull(s, field.at(Vec3d(skin.mesh.positions[v])));
            const Vec3d q0 = motion.push[v], v0 = motion.speed[v];
            const double h = seconds, w2 = s.rate * s.rate, strength = w2 * s.softness;
            const double before = pull.work(s.grown + q0);
            // The mean speed over the step, by repetition: each brings it nearer by h^2 w^2 b |f| / 2 or better, a few hundredths in steps of 1/240 s.
            Vec3d mean = v0;
            for (int step = 0; step < 40; ++step) {
                const Vec3d way = mean * h, middle = s.grown + q0 + way * 0.5;
                Vec3d gradient = pull.gradient(middle);
                if (const double square = dot(way, way); square > 1e-20)
                    gradient += way * ((pull.work(s.grown + q0 + way) - before - dot(gradient, way)) / square);
                const Vec3d better = (v0 + (gradient * strength - q0 * w2) * (h / 2)) / (1 + h * s.damping * s.rate + h * h * w2 / 4), change = better - mean;
                mean = better;
                if (dot(change, change) < 1e-20 * (1 + dot(mean, mean))) break;
            }
            Vec3d q1 = q0 + mean * h, v1 = mean * 2.0 - v0;
            if (held_up(s, q1)) {
                const Vec3d out = normalize(s.grown + q1);
                v1 += out * -std::max(dot(v1, out), 0.0);
                // Being brought back may have lifted it against the forces: the speed pays for that.
                const auto potential = [&](Vec3d q) { return w2 * dot(q, q) / 2 - strength * pull.work(s.grown + q); };
                const double left = dot(v0, v0) / 2 + potential(q0) - potential(q1), speed2 = dot(v1, v1);
                if (left < 0) {
                    q1 = q0;
                    v1 = {};
                } else if (speed2 / 2 > left) {
                    v1 *= std::sqrt(2 * left / speed2);
                }
            }
            next.push[v] = q1;
            next.speed[v] = v1;
        }
    });
    return next;
}

FurMotion settled(const FurSkin& skin, const FurForces& forces, int threads) {
    FurMotion motion = at_rest(skin);
    const Field field(forces);
    parallel_for(static_cast<int>(motion.push.size()), 2048, threads, [&](int begin, int end) {
        for (auto v = static_cast<std::size_t>(begin); v < static_cast<std::size_t>(end); ++v) {
            const Spring s = spring_at(skin, v);
            const Vec3d f = field.at(Vec3d(skin.mesh.positions[v]));
            const Pull pull(s, f);
            // Down the potential: its slope changes by no more than 1 + b |f| a radian.
            const double step = 1 / (1 + s.softness * length(f));
            Vec3d& q = motion.push[v];
            for (int i = 0; i < 300; ++i) {
                const Vec3d way = (pull.gradient(s.grown + q) * s.softness - q) * step;
                q += way;
                held_up(s, q);
                if (dot(way, way) < 1e-16) break;
            }
        }
    });
    return motion;
}

std::vector<double> energies(const FurMotion& motion, const FurSkin& skin, const FurForces& forces) {
    const Field field(forces);
    std::vector<double> all(motion.push.size());
    for (std::size_t v = 0; v < all.size(); ++v) {
        const Spring s = spring_at(skin, v);
        const Vec3d q = motion.push[v];
        all[v] = dot(motion.speed[v], motion.speed[v]) / 2 +
                 s.rate * s.rate * (dot(q, q) / 2 - s.softness * Pull(s, field.at(Vec3d(skin.mesh.positions[v]))).work(s.grown + q));
    }
    return all;
}

std::vector<Vec3f> pushes_of(const FurMotion& motion) {
    std::vector<Vec3f> pushes;
    pushes.reserve(motion.push.size());
    for (const Vec3d& p : motion.push) pushes.emplace_back(p);
    return pushes;
}

}  // namespace relievo
