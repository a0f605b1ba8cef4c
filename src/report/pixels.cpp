#include "report/pixels.h"

#include "core/vec.h"

#include <nlohmann/json.hpp>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <new>
#include <vector>

namespace relievo {

namespace {

// The page reads these by number.
enum Verdict : std::uint8_t { beside = 0, right = 1, late = 2, early = 3, nothing = 4, invented = 5 };

// Half a texel: the distance from which measure counts a hit as missed or early.
constexpr double wrong_from_texels = 0.5;

struct Judged {
    Verdict verdict = beside;
    Vec2d offset;  // found minus true, texels
};

Judged judge(const Frame& picture, const Frame& reference, const RayField& rays, const PixelSettings& settings, int x, int y) {
    const auto is = [&](const Image8& plane, Coverage c) { return plane(x, y) == static_cast<std::uint8_t>(c); };
    if (!is(rays.coverage, Coverage::hit)) return {};
    const bool found = is(picture.coverage, Coverage::hit);
    const bool true_hit = is(reference.coverage, Coverage::hit);
    if (!true_hit) return {found ? invented : right, {}};
    if (!found) return {nothing, {}};
    const Vec2d offset{(static_cast<double>(picture.hit_uv(x, y, 0)) - reference.hit_uv(x, y, 0)) * settings.texels_x,
                       (static_cast<double>(picture.hit_uv(x, y, 1)) - reference.hit_uv(x, y, 1)) * settings.texels_y};
    // The ray descends against the view vector; a hit farther that way lies behind the true one.
    const Vec2d down{-static_cast<double>(rays.view(x, y, 0)) * settings.texels_x, -static_cast<double>(rays.view(x, y, 1)) * settings.texels_y};
    const double size = std::hypot(down.x, down.y);
    const double along = size > 0 ? (offset.x * down.x + offset.y * down.y) / size : 0;
    return {along > wrong_from_texels ? late : along < -wrong_from_texels ? early : right, offset};
}

// Sign and logarithm in one byte. The page holds the reverse (pixels.js).
struct Scale {
    double smallest;
    double levels_per_octave;
    std::uint8_t operator()(double value) const {
        const double level = std::round(std::log2(1 + std::abs(value) / smallest) * levels_per_octave);
        const int byte = static_cast<int>(std::min(127.0, level));
        return static_cast<std::uint8_t>(value < 0 ? -byte : byte);
    }
};
constexpr Scale offset_scale{1.0 / 32, 8};    // up to 1870 texels
constexpr Scale height_scale{1.0 / 1024, 12};  // up to 1.5

std::string base64(const std::vector<unsigned char>& bytes) {
    static constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const unsigned a = bytes[i];
        const unsigned b = i + 1 < bytes.size() ? bytes[i + 1] : 0;
        const unsigned c = i + 2 < bytes.size() ? bytes[i + 2] : 0;
        text += digits[a >> 2];
        text += digits[(a & 3) << 4 | b >> 4];
        text += i + 1 < bytes.size() ? digits[(b & 15) << 2 | c >> 6] : '=';
        text += i + 2 < bytes.size() ? digits[c & 63] : '=';
    }
    return text;
}

struct Planes {
    int width, height;
    nlohmann::ordered_json names;
    std::vector<std::uint8_t> bytes;

    // value(x, y) -> byte
    template <class F>
    void add(const char* name, F value) {
        names.push_back(name);
        for (int y = 0; y < height; ++y) {
            std::uint8_t left = 0;
            for (int x = 0; x < width; ++x) {
                const std::uint8_t v = value(x, y);
                bytes.push_back(static_cast<std::uint8_t>(v - left));
                left = v;
            }
        }
    }
    // value(x, y) -> whole number in [0, 65535]
    template <class F>
    void add_word(const std::string& name, F value) {
        add((name + "_high").c_str(), [&](int x, int y) { return static_cast<std::uint8_t>(value(x, y) >> 8); });
        add((name + "_low").c_str(), [&](int x, int y) { return static_cast<std::uint8_t>(value(x, y) & 255); });
    }
    std::string script(const nlohmann::ordered_json& more = nlohmann::ordered_json::object()) const {
        constexpr int level = 3;  // a run makes hundreds of these: speed before size
        uLongf size = compressBound(static_cast<uLong>(bytes.size()));
        std::vector<unsigned char> packed(size);
        if (compress2(packed.data(), &size, bytes.data(), static_cast<uLong>(bytes.size()), level) != Z_OK) throw std::bad_alloc();
        packed.resize(size);
        nlohmann::ordered_json payload{{"width", width}, {"height", height}, {"planes", names}};
        payload.update(more);
        payload["data"] = base64(packed);
        return "relievo_pixels(" + payload.dump() + ");\n";
    }
};

unsigned word(double share) { return static_cast<unsigned>(std::lround(std::clamp(share, 0.0, 1.0) * 65535)); }

}  // namespace

