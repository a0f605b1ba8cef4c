// Strands as files, read back by readers that know the formats from their specifications and nothing of the writer.
#include "assets/strand_file.h"

#include "core/error.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

namespace relievo::test {
namespace {

// Two strands, of one piece and of three.
StrandLines two_strands() {
    StrandLines lines;
    lines.pieces = {1, 3};
    for (int i = 0; i < 6; ++i) {
        lines.points.push_back({0.1f * static_cast<float>(i), 1e6f + static_cast<float>(i), -1e-7f * static_cast<float>(i)});
        lines.radii.push_back(0.01f * static_cast<float>(6 - i));
        lines.colours.push_back({0, 0.2140411f, static_cast<float>(i) / 5});  // 0.2140411 is sRGB 0.5
    }
    return lines;
}

template <class T>
T value(const std::string& bytes, std::size_t at) {
    T v;
    std::memcpy(&v, bytes.data() + at, sizeof v);
    return v;
}

class StrandFile : public InTemporaryFolder {};

TEST_F(StrandFile, HairHasItsHeaderAndItsArraysInOrder) {
    const StrandLines lines = two_strands();
    const std::string b = write_hair(lines);
    ASSERT_EQ(b.size(), 128 + 2 * 2 + 6 * (12 + 4 + 12u));
    EXPECT_EQ(b.substr(0, 4), "HAIR");
    EXPECT_EQ(value<std::uint32_t>(b, 4), 2u);
    EXPECT_EQ(value<std::uint32_t>(b, 8), 6u);
    EXPECT_EQ(value<std::uint32_t>(b, 12), 1u | 2u | 4u | 16u);  // segments, points, thickness and colours
    EXPECT_EQ(b[127], '\0');                                     // the information ends within its 88 bytes
    EXPECT_EQ(value<std::uint16_t>(b, 128), 1u);
    EXPECT_EQ(value<std::uint16_t>(b, 130), 3u);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(value<Vec3f>(b, 132 + 12 * i), lines.points[i]);
        EXPECT_EQ(value<float>(b, 132 + 72 + 4 * i), 2 * lines.radii[i]);
        EXPECT_NEAR(value<Vec3f>(b, 132 + 72 + 24 + 12 * i).y, 0.5f, 1e-5f);
    }
}

TEST_F(StrandFile, HairRefusesStrandsItsNumbersCannotTell) {
    StrandLines lines;
    lines.pieces = {65536};
    lines.points.resize(65537);
    lines.radii.resize(65537);
    lines.colours.resize(65537);
    EXPECT_THROW(write_hair(lines), Error);
}

TEST_F(StrandFile, ObjNamesEveryPointOfALineOnce) {
    const StrandLines lines = two_strands();
    std::istringstream text(write_strands_obj(lines));
    std::vector<Vec3f> points;
    std::vector<std::vector<int>> rows;
    for (std::string line; std::getline(text, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind == "v") {
            Vec3f p, c;
            words >> p.x >> p.y >> p.z >> c.x >> c.y >> c.z;
            EXPECT_TRUE(bool(words));
            EXPECT_NEAR(c.y, 0.5f, 1e-3f);
            points.push_back(p);
        } else if (kind == "l") {
            rows.emplace_back();
            for (int i; words >> i;) rows.back().push_back(i);
        } else {
            EXPECT_EQ(kind, "#");
        }
    }
    EXPECT_EQ(points, lines.points);
    EXPECT_EQ(rows, (std::vector<std::vector<int>>{{1, 2}, {3, 4, 5, 6}}));
}

TEST_F(StrandFile, PlyHasAnEdgeForEveryPiece) {
    const StrandLines lines = two_strands();
    const std::string b = write_strands_ply(lines), end = "end_header\n";
    const std::size_t body = b.find(end) + end.size();
    EXPECT_NE(b.find("element vertex 6\n"), std::string::npos);
    EXPECT_NE(b.find("element edge 4\n"), std::string::npos);
    ASSERT_EQ(b.size(), body + 6 * 19u + 4 * 8u);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(value<Vec3f>(b, body + 19 * i), lines.points[i]);
        EXPECT_EQ(value<float>(b, body + 19 * i + 12), lines.radii[i]);
        EXPECT_NEAR(value<std::uint8_t>(b, body + 19 * i + 17), 127.5, 0.6);
    }
    const int edges[4][2] = {{0, 1}, {2, 3}, {3, 4}, {4, 5}};
    for (std::size_t e = 0; e < 4; ++e)
        for (std::size_t k = 0; k < 2; ++k) EXPECT_EQ(value<int>(b, body + 6 * 19 + 8 * e + 4 * k), edges[e][k]);
}

TEST_F(StrandFile, TheEndingChoosesTheFormat) {
    for (const char* name : {"a.hair", "a.obj", "a.ply"}) {
        save_strands(folder / name, two_strands());
        EXPECT_GT(std::filesystem::file_size(folder / name), 100u) << name;
    }
    EXPECT_THROW(save_strands(folder / "a.abc", two_strands()), Error);
    EXPECT_FALSE(std::filesystem::exists(folder / "a.abc"));
    EXPECT_THROW(save_strands(folder / "missing" / "a.hair", two_strands()), Error);
}

}  // namespace
}  // namespace relievo::test
