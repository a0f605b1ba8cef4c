#include "fur/direction_map.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>

namespace relievo {

namespace {

const std::array<float, 256>& linear_values() {
    static const std::array<float, 256> values = [] {
        std::array<float, 256> v{};
        for (std::size_t i = 0; i < 256; ++i) {
            const double x = static_cast<double>(i) / 255;
            v[i] = static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
        }
        return v;
    }();
    return values;
}

std::uint8_t encoded(double linear) {
    const double v = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    return static_cast<std::uint8_t>(std::lround(255 * std::clamp(v, 0.0, 1.0)));
}

Image8 halved(const Image8& fine, bool colours) {
    Image8 coarse(fine.width / 2, fine.height / 2, 4);
    const std::array<float, 256>& linear = linear_values();
    for (int y = 0; y < coarse.height; ++y)
        for (int x = 0; x < coarse.width; ++x)
            for (int c = 0; c < 4; ++c) {
                const std::uint8_t four[] = {fine(2 * x, 2 * y, c), fine(2 * x + 1, 2 * y, c), fine(2 * x, 2 * y + 1, c), fine(2 * x + 1, 2 * y + 1, c)};
                if (colours && c < 3) {
                    double sum = 0;
                    for (const std::uint8_t v : four) sum += static_cast<double>(linear[v]);
                    coarse(x, y, c) = encoded(sum / 4);
                } else {
                    coarse(x, y, c) = static_cast<std::uint8_t>((four[0] + four[1] + four[2] + four[3] + 2) / 4);
                }
            }
    return coarse;
}

}  // namespace

Vec3d addressed(Addressing addressing, Vec3d position, Vec3d normal) {
    const auto unit = [](Vec3d v) { return length(v) > 0 ? normalize(v) : Vec3d{}; };
    switch (addressing) {
        case Addressing::normal: return unit(normal);
        case Addressing::position: return unit(position);
        case Addressing::normal_plus_position: return unit(normal) + unit(position);
    }
    return {};
}

MapPoint map_point(MapShape shape, Vec3d d) {
    if (shape == MapShape::sphere) {
        const Vec3d n = normalize(d);
        const double m = std::sqrt(std::max(2 + 2 * n.z, 1e-30));
        return {0, n.x / (2 * m) + 0.5, 0.5 - n.y / (2 * m)};
    }
    const double x = std::abs(d.x), y = std::abs(d.y), z = std::abs(d.z);
    const auto at = [](int face, double u, double v, double along) { return MapPoint{face, 0.5 * (u / along + 1), 0.5 * (v / along + 1)}; };
    if (x >= y && x >= z) return d.x > 0 ? at(0, -d.z, -d.y, x) : at(1, d.z, -d.y, x);
    if (y >= z) return d.y > 0 ? at(2, d.x, d.z, y) : at(3, d.x, -d.z, y);
    return d.z > 0 ? at(4, d.x, -d.y, z) : at(5, -d.x, -d.y, z);
}

Vec3d map_direction(MapShape shape, const MapPoint& p) {
    const double u = 2 * p.u - 1, v = 2 * p.v - 1;
    if (shape == MapShape::sphere) {
        // u = x / m with m^2 = 2 (1 + z), so that u^2 + v^2 = (1 - z) / 2.
        const double r2 = u * u + v * v;
        if (r2 > 1) return {};
        const double m = 2 * std::sqrt(1 - r2);
        return {u * m, -v * m, 1 - 2 * r2};
    }
    const Vec3d ways[] = {{1, -v, -u}, {-1, -v, u}, {u, 1, v}, {u, -1, -v}, {u, -v, 1}, {-u, -v, -1}};
    return normalize(ways[p.face]);
}

DirectionMap direction_map(MapShape shape, std::vector<Image8> faces, bool colours) {
    DirectionMap map{.shape = shape, .colours = colours, .faces = {}};
    assert(!faces.empty());
    for (Image8& face : faces) {
        assert(face.width == face.height && face.channels == 4 && std::has_single_bit(static_cast<unsigned>(face.width)));
        if (shape == MapShape::sphere)
            for (int y = 0; y < face.height; ++y)
                for (int x = 0; x < face.width; ++x)
                    if (length(map_direction(shape, {0, (x + 0.5) / face.width, (y + 0.5) / face.height})) < 0.5) face(x, y, 3) = 0;
        std::vector<Image8> levels{std::move(face)};
        while (levels.back().width > 1) levels.push_back(halved(levels.back(), colours));
        map.faces.push_back(std::move(levels));
    }
    return map;
}

Image8 square_picture(const Image8& picture, int size) {
    assert(size > 0 && picture.channels >= 1 && picture.channels <= 4 && !picture.empty());
    const std::array<float, 256>& linear = linear_values();
    Image8 square(size, size, 4, 255);
    // The share of source texel i that lies between a and b, along one axis.
    const auto part = [](int i, double a, double b) { return std::max(0.0, std::min(b, i + 1.0) - std::max(a, static_cast<double>(i))); };
    const bool grey = picture.channels < 3;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double x0 = static_cast<double>(x) * picture.width / size, x1 = (x + 1.0) * picture.width / size;
            const double y0 = static_cast<double>(y) * picture.height / size, y1 = (y + 1.0) * picture.height / size;
            double sum[3] = {}, weight = 0;
            for (int v = static_cast<int>(y0); v < std::min<double>(std::ceil(y1), picture.height); ++v)
                for (int u = static_cast<int>(x0); u < std::min<double>(std::ceil(x1), picture.width); ++u) {
                    const double w = part(u, x0, x1) * part(v, y0, y1);
                    weight += w;
                    for (int c = 0; c < 3; ++c) sum[c] += w * static_cast<double>(linear[picture(u, v, grey ? 0 : c)]);
                }
            for (int c = 0; c < 3; ++c) square(x, y, c) = encoded(sum[c] / weight);
        }
    return square;
}

}  // namespace relievo
