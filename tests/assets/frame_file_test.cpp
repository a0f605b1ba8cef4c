#include "assets/frame_file.h"

#include "assets/image_file.h"
#include "core/error.h"
#include "temporary_folder.h"

#include <OpenImageIO/imageio.h>

#include <limits>

namespace relievo::test {

using FrameFile = InTemporaryFolder;

TEST_F(FrameFile, SrgbTransferMeetsTheStandard) {
    // Code values of IEC 61966-2-1 computed by hand from the two branches.
    EXPECT_EQ(srgb_from_linear(0), 0);
    EXPECT_EQ(srgb_from_linear(1), 255);
    EXPECT_EQ(srgb_from_linear(0.5f), 188);        // 0.735357
    EXPECT_EQ(srgb_from_linear(0.2158605f), 128);  // the linear value of code 128
    EXPECT_EQ(srgb_from_linear(0.0031308f), 10);
    EXPECT_EQ(srgb_from_linear(0.001f), 3);
    EXPECT_EQ(srgb_from_linear(-1), 0);
    EXPECT_EQ(srgb_from_linear(7), 255);
    EXPECT_EQ(srgb_from_linear(std::numeric_limits<float>::quiet_NaN()), 0);
    EXPECT_EQ(srgb_from_linear(std::numeric_limits<float>::infinity()), 255);
}

TEST_F(FrameFile, PngKeepsTheTopRowOnTop) {
    ImageF colour(3, 2, 3);
    colour(0, 0, 0) = 1;
    colour(2, 1, 2) = 0.5f;
    write_frame_png(folder / "f.png", colour);
    const Image8 back = read_image_8(folder / "f.png", FirstRow::top);
    ASSERT_EQ(back.channels, 3);
    EXPECT_EQ(back(0, 0, 0), 255);
    EXPECT_EQ(back(2, 1, 2), 188);
    EXPECT_EQ(back(0, 1, 0), 0);
}

TEST_F(FrameFile, ExrHoldsEveryPlaneByName) {
    Frame frame(4, 3);
    float x = -5.25f;
    for (ImageF* plane : {&frame.colour, &frame.hit_uv, &frame.hit_height, &frame.normal, &frame.shadow, &frame.fetches})
        for (float& v : plane->texels) v = x += 0.125f;
    frame.coverage(1, 0) = static_cast<std::uint8_t>(Coverage::hit);
    frame.coverage(2, 2) = static_cast<std::uint8_t>(Coverage::no_hit);
    write_frame_exr(folder / "f.exr", frame);

    const auto input = OIIO::ImageInput::open((folder / "f.exr").string());
    ASSERT_TRUE(input);
    const OIIO::ImageSpec spec = input->spec();
    EXPECT_EQ(spec.format, OIIO::TypeDesc::FLOAT);
    ASSERT_EQ(spec.nchannels, 12);
    std::vector<float> texels(static_cast<std::size_t>(4 * 3 * 12));
    ASSERT_TRUE(input->read_image(0, 0, 0, 12, OIIO::TypeDesc::FLOAT, texels.data()));
    const auto value = [&](const char* name, int i, int j) {
        return texels.at(static_cast<std::size_t>((j * 4 + i) * 12 + spec.channelindex(name)));
    };
    for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 4; ++i) {
            EXPECT_EQ(value("R", i, j), frame.colour(i, j, 0));
            EXPECT_EQ(value("G", i, j), frame.colour(i, j, 1));
            EXPECT_EQ(value("B", i, j), frame.colour(i, j, 2));
            EXPECT_EQ(value("hit.U", i, j), frame.hit_uv(i, j, 0));
            EXPECT_EQ(value("hit.V", i, j), frame.hit_uv(i, j, 1));
            EXPECT_EQ(value("height", i, j), frame.hit_height(i, j));
            EXPECT_EQ(value("normal.X", i, j), frame.normal(i, j, 0));
            EXPECT_EQ(value("normal.Y", i, j), frame.normal(i, j, 1));
            EXPECT_EQ(value("normal.Z", i, j), frame.normal(i, j, 2));
            EXPECT_EQ(value("fetches", i, j), frame.fetches(i, j));
            EXPECT_EQ(value("mask", i, j), frame.coverage(i, j));
            EXPECT_EQ(value("shadow", i, j), frame.shadow(i, j));
        }
}

TEST_F(FrameFile, TheSameFrameGivesTheSameBytes) {
    const Frame frame(16, 9);
    write_frame_png(folder / "a.png", frame.colour);
    write_frame_png(folder / "b.png", frame.colour);
    write_frame_exr(folder / "a.exr", frame);
    write_frame_exr(folder / "b.exr", frame);
    EXPECT_EQ(bytes_of(folder / "a.png"), bytes_of(folder / "b.png"));
    EXPECT_EQ(bytes_of(folder / "a.exr"), bytes_of(folder / "b.exr"));
}

TEST_F(FrameFile, NothingIsLeftWhereItCannotWrite) {
    const Frame frame(2, 2);
    EXPECT_TRUE(has(message_of<Error>([&] { write_frame_png(folder / "none" / "f.png", frame.colour); }), "No such file"));
    EXPECT_TRUE(has(message_of<Error>([&] { write_frame_exr("/proc/f.exr", frame); }), "/proc/f.exr"));
    EXPECT_THROW(write_frame_exr(folder / "f.exr", Frame(0, 0)), Error);
    EXPECT_TRUE(names().empty());
}

}  // namespace relievo::test
