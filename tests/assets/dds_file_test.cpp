// Blocks against what can be had exactly, and whole files read back by OpenImageIO, which shares no code with their writer.
#include "assets/dds_file.h"

#include "assets/block_compression.h"
#include "assets/image_file.h"
#include "temporary_folder.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <random>

namespace relievo {
namespace {

int error_of(const ColourBlock& a, const ColourBlock& b) {
    int e = 0;
    for (std::size_t t = 0; t < 16; ++t)
        for (std::size_t k = 0; k < 3; ++k) e += (a[t][k] - b[t][k]) * (a[t][k] - b[t][k]);
    return e;
}

TEST(BlockCompression, IsExactWhereItCanBe) {
    // One colour whose channels lie on the grid, and two of them.
    ColourBlock colours;
    colours.fill({255, 0, 132});
    EXPECT_EQ(decoded_bc1(bc1_block(colours)), colours);
    for (std::size_t t = 0; t < 16; t += 3) colours[t] = {0, 255, 33};
    EXPECT_EQ(decoded_bc1(bc1_block(colours)), colours);
    GreyBlock mask;
    for (std::size_t t = 0; t < 16; ++t) mask[t] = t % 3 == 0 ? 255 : 0;
    EXPECT_EQ(decoded_bc4(bc4_block(mask)), mask);
    for (const int v : {0, 1, 77, 254, 255}) {
        mask.fill(static_cast<std::uint8_t>(v));
        EXPECT_EQ(decoded_bc4(bc4_block(mask)), mask);
    }
    // 0 and 255 and two values beside them: the mode with exact ends.
    for (std::size_t t = 0; t < 16; ++t) mask[t] = static_cast<std::uint8_t>(t % 4 == 0 ? 0 : t % 4 == 1 ? 255 : t % 4 == 2 ? 100 : 105);
    EXPECT_EQ(decoded_bc4(bc4_block(mask)), mask);
    // Eight steps of a ramp.
    for (std::size_t t = 0; t < 16; ++t) mask[t] = static_cast<std::uint8_t>(30 + 14 * (t / 2));
    EXPECT_EQ(decoded_bc4(bc4_block(mask)), mask);
}

TEST(BlockCompression, OneColourIsWithinTwoSteps) {
    // Mixtures of neighbours on the grid of 32 and 64 levels come within 2 and 1 of every value.
    for (int v = 0; v < 256; ++v) {
        ColourBlock colours;
        colours.fill({static_cast<std::uint8_t>(v), static_cast<std::uint8_t>(255 - v), static_cast<std::uint8_t>((v * 7) & 255)});
        const ColourBlock back = decoded_bc1(bc1_block(colours));
        EXPECT_LE(std::abs(back[5][0] - colours[5][0]), 2) << v;
        EXPECT_LE(std::abs(back[5][1] - colours[5][1]), 1) << v;
        EXPECT_LE(std::abs(back[5][2] - colours[5][2]), 2) << v;
    }
}

TEST(BlockCompression, IsNearTheBestOfManyEnds) {
    // Against the best of 3000 random pairs of ends near the block's own colours, for blocks as pictures have them: a slope and noise.
    std::mt19937 random(11);
    const auto below = [&](unsigned n) { return static_cast<int>(random() % n); };
    double ours = 0, best_sum = 0;
    for (int block = 0; block < 60; ++block) {
        ColourBlock colours;
        const int base[] = {below(200), below(200), below(200)}, step_x[] = {below(12), below(12), below(12)}, step_y[] = {below(12) - 6, below(12), below(12) - 6};
        for (int t = 0; t < 16; ++t)
            for (int k = 0; k < 3; ++k) colours[static_cast<std::size_t>(t)][static_cast<std::size_t>(k)] = static_cast<std::uint8_t>(std::clamp(base[k] + step_x[k] * (t % 4) + step_y[k] * (t / 4) + below(7), 0, 255));
        const int own = error_of(decoded_bc1(bc1_block(colours)), colours);
        int best = own;
        for (int i = 0; i < 3000; ++i) {
            std::uint16_t ends[2];
            for (std::uint16_t& e : ends) {
                const auto& c = colours[random() % 16];
                const int r = std::clamp(c[0] / 8 + below(3) - 1, 0, 31), g = std::clamp(c[1] / 4 + below(5) - 2, 0, 63), b = std::clamp(c[2] / 8 + below(3) - 1, 0, 31);
                e = static_cast<std::uint16_t>(r << 11 | g << 5 | b);
            }
            if (ends[0] < ends[1]) std::swap(ends[0], ends[1]);
            if (ends[0] == ends[1]) continue;
            // The nearest of the four colours to each texel, read off a block that shows all four.
            const ColourBlock four = decoded_bc1({static_cast<std::uint8_t>(ends[0] & 255), static_cast<std::uint8_t>(ends[0] >> 8), static_cast<std::uint8_t>(ends[1] & 255),
                                                  static_cast<std::uint8_t>(ends[1] >> 8), 0b11100100, 0, 0, 0});
            int e = 0;
            for (const auto& c : colours) {
                int least = 1 << 30;
                for (std::size_t p = 0; p < 4; ++p) least = std::min(least, (c[0] - four[p][0]) * (c[0] - four[p][0]) + (c[1] - four[p][1]) * (c[1] - four[p][1]) + (c[2] - four[p][2]) * (c[2] - four[p][2]));
                e += least;
            }
            best = std::min(best, e);
        }
        ours += own;
        best_sum += best;
    }
    EXPECT_LT(ours, 1.08 * best_sum);
}

// Levels of a made-up face: a colour slope, and an alpha of dots.
std::vector<Image8> levels_of(int width, int height, int face) {
    std::vector<Image8> levels;
    for (;;) {
        Image8 level(width, height, 4);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                level(x, y, 0) = static_cast<std::uint8_t>(40 * face + 20 * x / width);
                level(x, y, 1) = static_cast<std::uint8_t>(200 * y / height);
                level(x, y, 2) = static_cast<std::uint8_t>(90 + 60 * x / width);
                level(x, y, 3) = static_cast<std::uint8_t>((x * 7 + y * 3 + face) % 5 == 0 ? 255 : 0);
            }
        levels.push_back(std::move(level));
        if (width == 1 && height == 1) return levels;
        width = std::max(1, width / 2);
        height = std::max(1, height / 2);
    }
}

class DdsFile : public test::InTemporaryFolder {};

void expect_near(const std::vector<std::uint8_t>& texels, int stride, int channels, int x0, int y0, const Image8& wanted, DdsCode code, const std::string& where) {
    int worst_colour = 0, worst_alpha = 0;
    for (int y = 0; y < wanted.height; ++y)
        for (int x = 0; x < wanted.width; ++x) {
            const std::uint8_t* t = &texels[static_cast<std::size_t>((y0 + y) * stride + x0 + x) * static_cast<std::size_t>(channels)];
            if (code == DdsCode::bc4) {
                worst_alpha = std::max(worst_alpha, std::abs(t[0] - wanted(x, y, 3)));
                continue;
            }
            for (int c = 0; c < 3; ++c) worst_colour = std::max(worst_colour, std::abs(t[c] - wanted(x, y, c)));
            if (code == DdsCode::bc3) worst_alpha = std::max(worst_alpha, std::abs(t[3] - wanted(x, y, 3)));
        }
    // A slope in two directions does not lie on a line of four colours; the smallest levels, where it is steep, are the worst.
    EXPECT_LE(worst_colour, wanted.width >= 16 ? 24 : 110) << where;
    EXPECT_EQ(worst_alpha, 0) << where;
}

TEST_F(DdsFile, IsReadByOpenImageIO) {
    for (const DdsCode code : {DdsCode::bc1, DdsCode::bc3, DdsCode::bc4})
        for (const auto& [width, height] : {std::pair{64, 32}, std::pair{13, 7}, std::pair{1, 1}}) {
            const std::vector<Image8> levels = levels_of(width, height, 1);
            const auto file = folder / "flat.dds";
            write_dds(file, std::span(&levels, 1), code);
            auto input = OIIO::ImageInput::open(file);
            ASSERT_TRUE(input) << OIIO::geterror();
            for (int k = 0; k < static_cast<int>(levels.size()); ++k) {
                ASSERT_TRUE(input->seek_subimage(0, k)) << k;
                const OIIO::ImageSpec& spec = input->spec();
                ASSERT_EQ(spec.width, std::max(1, width >> k));
                ASSERT_EQ(spec.height, std::max(1, height >> k));
                std::vector<std::uint8_t> texels(static_cast<std::size_t>(spec.width * spec.height * spec.nchannels));
                ASSERT_TRUE(input->read_image(0, k, 0, spec.nchannels, OIIO::TypeDesc::UINT8, texels.data())) << input->geterror();
                expect_near(texels, spec.width, spec.nchannels, 0, 0, levels[static_cast<std::size_t>(k)], code, std::to_string(width) + " level " + std::to_string(k));
            }
            EXPECT_FALSE(input->seek_subimage(0, static_cast<int>(levels.size())));
            // And by our own reader, which takes it for a picture.
            EXPECT_EQ(read_image_8(file).width, width);
        }
}

TEST_F(DdsFile, CubesKeepTheirFacesAndLevels) {
    std::vector<std::vector<Image8>> faces;
    for (int f = 0; f < 6; ++f) faces.push_back(levels_of(32, 32, f));
    const auto file = folder / "cube.dds";
    write_dds(file, faces, DdsCode::bc3);
    std::size_t bytes = 128;
    for (int k = 0; k < 6; ++k) bytes += 6 * 16 * static_cast<std::size_t>(std::max(1, (32 >> k) / 4)) * static_cast<std::size_t>(std::max(1, (32 >> k) / 4));
    EXPECT_EQ(std::filesystem::file_size(file), bytes);
    auto input = OIIO::ImageInput::open(file);
    ASSERT_TRUE(input) << OIIO::geterror();
    EXPECT_NE(input->spec().get_string_attribute("textureformat").find("CubeFace"), std::string::npos);
    const OIIO::ImageSpec spec = input->spec();
    // OpenImageIO lays the faces out as tiles: across first.
    ASSERT_EQ(spec.tile_width, 32);
    const int across = spec.width / 32;
    ASSERT_EQ(across * (spec.height / 32), 6);
    // Each face's levels follow on one another, as in files of their own, which the test above has read.
    std::string faces_alone;
    for (int f = 0; f < 6; ++f) {
        std::vector<std::uint8_t> texels(static_cast<std::size_t>(32 * 32 * spec.nchannels));
        ASSERT_TRUE(input->read_tile(f % across * 32, f / across * 32, 0, OIIO::TypeDesc::UINT8, texels.data())) << input->geterror();
        expect_near(texels, 32, spec.nchannels, 0, 0, faces[static_cast<std::size_t>(f)][0], DdsCode::bc3, "face " + std::to_string(f));
        write_dds(folder / "face.dds", std::span(&faces[static_cast<std::size_t>(f)], 1), DdsCode::bc3);
        faces_alone += bytes_of(folder / "face.dds").substr(128);
    }
    EXPECT_EQ(bytes_of(file).substr(128), faces_alone);
    EXPECT_THROW(write_dds(folder / "no such folder" / "cube.dds", faces, DdsCode::bc3), std::runtime_error);
}

TEST_F(DdsFile, IsTheSameForAnyThreads) {
    const std::vector<Image8> levels = levels_of(128, 128, 2);
    const auto text = [&](int threads) {
        write_dds(folder / "t.dds", std::span(&levels, 1), DdsCode::bc3, threads);
        std::ifstream in(folder / "t.dds", std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(in), {});
    };
    EXPECT_EQ(text(1), text(3));
}

}  // namespace
}  // namespace relievo