std::string pixel_script(const Frame& picture, const Frame& reference, const RayField& rays, const PixelSettings& settings) {
    assert(picture.width == reference.width && picture.height == reference.height && picture.width == rays.width && picture.height == rays.height);
    Image<Judged> judged(picture.width, picture.height, 1);
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x) judged(x, y) = judge(picture, reference, rays, settings, x, y);
    Planes planes{.width = picture.width, .height = picture.height, .names = nlohmann::ordered_json::array(), .bytes = {}};
    planes.add("verdict", [&](int x, int y) { return static_cast<std::uint8_t>(judged(x, y).verdict); });
    planes.add("offset_u", [&](int x, int y) { return offset_scale(judged(x, y).offset.x); });
    planes.add("offset_v", [&](int x, int y) { return offset_scale(judged(x, y).offset.y); });
    planes.add("offset_height", [&](int x, int y) {
        const Verdict v = judged(x, y).verdict;
        return v == right || v == late || v == early ? height_scale(static_cast<double>(picture.hit_height(x, y)) - reference.hit_height(x, y)) : std::uint8_t{0};
    });
    planes.add_word("fetches", [&](int x, int y) { return static_cast<unsigned>(std::clamp(picture.fetches(x, y), 0.0f, 65535.0f)); });
    return planes.script();
}

std::string reference_pixel_script(const Frame& reference) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (int y = 0; y < reference.height; ++y) {
        for (int x = 0; x < reference.width; ++x) {
            if (reference.coverage(x, y) != static_cast<std::uint8_t>(Coverage::hit)) continue;
            for (int c = 0; c < 2; ++c) {
                low = std::min(low, static_cast<double>(reference.hit_uv(x, y, c)));
                high = std::max(high, static_cast<double>(reference.hit_uv(x, y, c)));
            }
        }
    }
    if (!(high > low)) low = 0, high = 1;
    Planes planes{.width = reference.width, .height = reference.height, .names = nlohmann::ordered_json::array(), .bytes = {}};
    planes.add_word("u", [&](int x, int y) { return word((reference.hit_uv(x, y, 0) - low) / (high - low)); });
    planes.add_word("v", [&](int x, int y) { return word((reference.hit_uv(x, y, 1) - low) / (high - low)); });
    planes.add_word("height", [&](int x, int y) { return word(reference.hit_height(x, y)); });
    return planes.script({{"uv_from", low}, {"uv_to", high}});
}

std::string where_it_is_wrong(const Frame& picture, const Frame& reference, const RayField& rays, const PixelSettings& settings) {
    // Thirds of the surface's own box on the screen, since the surface rarely fills the picture.
    int x0 = rays.width, x1 = -1, y0 = rays.height, y1 = -1;
    for (int y = 0; y < rays.height; ++y) {
        for (int x = 0; x < rays.width; ++x) {
            if (rays.coverage(x, y) != static_cast<std::uint8_t>(Coverage::hit)) continue;
            x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
        }
    }
    if (x1 < x0) return "";
    std::array<double, 3> rows{}, columns{}, row_pixels{}, column_pixels{};
    double wrong = 0, all = 0;
    for (int y = y0; y <= y1; ++y) {
        for (int x = x0; x <= x1; ++x) {
            const Verdict v = judge(picture, reference, rays, settings, x, y).verdict;
            if (v == beside) continue;
            const auto r = static_cast<std::size_t>(3 * (y - y0) / (y1 - y0 + 1));
            const auto c = static_cast<std::size_t>(3 * (x - x0) / (x1 - x0 + 1));
            const double is_wrong = v == right ? 0 : 1;
            wrong += is_wrong, ++all;
            rows[r] += is_wrong, columns[c] += is_wrong, ++row_pixels[r], ++column_pixels[c];
        }
    }
    if (wrong < all * 1e-4) return "";
    // Densities, since the far third holds fewer pixels; a third is named when it is half as bad again as the whole.
    const auto worst = [&](const std::array<double, 3>& counts, const std::array<double, 3>& pixels) {
        int found = -1;
        double most = 1.5 * wrong / all;
        for (int i = 0; i < 3; ++i) {
            const auto k = static_cast<std::size_t>(i);
            if (pixels[k] > 0 && counts[k] / pixels[k] > most) most = counts[k] / pixels[k], found = i;
        }
        return found;
    };
    static constexpr const char* depth[] = {"in the far third", "in the middle distance", "in the near third"};
    static constexpr const char* side[] = {"to the left", "in the middle column", "to the right"};
    const int r = worst(rows, row_pixels);
    const int c = worst(columns, column_pixels);
    if (r < 0 && c < 0) return "Spread over the whole surface.";
    std::string text = "Worst ";
    if (r >= 0) text += depth[r];
    if (c >= 0) text += std::string(r >= 0 ? ", " : "") + side[c];
    return text + ".";
}

}  // namespace relievo
