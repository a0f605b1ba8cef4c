#include "measure/error_picture.h"

#include "core/parallel_for.h"
#include "measure/along_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <string_view>

namespace relievo {

namespace {

struct Anchor {
    double value;
    Rgb8 colour;
    std::string_view label;  // empty: no tick
};

// The three scales climb in equal steps of OKLab lightness, so that an equal ratio looks like an equal step; late and early share
// their lightnesses (0.40 to 0.83: clear of the black of right hits and of the white of lost ones). Hues:
// 30 to 90 degrees, 275 to 205, and 310 to 105; chroma as far as sRGB reaches.
constexpr Anchor late_scale[] = {
    {0.5, {138, 7, 0}, "½"}, {1, {153, 48, 2}, ""}, {2, {169, 73, 1}, "2"}, {4, {185, 97, 5}, ""},
    {8, {201, 120, 7}, "8"}, {16, {216, 143, 4}, ""}, {32, {230, 167, 4}, ""}, {64, {242, 193, 13}, "64"},
};
constexpr Anchor early_scale[] = {
    {0.5, {50, 46, 171}, "½"}, {1, {34, 74, 192}, ""}, {2, {0, 103, 201}, "2"}, {4, {4, 129, 203}, ""},
    {8, {6, 153, 212}, "8"}, {16, {0, 177, 223}, ""}, {32, {17, 201, 233}, ""}, {64, {19, 225, 242}, "64"},
};
constexpr Anchor fetch_scale[] = {
    {0, {24, 0, 38}, "0"},      {1, {34, 13, 94}, "1"},     {2, {4, 55, 126}, "2"},    {4, {5, 94, 129}, "4"},
    {8, {2, 128, 142}, "8"},    {16, {1, 165, 148}, "16"},  {32, {93, 197, 138}, "32"}, {64, {174, 221, 128}, "64"},
    {128, {248, 240, 133}, "128"},
};

constexpr Rgb8 right_colour = {18, 18, 20};
constexpr Rgb8 not_judged_colour = {112, 112, 116};
constexpr Rgb8 not_found_colour = {255, 255, 255};

// Position among the anchors: whole numbers at the anchors, logarithmic between them.
Rgb8 colour_at(std::span<const Anchor> scale, double position) {
    const double last = static_cast<double>(scale.size() - 1);
    position = std::clamp(position, 0.0, last);
    const auto i = static_cast<std::size_t>(std::min(position, last - 1));
    const double t = position - static_cast<double>(i);
    Rgb8 out;
    for (std::size_t c = 0; c < 3; ++c) {
        out[c] = static_cast<std::uint8_t>(std::lround(scale[i].colour[c] * (1 - t) + scale[i + 1].colour[c] * t));
    }
    return out;
}

Rgb8 hit_error_colour(float error) {
    if (std::isnan(error)) return not_judged_colour;
    if (std::isinf(error)) return not_found_colour;
    const double size = std::abs(static_cast<double>(error));
    if (size <= right_within_texels) return right_colour;
    return colour_at(error > 0 ? std::span(late_scale) : std::span(early_scale), std::log2(size / right_within_texels));
}

double fetch_position(double fetches) { return fetches <= 1 ? fetches : 1 + std::log2(fetches); }

template <class F>
Image8 coloured(int width, int height, int threads, F&& colour_of) {
    Image8 out(width, height, 3);
    parallel_for(height, 32, threads, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < width; ++x) {
                const Rgb8 colour = colour_of(x, y);
                std::copy(colour.begin(), colour.end(), out.at(x, y));
            }
        }
    });
    return out;
}

}  // namespace

ImageF hit_error_texels(const Frame& picture, const Frame& reference, const RayField& rays, Vec2i texels, int threads) {
    assert(picture.width == reference.width && picture.height == reference.height);
    assert(picture.width == rays.width && picture.height == rays.height);
    assert(texels.x > 0 && texels.y > 0);
    constexpr auto hit = static_cast<std::uint8_t>(Coverage::hit);
    const Vec2d size{static_cast<double>(texels.x), static_cast<double>(texels.y)};
    ImageF error(picture.width, picture.height, 1, std::numeric_limits<float>::quiet_NaN());
    parallel_for(picture.height, 32, threads, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < picture.width; ++x) {
                if (rays.coverage(x, y) != hit || reference.coverage(x, y) != hit) continue;
                error(x, y) = std::numeric_limits<float>::infinity();
                if (picture.coverage(x, y) != hit) continue;
                const float* a = picture.hit_uv.at(x, y);
                const float* b = reference.hit_uv.at(x, y);
                const float* v = rays.view.at(x, y);
                const double late = texels_along_ray({a[0], a[1]}, {b[0], b[1]}, {v[0], v[1], v[2]}, size);
                // A hit at no number is no hit.
                if (std::isfinite(late)) error(x, y) = static_cast<float>(std::clamp(late, -1e30, 1e30));
            }
        }
    });
    return error;
}

Image8 hit_error_picture(const ImageF& error_texels, int threads) {
    assert(error_texels.channels == 1);
    return coloured(error_texels.width, error_texels.height, threads,
                    [&](int x, int y) { return hit_error_colour(error_texels(x, y)); });
}

Legend hit_error_legend() {
    Legend legend{.title = "Where the hit is wrong, along the ray", .unit = "texels of the height map", .low_end = "early",
                  .high_end = "late"};
    // One octave is one step of the bar, and so is the stretch in the middle where the hit is right.
    constexpr int octaves = static_cast<int>(std::size(late_scale)) - 1;
    constexpr double bar = 2 * octaves + 1;
    for (int i = octaves; i >= 0; --i) {
        const Anchor& a = early_scale[i];
        legend.stops.push_back({(octaves - i) / bar, -a.value, a.colour, std::string(a.label)});
    }
    legend.stops.push_back({octaves / bar, -right_within_texels, right_colour, ""});
    legend.stops.push_back({0.5, 0, right_colour, "right"});
    legend.stops.push_back({(octaves + 1) / bar, right_within_texels, right_colour, ""});
    for (int i = 0; i <= octaves; ++i) {
        const Anchor& a = late_scale[i];
        legend.stops.push_back({(octaves + 1 + i) / bar, a.value, a.colour, std::string(a.label)});
    }
    legend.keys = {{not_found_colour, "no surface found"}, {not_judged_colour, "background"}};
    return legend;
}

Image8 fetches_picture(const Frame& picture, int threads) {
    return coloured(picture.width, picture.height, threads, [&](int x, int y) {
        switch (static_cast<Coverage>(picture.coverage(x, y))) {
            case Coverage::background: return not_judged_colour;
            case Coverage::no_hit: return not_found_colour;
            case Coverage::hit: break;
        }
        const double fetches = static_cast<double>(picture.fetches(x, y));
        return fetches >= 0 ? colour_at(fetch_scale, fetch_position(fetches)) : colour_at(fetch_scale, 0);
    });
}

Legend fetches_legend() {
    Legend legend{.title = "What the search cost", .unit = "texture fetches", .low_end = "cheap", .high_end = "dear"};
    constexpr double last = static_cast<double>(std::size(fetch_scale) - 1);
    for (std::size_t i = 0; i < std::size(fetch_scale); ++i) {
        const Anchor& a = fetch_scale[i];
        legend.stops.push_back({static_cast<double>(i) / last, a.value, a.colour, std::string(a.label)});
    }
    legend.keys = {{not_found_colour, "no surface found"}, {not_judged_colour, "background"}};
    return legend;
}

}  // namespace relievo
