#include "report/pixels.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include <cmath>
#include <map>

namespace relievo {
namespace {

constexpr int w = 30, h = 20;

struct Case {
    Frame picture{w, h}, reference{w, h};
    RayField rays{w, h};
    PixelSettings settings{100, 100};
    Case() {
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < w; ++x) {
                rays.coverage(x, y) = picture.coverage(x, y) = reference.coverage(x, y) = 1;
                rays.view(x, y, 0) = 0.8f, rays.view(x, y, 2) = 0.6f;  // the eye stands toward +u, so rays descend toward -u
                reference.hit_uv(x, y, 0) = picture.hit_uv(x, y, 0) = 0.01f * static_cast<float>(x) - 0.5f;
                reference.hit_uv(x, y, 1) = picture.hit_uv(x, y, 1) = 0.03f * static_cast<float>(y);
                reference.hit_height(x, y) = picture.hit_height(x, y) = 0.25f;
                picture.fetches(x, y) = static_cast<float>(x * 20);
            }
        }
    }
};

// What the page does, in C++.
std::map<std::string, std::vector<std::uint8_t>> unpacked(const std::string& script) {
    const std::string call = "relievo_pixels(";
    EXPECT_TRUE(script.starts_with(call));
    const auto payload = nlohmann::json::parse(script.substr(call.size(), script.rfind(')') - call.size()));
    std::vector<std::uint8_t> packed;
    unsigned bits = 0;
    int count = 0;
    for (const char c : payload["data"].get<std::string>()) {
        if (c == '=') break;
        static const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        bits = bits << 6 | static_cast<unsigned>(digits.find(c));
        if ((count += 6) >= 8) packed.push_back(static_cast<std::uint8_t>(bits >> (count -= 8) & 255));
    }
    const std::size_t pixels = w * h;
    std::vector<std::uint8_t> bytes(payload["planes"].size() * pixels);
    uLongf size = bytes.size();
    EXPECT_EQ(uncompress(bytes.data(), &size, packed.data(), packed.size()), Z_OK);
    EXPECT_EQ(size, bytes.size());
    std::map<std::string, std::vector<std::uint8_t>> planes;
    for (std::size_t p = 0; p < payload["planes"].size(); ++p) {
        std::vector<std::uint8_t> plane(bytes.begin() + static_cast<long>(p * pixels), bytes.begin() + static_cast<long>((p + 1) * pixels));
        for (std::size_t i = 0; i < pixels; ++i)
            if (i % w) plane[i] = static_cast<std::uint8_t>(plane[i] + plane[i - 1]);
        planes[payload["planes"][p]] = plane;
    }
    return planes;
}

TEST(Pixels, TellLateFromEarly) {
    Case c;
    c.picture.hit_uv(3, 4, 0) -= 0.05f;   // five texels farther down the ray
    c.picture.hit_uv(4, 4, 0) += 0.05f;   // five texels before it
    c.picture.hit_uv(5, 4, 0) -= 0.004f;  // less than half a texel
    c.picture.coverage(6, 4) = 2;
    c.reference.coverage(7, 4) = 2;
    c.rays.coverage(8, 4) = c.picture.coverage(8, 4) = c.reference.coverage(8, 4) = 0;
    const auto planes = unpacked(pixel_script(c.picture, c.reference, c.rays, c.settings));
    const auto at = [&](const char* plane, int x) { return planes.at(plane)[static_cast<std::size_t>(4 * w + x)]; };
    EXPECT_EQ(at("verdict", 2), 1);
    EXPECT_EQ(at("verdict", 3), 2);
    EXPECT_EQ(at("verdict", 4), 3);
    EXPECT_EQ(at("verdict", 5), 1);
    EXPECT_EQ(at("verdict", 6), 4);
    EXPECT_EQ(at("verdict", 7), 5);
    EXPECT_EQ(at("verdict", 8), 0);
    EXPECT_EQ(at("fetches_high", 20) * 256 + at("fetches_low", 20), 400);
    const auto texels = [](std::uint8_t byte) {
        const int level = static_cast<std::int8_t>(byte);
        return std::copysign((std::exp2(std::abs(level) / 8.0) - 1) / 32, level);
    };
    EXPECT_EQ(at("offset_u", 2), 0);
    EXPECT_NEAR(texels(at("offset_u", 3)), -5, 0.25);
    EXPECT_NEAR(texels(at("offset_u", 4)), 5, 0.25);
    EXPECT_NEAR(texels(at("offset_u", 5)), -0.4, 0.03);
}

TEST(Pixels, KeepTheTruthIn16Bits) {
    Case c;
    const std::string script = reference_pixel_script(c.reference);
    const auto planes = unpacked(script);
    const auto payload = nlohmann::json::parse(script.substr(15, script.rfind(')') - 15));
    const double from = payload["uv_from"], to = payload["uv_to"];
    for (const int x : {0, 7, 29}) {
        const auto i = static_cast<std::size_t>(5 * w + x);
        const double u = from + (to - from) * (planes.at("u_high")[i] * 256 + planes.at("u_low")[i]) / 65535;
        EXPECT_NEAR(u, c.reference.hit_uv(x, 5, 0), 2e-5);
        EXPECT_NEAR((planes.at("height_high")[i] * 256 + planes.at("height_low")[i]) / 65535.0, 0.25, 1e-5);
    }
}

TEST(Pixels, SurviveAPictureWithoutHits) {
    Case c;
    for (std::uint8_t& v : c.reference.coverage.texels) v = 0;
    EXPECT_FALSE(reference_pixel_script(c.reference).empty());
    for (std::uint8_t& v : c.rays.coverage.texels) v = 0;
    EXPECT_EQ(where_it_is_wrong(c.picture, c.reference, c.rays, c.settings), "");
}

TEST(Where, NamesTheWorstThird) {
    Case c;
    EXPECT_EQ(where_it_is_wrong(c.picture, c.reference, c.rays, c.settings), "");
    for (int x = 22; x < w; ++x)
        for (int y = 0; y < 5; ++y) c.picture.hit_uv(x, y, 0) -= 0.1f;
    EXPECT_EQ(where_it_is_wrong(c.picture, c.reference, c.rays, c.settings), "Worst in the far third, to the right.");
    for (int x = 0; x < w; ++x)
        for (int y = 0; y < h; ++y) c.picture.coverage(x, y) = 2;
    EXPECT_EQ(where_it_is_wrong(c.picture, c.reference, c.rays, c.settings), "Spread over the whole surface.");
}

}  // namespace
}  // namespace relievo
