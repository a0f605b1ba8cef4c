#include "mesh/made_up_scan.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

namespace relievo {

namespace {

// Bits without a visible pattern from integers: the finaliser of MurmurHash3 over their mixture.
std::uint32_t mixed(std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t seed) {
    std::uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ z * 0xc2b2ae3du ^ seed * 0x27d4eb2fu;
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return h ^ (h >> 16);
}
double unit_random(std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t seed) { return mixed(x, y, z, seed) * 0x1p-32; }

// Values in [-1,1] at the corners of a unit grid, joined smoothly.
double value_noise(Vec3d p, std::uint32_t seed) {
    const std::array<double, 3> x{p.x, p.y, p.z};
    std::array<std::uint32_t, 3> cell;
    std::array<double, 3> s;
    for (std::size_t a = 0; a < 3; ++a) {
        const double low = std::floor(x[a]);
        cell[a] = static_cast<std::uint32_t>(static_cast<std::int64_t>(low));
        const double f = x[a] - low;
        s[a] = f * f * f * (f * (f * 6 - 15) + 10);
    }
    double sum = 0;
    for (std::uint32_t c = 0; c < 8; ++c) {
        double weight = 1;
        for (std::size_t a = 0; a < 3; ++a) weight *= c >> a & 1 ? s[a] : 1 - s[a];
        sum += weight * (2 * unit_random(cell[0] + (c & 1), cell[1] + (c >> 1 & 1), cell[2] + (c >> 2), seed) - 1);
    }
    return sum;
}

double hills(Vec3d direction, std::uint32_t seed) {
    double sum = 0, height = 0.5, frequency = 1.5;
    for (std::uint32_t octave = 0; octave < 6; ++octave) {
        // Folds in the coarse sizes, grain in the fine ones.
        const double n = value_noise(direction * frequency + Vec3d(17.3), seed * 8 + octave);
        sum += height * (octave < 3 ? 1 - 2 * std::abs(n) : n);
        height *= 0.5;
        frequency *= 2.1;
    }
    return sum;
}

}  // namespace

Mesh made_up_scan(const MadeUpScan& settings) {
    assert(settings.faces >= 8);
    // Rows at distance d around a sphere hold 2 pi sin(t) / d samples, 4 pi / d^2 in all, and there are twice as many faces.
    const double spacing = std::sqrt(8 * std::numbers::pi / settings.faces);
    const auto rows = static_cast<std::uint32_t>(std::max(1.0, std::round(std::numbers::pi / spacing) - 1));
    std::vector<std::uint32_t> first{0};  // sample of each row, after the pole; behind the last row, the other pole
    first.push_back(1);
    for (std::uint32_t r = 0; r < rows; ++r) {
        const double polar = std::numbers::pi * (r + 1) / (rows + 1);
        first.push_back(first.back() + static_cast<std::uint32_t>(std::max(3.0, std::round(2 * std::numbers::pi * std::sin(polar) / spacing))));
    }
    Mesh mesh;
    mesh.name = "made-up scan";
    mesh.positions.resize(first.back() + 1);
    parallel_for(static_cast<int>(rows) + 2, 8, settings.threads, [&](int begin, int end) {
        for (int row = begin; row < end; ++row) {
            const auto r = static_cast<std::uint32_t>(row);
            const bool pole = r == 0 || r == rows + 1;
            const std::uint32_t from = first[r], count = pole ? 1 : first[r + 1] - first[r];
            for (std::uint32_t i = 0; i < count; ++i) {
                // A scanner's rows start where they happen to and its samples are not quite where they should be.
                const double start = unit_random(r, 0, 7, settings.seed), wobble = 0.3 * (unit_random(from + i, r, 11, settings.seed) - 0.5);
                const double polar = std::numbers::pi * r / (rows + 1);
                const double azimuth = 2 * std::numbers::pi * (i + start + wobble) / count;
                const Vec3d direction(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar));
                const double range_noise = settings.noise * spacing * (unit_random(from + i, 3, r, settings.seed) - 0.5);
                mesh.positions[from + i] = Vec3f(direction * (1 + settings.relief * hills(direction, settings.seed) + range_noise));
            }
        }
    });

    const auto gap2 = [&](std::uint32_t a, std::uint32_t b) {
        const Vec3f d = mesh.positions[a] - mesh.positions[b];
        return dot(d, d);
    };
    const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) { mesh.indices.insert(mesh.indices.end(), {a, b, c}); };
    mesh.indices.reserve(std::size_t{first.back()} * 6);
    const std::uint32_t last_pole = first.back();
    for (std::uint32_t i = 0, n = first[2] - 1; i < n; ++i) face(0, 1 + i, 1 + (i + 1) % n);
    for (std::uint32_t r = 1; r < rows; ++r) {
        const std::uint32_t upper = first[r], upper_count = first[r + 1] - upper, lower = first[r + 1], lower_count = first[r + 2] - lower;
        // Start beside the sample of the lower row nearest to the first one of the upper row, then step along the row that is behind,
        // or across the shorter diagonal where both rows have got equally far.
        std::uint32_t start = 0;
        for (std::uint32_t j = 1; j < lower_count; ++j)
            if (gap2(upper, lower + j) < gap2(upper, lower + start)) start = j;
        std::uint32_t u = 0, l = 0;
        const auto upper_at = [&](std::uint32_t k) { return upper + k % upper_count; };
        const auto lower_at = [&](std::uint32_t k) { return lower + (start + k) % lower_count; };
        while (u < upper_count || l < lower_count) {
            const double ahead = static_cast<double>(u) / upper_count - static_cast<double>(l) / lower_count;
            const bool level = std::abs(ahead) < 1.0 / std::max(upper_count, lower_count);
            const bool step_upper = l == lower_count || (u < upper_count && (level ? gap2(upper_at(u + 1), lower_at(l)) < gap2(upper_at(u), lower_at(l + 1)) : ahead < 0));
            if (step_upper) {
                face(upper_at(u), lower_at(l), upper_at(u + 1));
                ++u;
            } else {
                face(upper_at(u), lower_at(l), lower_at(l + 1));
                ++l;
            }
        }
    }
    for (std::uint32_t i = 0, from = first[rows], n = last_pole - from; i < n; ++i) face(last_pole, from + (i + 1) % n, from + i);
    return mesh;
}

}  // namespace relievo
