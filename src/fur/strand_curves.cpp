#include "fur/strand_curves.h"

#include "core/parallel_for.h"
#include "fur/lock_noise.h"
#include "fur/strand_grid.h"

#include <cassert>
#include <cmath>
#include <numbers>

namespace relievo {

namespace {

// The integral from 0 to `level` of the direction of a strand whose lean from the normal, a vector in the skin, is start + turn t: by Simpson's rule.
Vec3d pushed_axis(Vec3d normal, Vec3d start, Vec3d turn, double level) {
    constexpr int steps = 32;
    Vec3d sum;
    for (int i = 0; i <= steps; ++i) {
        const Vec3d lean = start + turn * (level * i / steps);
        const double angle = length(lean);
        sum += (normal * std::cos(angle) + lean * (angle > 1e-8 ? std::sin(angle) / angle : 1.0)) * (i == 0 || i == steps ? 1.0 : i % 2 ? 4.0 : 2.0);
    }
    return sum * (level / (3 * steps));
}

}  // namespace

StrandCurves strand_curves(const Mesh& mesh, const std::vector<Vec3f>& comb, const Roots& roots, const Coat& coat, double spacing, int pieces, int threads, const SkinValues& skin) {
    assert(mesh.normals.size() == mesh.positions.size() && comb.size() == mesh.positions.size() && pieces >= 1);
    assert(skin.pushes.empty() || skin.pushes.size() == mesh.positions.size());
    assert(skin.lengths.empty() || skin.lengths.size() == mesh.positions.size());
    const LockNoise noise = lock_noise();
    const double frequency = 1 / (static_cast<double>(coat.lock_size) * LockNoise::hills);
    StrandCurves curves;
    curves.pieces = pieces;
    const std::size_t stride = static_cast<std::size_t>(pieces) + 1;
    curves.points.resize(roots.roots.size() * stride);
    curves.radii.resize(curves.points.size());
    curves.strands.resize(roots.roots.size());
    parallel_for(static_cast<int>(roots.roots.size()), 2048, threads, [&](int begin, int end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
            const Root& root = roots.roots[i];
            const Vec3f w = corner_weights(mesh, root);
            const std::uint32_t* v = &mesh.indices[std::size_t{root.face} * 3];
            const auto mean = [&](const std::vector<Vec3f>& of) { return Vec3d(of[v[0]] * w.x + of[v[1]] * w.y + of[v[2]] * w.z); };
            const Vec3d mean_normal = mean(mesh.normals), position(root.position);
            const Vec3d n = length(mean_normal) > 0 ? normalize(mean_normal) : Vec3d(0, 1, 0);
            const Vec3d mean_comb = mean(comb), d = mean_comb - n * dot(mean_comb, n);
            const double combed = std::min(length(d), 1.0);
            const Vec3d along = combed > 1e-4 ? normalize(d) : Vec3d{};
            const Vec3d side = normalize(cross(n, std::abs(n.y) < 0.9 ? Vec3d(0, 1, 0) : Vec3d(1, 0, 0))), other = cross(n, side);

            StrandCurves::Strand& s = curves.strands[i];
            s.normal = Vec3f(n);
            s.chance = strand_chance(root.position);
            const double a = (s.chance & 255u) / 255.0, b = (s.chance >> 8) / 255.0;
            const auto fraction = [](double x) { return x - std::floor(x); };
            const bool guard = b < static_cast<double>(coat.guard_hairs);
            s.tip = guard ? 1.0f : 1 - coat.length_variation * static_cast<float>(a);
            const Vec3d lean = (side * (fraction(7 * a) - 0.5) + other * (fraction(11 * b) - 0.5)) * (2.0 * static_cast<double>(coat.spread));

            const double share = skin.lengths.empty() ? 1.0 : static_cast<double>(skin.lengths[v[0]] * w.x + skin.lengths[v[1]] * w.y + skin.lengths[v[2]] * w.z);
            Vec3d push;
            if (!skin.pushes.empty()) {
                const Vec3d p(skin.pushes[v[0]] * w.x + skin.pushes[v[1]] * w.y + skin.pushes[v[2]] * w.z);
                push = p - n * dot(p, n);
            }
            const double full = coat.length * share, start = coat.tilt * combed, turn = std::max(coat.bend * combed, 1e-3);
            for (int k = 0; k <= pieces; ++k) {
                const double way = static_cast<double>(k) / pieces, level = way * static_cast<double>(s.tip);
                // The place on the skin that the lock has carried the root to: it solves place = root + sway(place), by repetition.
                Vec3d place = position, sway;
                for (int step = 0; step < 4; ++step) {
                    sway = lock_noise_at(noise, place * frequency) * 1.5;
                    sway += n * -dot(sway, n);
                    place = position + sway * (static_cast<double>(coat.lock) * std::pow(level, 1.5) * full);
                }
                const double angle = start + turn * level;
                const Vec3d axis = skin.pushes.empty() ? (n * (std::sin(angle) - std::sin(start)) + along * (std::cos(start) - std::cos(angle))) / turn
                                                       : pushed_axis(n, along * start, along * (coat.bend * combed) + push, level);
                Vec3d p = place + axis * full + lean * (level * full);
                const double round = 2 * std::numbers::pi * (7 * b + static_cast<double>(coat.curl_turns) * level);
                p += (side * std::cos(round) + other * std::sin(round)) * (coat.curl_radius * spacing * std::min(4 * level, 1.0));
                const double way4 = way * way * way * way;
                curves.points[i * stride + static_cast<std::size_t>(k)] = Vec3f(p);
                curves.radii[i * stride + static_cast<std::size_t>(k)] =
                    static_cast<float>(coat.width * spacing * (guard ? 1.6 : 1.0) * (1 - (way + (way4 - way) * static_cast<double>(coat.taper))));
                s.sway = static_cast<float>(sway.x);
            }
        }
    });
    return curves;
}

}  // namespace relievo
