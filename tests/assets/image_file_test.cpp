#include "assets/image_file.h"

#include "core/error.h"
#include "temporary_folder.h"

#include <OpenImageIO/imageio.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <utility>

namespace relievo::test {

namespace {

// A PNG made by hand, uncompressed: the writer under test makes no palettes.
std::string chunk(const std::string& name, const std::string& data) {
    const auto word = [](std::uint32_t x) {
        return std::string{static_cast<char>(x >> 24), static_cast<char>(x >> 16), static_cast<char>(x >> 8), static_cast<char>(x)};
    };
    std::uint32_t crc = 0xffffffffu;
    for (const char c : name + data) {
        crc ^= static_cast<unsigned char>(c);
        for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
    }
    return word(static_cast<std::uint32_t>(data.size())) + name + data + word(~crc);
}

std::string palette_png(int width, int height, const std::string& palette, const std::string& indices,
                        std::uint32_t claimed_width = 0) {
    if (claimed_width == 0) claimed_width = static_cast<std::uint32_t>(width);
    std::string rows;
    for (int j = 0; j < height; ++j)
        rows += '\0' + indices.substr(static_cast<std::size_t>(j * width), static_cast<std::size_t>(width));
    std::uint32_t a = 1, b = 0;
    for (const char c : rows) a = (a + static_cast<unsigned char>(c)) % 65521, b = (b + a) % 65521;
    const auto n = static_cast<std::uint16_t>(rows.size());
    const std::string deflated = std::string("\x78\x01\x01", 3) + static_cast<char>(n) + static_cast<char>(n >> 8) +
                                 static_cast<char>(~n) + static_cast<char>(static_cast<std::uint16_t>(~n) >> 8) + rows +
                                 static_cast<char>(b >> 8) + static_cast<char>(b) + static_cast<char>(a >> 8) +
                                 static_cast<char>(a);
    const auto word = [](std::uint32_t x) {
        return std::string{static_cast<char>(x >> 24), static_cast<char>(x >> 16), static_cast<char>(x >> 8), static_cast<char>(x)};
    };
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR", word(claimed_width) + word(static_cast<std::uint32_t>(height)) + std::string("\x08\x03\0\0\0", 5)) +
           chunk("PLTE", palette) + chunk("IDAT", deflated) + chunk("IEND", "");
}

ImageF ramp(int width, int height, int channels) {
    ImageF image(width, height, channels);
    for (std::size_t i = 0; i < image.texels.size(); ++i) image.texels[i] = static_cast<float>(i % 65536) / 65535.0f;
    return image;
}

}  // namespace

class ImageFile : public InTemporaryFolder {
protected:
    // Written by OpenImageIO itself, row 0 on top.
    std::filesystem::path put_image(const std::string& name, const ImageF& image, OIIO::TypeDesc type) const {
        const std::string file = (folder / name).string();
        const auto output = OIIO::ImageOutput::create(file);
        OIIO::ImageSpec spec(image.width, image.height, image.channels, type);
        spec["oiio:UnassociatedAlpha"] = 1;
        EXPECT_TRUE(output && output->open(file, spec) && output->write_image(OIIO::TypeDesc::FLOAT, image.texels.data()) &&
                    output->close())
            << name;
        return file;
    }
    std::string refusal(const std::filesystem::path& file) const {
        const std::string message = message_of<Error>([&] { read_image(file); });
        EXPECT_TRUE(has(message, file.string())) << message;
        EXPECT_THROW(read_image_8(file), Error);
        return message;
    }
};

TEST_F(ImageFile, EightBitsRoundTripBothWaysUp) {
    for (int channels = 1; channels <= 4; ++channels) {
        Image8 image(5, 3, channels);
        for (std::size_t i = 0; i < image.texels.size(); ++i) image.texels[i] = static_cast<std::uint8_t>(i * 37);
        for (const FirstRow rows : {FirstRow::bottom, FirstRow::top}) {
            write_png(folder / "a.png", image, rows);
            const Image8 back = read_image_8(folder / "a.png", rows);
            EXPECT_EQ(back.channels, channels);
            EXPECT_EQ(back.texels, image.texels);
        }
        const Image8 flipped = read_image_8(folder / "a.png", FirstRow::bottom);  // written top first
        EXPECT_EQ(flipped(1, 0), image(1, 2));
        EXPECT_EQ(flipped(1, 2), image(1, 0));
    }
}

TEST_F(ImageFile, EverySixteenBitValueSurvives) {
    const ImageF image = ramp(256, 256, 1);
    write_png_16(folder / "a.png", image, FirstRow::bottom);
    EXPECT_EQ(read_image(folder / "a.png").texels, image.texels);
    const ImageFileInfo info = read_image_info(folder / "a.png");
    EXPECT_EQ(info.bits, 16);
    EXPECT_FALSE(info.floating);
    EXPECT_EQ(info.format, "png");
}

TEST_F(ImageFile, SixteenBitsClampWhatDoesNotFit) {
    ImageF image(4, 1, 1);
    image.texels = {-1, 2, std::numeric_limits<float>::quiet_NaN(), 0.5f};
    write_png_16(folder / "a.png", image, FirstRow::bottom);
    EXPECT_EQ(read_image(folder / "a.png").texels, (std::vector<float>{0, 1, 0, 32768 / 65535.0f}));
}

TEST_F(ImageFile, FloatsSurviveAndPlanesKeepTheirNames) {
    ImageF image = ramp(7, 5, 2);
    image(3, 2, 1) = -1e30f;
    image(0, 0, 0) = std::numeric_limits<float>::infinity();
    write_exr(folder / "a.exr", std::vector<ExrChannel>{{"cone", &image, 1}, {"height", &image, 0}}, FirstRow::bottom);
    const ImageF back = read_image(folder / "a.exr");
    ASSERT_EQ(back.channels, 2);
    for (int j = 0; j < 5; ++j)
        for (int i = 0; i < 7; ++i) {
            EXPECT_EQ(back(i, j, 0), image(i, j, 1));
            EXPECT_EQ(back(i, j, 1), image(i, j, 0));
        }
    EXPECT_TRUE(read_image_info(folder / "a.exr").floating);
}

TEST_F(ImageFile, FormatsOfOtherPrograms) {
    ImageF image = ramp(8, 6, 3);
    for (std::size_t i = 0; i < image.texels.size(); ++i) image.texels[i] = static_cast<float>(i) / 144;
    struct Case {
        const char* name;
        OIIO::TypeDesc type;
        float tolerance;
    };
    const Case cases[] = {{"a.png", OIIO::TypeDesc::UINT8, 0.5f / 255},    {"b.tga", OIIO::TypeDesc::UINT8, 0.5f / 255},
                          {"c.tif", OIIO::TypeDesc::UINT16, 0.5f / 65535}, {"d.tif", OIIO::TypeDesc::FLOAT, 0},
                          {"e.exr", OIIO::TypeDesc::HALF, 5e-4f},          {"f.hdr", OIIO::TypeDesc::FLOAT, 1.0f / 128},
                          {"g.bmp", OIIO::TypeDesc::UINT8, 0.5f / 255},    {"h.jpg", OIIO::TypeDesc::UINT8, 0.1f}};
    for (const Case& c : cases) {
        const ImageF back = read_image(put_image(c.name, image, c.type), FirstRow::top);
        ASSERT_EQ(back.texels.size(), image.texels.size()) << c.name;
        for (std::size_t i = 0; i < image.texels.size(); ++i)
            EXPECT_NEAR(back.texels[i], image.texels[i], c.tolerance + 1e-6f) << c.name;
    }
    // The bytes tell the format, not the name.
    std::filesystem::rename(folder / "h.jpg", folder / "h.png");
    EXPECT_EQ(read_image_info(folder / "h.png").format, "jpeg");
    EXPECT_EQ(read_image(folder / "h.png").width, 8);
}

TEST_F(ImageFile, PalettesAreExpanded) {
    const std::string palette("\x0a\x0a\x0a\xc8\xc8\xc8\xff\x00\x40", 9);
    const Image8 image = read_image_8(put("p.png", palette_png(3, 2, palette, std::string("\0\1\2\1\1\0", 6))), FirstRow::top);
    ASSERT_GE(image.channels, 3);
    EXPECT_EQ(image(0, 0, 0), 10);
    EXPECT_EQ(image(1, 0, 1), 200);
    EXPECT_EQ(image(2, 0, 0), 255);
    EXPECT_EQ(image(2, 0, 1), 0);
    EXPECT_EQ(image(2, 0, 2), 64);
    EXPECT_EQ(image(0, 1, 0), 200);
}

TEST_F(ImageFile, ColoursUnderTransparencyAreKept) {
    Image8 image(1, 1, 4);
    image.texels = {200, 100, 50, 0};
    write_png(folder / "a.png", image, FirstRow::bottom);
    EXPECT_EQ(read_image_8(folder / "a.png").texels, image.texels);
}

TEST_F(ImageFile, FloatColoursAreEncoded) {
    ImageF image(2, 1, 4);
    image.texels = {0.5f, 1, 0, 0.5f, 9, -1, 0.2158605f, 1};
    const Image8 back = read_image_8(put_image("a.exr", image, OIIO::TypeDesc::FLOAT));
    EXPECT_EQ(back.texels, (std::vector<std::uint8_t>{188, 255, 0, 128, 255, 0, 128, 255}));
}

TEST_F(ImageFile, WhatIsNoImageIsAnError) {
    EXPECT_TRUE(has(refusal(folder / "none.png"), "there is no such file"));
    EXPECT_TRUE(has(refusal(folder), "it is a folder"));
    EXPECT_TRUE(has(refusal("/dev/null"), "not a plain file"));
    EXPECT_TRUE(has(refusal(put("empty.png", "")), "the file is empty"));
    EXPECT_TRUE(has(refusal(put("text.png", "this is a text that calls itself a picture\n")), "not an image"));
    EXPECT_TRUE(has(refusal(put("short.tga", "\0\0")), "cannot read image"));
    EXPECT_TRUE(has(refusal(put("x.png/inside.png", "").parent_path() / "inside.png"), "the file is empty"));
    EXPECT_TRUE(has(refusal(put("plain", "x") / "inside.png"), "there is no such file"));
    if (::geteuid() != 0) {
        const auto file = put("secret.png", "\x89PNG\r\n\x1a\n");
        std::filesystem::permissions(file, std::filesystem::perms::none);
        EXPECT_TRUE(has(refusal(file), "Permission denied"));
    }
}

// Every format cut at every eighth of its length, and with its middle overwritten: an error or a picture, never a crash; and a
// file without its second half is never a picture.
TEST_F(ImageFile, TruncatedAndScrambledFiles) {
    ImageF image(64, 64, 3);  // noise: nothing to compress, so that a cut file lacks texels
    std::mt19937 random(1);
    for (float& x : image.texels) x = static_cast<float>(random() % 65536) / 65535.0f;
    const std::pair<const char*, OIIO::TypeDesc> formats[] = {{"a.png", OIIO::TypeDesc::UINT16}, {"b.jpg", OIIO::TypeDesc::UINT8},
                                                              {"c.tga", OIIO::TypeDesc::UINT8},  {"d.exr", OIIO::TypeDesc::FLOAT},
                                                              {"e.tif", OIIO::TypeDesc::UINT8},  {"f.hdr", OIIO::TypeDesc::FLOAT},
                                                              {"g.bmp", OIIO::TypeDesc::UINT8},  {"h.webp", OIIO::TypeDesc::UINT8}};
    for (const auto& [name, type] : formats) {
        const std::string whole = bytes_of(put_image(name, image, type));
        ASSERT_GT(whole.size(), 200u);
        EXPECT_EQ(read_image(folder / name).width, 64) << name;
        for (std::size_t eighth = 0; eighth < 8; ++eighth) {
            const auto file = put(std::string("cut-") + name, whole.substr(0, whole.size() * eighth / 8));
            if (eighth <= 4)
                EXPECT_THROW(read_image(file), Error) << name << " cut at " << eighth << " eighths";
            else
                try {
                    read_image(file);
                } catch (const Error&) {
                }
        }
        for (std::size_t at = 4; at < whole.size(); at += whole.size() / 23) {
            std::string scrambled = whole;
            for (std::size_t i = at; i < std::min(at + 5, whole.size()); ++i)
                scrambled[i] = static_cast<char>(0xff - static_cast<unsigned char>(scrambled[i]));
            const auto file = put(std::string("scrambled-") + name, scrambled);
            try {
                read_image(file);
            } catch (const Error&) {
            }
        }
    }
}

TEST_F(ImageFile, BombsAreRefusedBeforeTheyAreAllocated) {
    const std::string message = refusal(put("bomb.png", palette_png(4, 1, std::string(3, '\0'), std::string(4, '\0'), 900000)));
    EXPECT_TRUE(has(message, "900000 x 1")) << message;
    // A DDS header that claims 16384 x 16384 and brings nothing.
    std::string dds("DDS \x7c\0\0\0", 8);
    dds.resize(128, '\0');
    const auto set = [&](std::size_t at, std::uint32_t x) { std::memcpy(&dds[at], &x, 4); };
    set(8, 0x1007), set(12, 16384), set(16, 16384), set(76, 32), set(80, 4), set(108, 0x1000);
    dds.replace(84, 4, "DXT5");
    EXPECT_TRUE(has(refusal(put("bomb.dds", dds)), "truncated"));
}

TEST_F(ImageFile, UnwritableOutputLeavesNothing) {
    const Image8 image(2, 2, 1);
    EXPECT_TRUE(has(message_of<Error>([&] { write_png(folder / "none" / "a.png", image, FirstRow::top); }), "No such file"));
    EXPECT_TRUE(has(message_of<Error>([&] { write_png(folder, image, FirstRow::top); }), "names a folder"));
    EXPECT_TRUE(has(message_of<Error>([&] { write_png(folder / "a.png", Image8(), FirstRow::top); }), "no texels"));
    EXPECT_TRUE(names().empty());
}

}  // namespace relievo::test
