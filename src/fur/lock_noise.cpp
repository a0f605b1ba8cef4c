#include "fur/lock_noise.h"

#include <cmath>

namespace relievo {

namespace {

double unit_random(std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t channel) {
    std::uint32_t h = x * 0x9e3779b1u ^ y * 0x85ebca77u ^ z * 0xc2b2ae3du ^ (channel + 1) * 0x27d4eb2fu;
    h = (h ^ (h >> 16)) * 0x85ebca6bu;
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return (h ^ (h >> 16)) * 0x1p-32;
}

// Values at the corners of a grid of `hills` cells a period, joined smoothly.
double hill(const int (&at)[3], int hills, std::uint32_t channel) {
    std::uint32_t cell[3];
    double s[3];
    for (int a = 0; a < 3; ++a) {
        const double p = (at[a] + 0.5) * hills / LockNoise::size, f = p - std::floor(p);
        cell[a] = static_cast<std::uint32_t>(p);
        s[a] = f * f * f * (f * (f * 6 - 15) + 10);
    }
    double sum = 0;
    for (std::uint32_t c = 0; c < 8; ++c) {
        double weight = 1;
        std::uint32_t k[3];
        for (std::uint32_t a = 0; a < 3; ++a) {
            weight *= (c >> a & 1) ? s[a] : 1 - s[a];
            k[a] = (cell[a] + (c >> a & 1)) % static_cast<std::uint32_t>(hills);
        }
        sum += weight * (2 * unit_random(k[0], k[1], k[2], channel) - 1);
    }
    return sum;
}

}  // namespace

LockNoise lock_noise() {
    LockNoise noise;
    constexpr int size = LockNoise::size;
    noise.texels.resize(size * size * size);
    for (int z = 0; z < size; ++z)
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const int at[3] = {x, y, z};
                auto& texel = noise.texels[static_cast<std::size_t>((z * size + y) * size + x)];
                for (std::uint32_t channel = 0; channel < 3; ++channel)
                    texel[channel] = static_cast<std::int8_t>(std::lround((hill(at, LockNoise::hills, channel) + 0.5 * hill(at, 2 * LockNoise::hills, channel + 3)) / 1.5 * 127));
            }
    return noise;
}

Vec3d lock_noise_at(const LockNoise& noise, Vec3d p) {
    constexpr int size = LockNoise::size;
    const double at[3] = {p.x, p.y, p.z};
    int low[3];
    double f[3];
    for (int a = 0; a < 3; ++a) {
        const double t = (at[a] - std::floor(at[a])) * size - 0.5, l = std::floor(t);
        low[a] = static_cast<int>(l);
        f[a] = t - l;
    }
    Vec3d sum;
    for (int c = 0; c < 8; ++c) {
        double weight = 1;
        int k[3];
        for (int a = 0; a < 3; ++a) {
            weight *= (c >> a & 1) ? f[a] : 1 - f[a];
            k[a] = (low[a] + (c >> a & 1) + size) % size;
        }
        const auto& texel = noise.texels[static_cast<std::size_t>((k[2] * size + k[1]) * size + k[0])];
        sum += Vec3d(texel[0], texel[1], texel[2]) * (weight / 127);
    }
    return sum;
}

}  // namespace relievo
