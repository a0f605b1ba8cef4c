// Directions to texels and back, mip levels, and where a map's strands grow on surfaces whose answer is known.
#include "fur/direction_map.h"

#include "fur/evenness.h"
#include "fur/fur_map.h"
#include "fur/map_strands.h"
#include "mesh/made_up_scan.h"
#include "mesh/normals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace relievo {
namespace {

TEST(DirectionMap, TakesTheAxesToTheMiddlesOfTheFaces) {
    const Vec3d axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int f = 0; f < 6; ++f) {
        const MapPoint p = map_point(MapShape::cube, axes[f] * 3.0);
        EXPECT_EQ(p.face, f);
        EXPECT_EQ(p.u, 0.5);
        EXPECT_EQ(p.v, 0.5);
    }
    // As graphics devices have it: on +x, z runs to the left and y up; on +y, z runs down.
    EXPECT_LT(map_point(MapShape::cube, {1, 0, 0.5}).u, 0.5);
    EXPECT_LT(map_point(MapShape::cube, {1, 0.5, 0}).v, 0.5);
    EXPECT_GT(map_point(MapShape::cube, {0, 1, 0.5}).v, 0.5);
    EXPECT_GT(map_point(MapShape::cube, {0, 1, 0.5}).u, 0.499);
    // The disc: +z in the middle, what is square to it half the area out, -z at the rim.
    EXPECT_NEAR(map_point(MapShape::sphere, {0, 0, 1}).u, 0.5, 1e-12);
    EXPECT_NEAR(map_point(MapShape::sphere, {1, 0, 0}).u, 0.5 + std::sqrt(0.5) / 2, 1e-12);
    EXPECT_NEAR(map_point(MapShape::sphere, {0, 1e-6, -1}).v, 0, 1e-4);
}

TEST(DirectionMap, PointsAndDirectionsAreEachOthersInverse) {
    std::mt19937 random(5);
    std::normal_distribution<double> normal;
    for (const MapShapeEntry& shape : map_shapes)
        for (int i = 0; i < 1000; ++i) {
            const Vec3d d = normalize(Vec3d(normal(random), normal(random), normal(random)));
            const MapPoint p = map_point(shape.shape, d * 2.5);
            EXPECT_TRUE(p.face >= 0 && p.face < shape.faces && p.u >= 0 && p.u <= 1 && p.v >= 0 && p.v <= 1);
            EXPECT_LT(length(map_direction(shape.shape, p) - d), 1e-9);
        }
    EXPECT_EQ(map_direction(MapShape::sphere, {0, 0.02, 0.02}), Vec3d());
}

TEST(DirectionMap, MipLevelsKeepTheMeanAndNeverDarken) {
    const FurMap strands = fur_map({.width = 64, .height = 64, .density = 0.25});
    const DirectionMap map = direction_map(MapShape::cube, std::vector(6, strands.texels), false);
    for (const std::vector<Image8>& face : map.faces) {
        ASSERT_EQ(face.size(), 7u);
        for (const Image8& level : face)
            for (std::size_t t = 0; t < level.texels.size(); t += 4) ASSERT_EQ(level.texels[t], 255);
        EXPECT_NEAR(face.back().texels[3], 0.25 * 255, 4);  // half a step a level at most
    }
    // Black and white are 188 in the mean, as light adds up and its encoding does not.
    Image8 halves(2, 2, 4, 255);
    for (const int x : {0, 1}) std::fill_n(halves.at(x, 0), 3, std::uint8_t{0});
    EXPECT_EQ(direction_map(MapShape::sphere, {halves}, true).faces[0][1](0, 0, 0), 188);
}

TEST(DirectionMap, TheSpheresPictureIsCutToADisc) {
    const DirectionMap map = direction_map(MapShape::sphere, {Image8(64, 64, 4, 255)}, false);
    int open = 0;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) open += map.faces[0][0](x, y, 3) == 0;
    EXPECT_NEAR(open / 4096.0, 1 - 3.14159265 / 4, 0.01);
    EXPECT_EQ(map.faces[0][0](0, 0, 0), 255);
}

TEST(DirectionMap, SquaresOfPicturesKeepTheirLight) {
    Image8 picture(30, 20, 3);
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 30; ++x) std::fill_n(picture.at(x, y), 3, static_cast<std::uint8_t>(x < 15 ? 255 : 0));
    const Image8 small = square_picture(picture, 4);
    EXPECT_EQ(small(0, 0, 0), 255);
    EXPECT_EQ(small(1, 3, 2), 255);
    EXPECT_EQ(small(2, 0, 0), 0);
    EXPECT_EQ(small(0, 0, 3), 255);
    EXPECT_EQ(square_picture(picture, 1)(0, 0, 1), 188);
    const Image8 large = square_picture(Image8(1, 1, 1, 77), 8);
    EXPECT_EQ(large(7, 7, 2), 77);
}

Mesh ball() {
    Mesh mesh = made_up_scan({.faces = 6000, .relief = 0, .noise = 0});
    mesh.normals = mesh.positions;
    for (Vec3f& n : mesh.normals) n = normalize(n);
    return mesh;
}

DirectionMap strands_on(MapShape shape, int size, double density) {
    std::vector<Image8> faces;
    for (std::uint32_t f = 0; f < (shape == MapShape::cube ? 6u : 1u); ++f) faces.push_back(fur_map({.width = size, .height = size, .density = density, .seed = f}).texels);
    return direction_map(shape, faces, false);
}

TEST(MapStrands, GrowOnceOnABallWhateverLooksThemUp) {
    const Mesh mesh = ball();
    for (const MapShapeEntry& shape : map_shapes)
        for (const AddressingEntry& a : addressings) {
            // Strands are nearer to each other than what counts as distant.
            const int size = shape.shape == MapShape::cube ? 64 : 256;
            const DirectionMap map = strands_on(shape.shape, size, 0.2);
            std::size_t strands = 0;
            for (const auto& face : map.faces)
                for (std::size_t t = 3; t < face[0].texels.size(); t += 4) strands += face[0].texels[t] == 255;
            const MapStrands grown = map_strands(mesh, map, a.addressing);
            // A strand on an edge of two faces may be met twice or, where rounding parts them, not at all.
            EXPECT_NEAR(static_cast<double>(grown.roots.roots.size()), static_cast<double>(strands), 3) << shape.id << ' ' << a.id;
            for (std::size_t i = 0; i < grown.strands.size(); i += 97) {
                const MapPoint p = map_point(shape.shape, Vec3d(grown.roots.roots[i].position));
                const int x = static_cast<int>(p.u * size), y = static_cast<int>(p.v * size);
                EXPECT_EQ(grown.strands[i], static_cast<std::uint32_t>((p.face * size + y) * size + x));
            }
            const Evenness e = evenness(mesh, grown.roots, grown.strands, {.extent = 1});
            EXPECT_LT(e.shared_texel_area, 0.003);  // only strands met twice
            // Texels at a cube's corners are 5.2 times as small as in the middle of its faces; a ball's 5 % extremes are nearer together.
            if (shape.shape == MapShape::cube) { EXPECT_LT(e.density_p95_over_p5, 5); }
            EXPECT_GT(e.density_p95_over_p5, shape.shape == MapShape::cube ? 2 : 1);
        }
}

TEST(MapStrands, OfTwoBallsAreSharedByNormalsAndNotByPositions) {
    Mesh two = ball();
    const Mesh one = two;
    const auto n = static_cast<std::uint32_t>(one.positions.size());
    for (Vec3f& p : two.positions) p = p * 0.4f + Vec3f(-0.6f, 0, 0);
    for (const Vec3f& p : one.positions) two.positions.push_back(p * 0.4f + Vec3f(0.6f, 0, 0));
    two.normals.insert(two.normals.end(), one.normals.begin(), one.normals.end());
    for (const std::uint32_t i : one.indices) two.indices.push_back(i + n);
    const DirectionMap map = strands_on(MapShape::cube, 64, 0.2);
    const MapStrands by_normal = map_strands(two, map, Addressing::normal);
    EXPECT_NEAR(static_cast<double>(by_normal.roots.roots.size()), 2.0 * static_cast<double>(map_strands(one, map, Addressing::normal).roots.roots.size()), 6);
    EXPECT_GT(evenness(two, by_normal.roots, by_normal.strands, {.extent = 1}).shared_texel_area, 0.99);
    // From between them each ball is seen twice, front and back, and its strands are dense where it is seen edge on.
    const MapStrands by_position = map_strands(two, map, Addressing::position);
    const Evenness e = evenness(two, by_position.roots, by_position.strands, {.extent = 1});
    EXPECT_GT(e.shared_texel_area, 0.5);
    EXPECT_GT(e.density_p95_over_p5, 4);
}

TEST(MapStrands, AreTheSameForAnyThreadsAndNoneOnAFlatSheetByItsNormal) {
    const Mesh mesh = ball();
    const DirectionMap map = strands_on(MapShape::cube, 32, 0.5);
    const MapStrands one = map_strands(mesh, map, Addressing::normal_plus_position, 1), three = map_strands(mesh, map, Addressing::normal_plus_position, 3);
    ASSERT_EQ(one.strands, three.strands);
    for (std::size_t i = 0; i < one.strands.size(); ++i) ASSERT_EQ(one.roots.roots[i].position, three.roots.roots[i].position);
    Mesh sheet;
    sheet.positions = {{-1, -1, 0.5f}, {1, -1, 0.5f}, {0, 1, 0.5f}};
    sheet.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    sheet.indices = {0, 1, 2};
    EXPECT_TRUE(map_strands(sheet, map, Addressing::normal).strands.empty());
    EXPECT_FALSE(map_strands(sheet, map, Addressing::normal_plus_position).strands.empty());
    // In a plane through the origin the sum of both only turns around the normal: a line of directions, no area of the map.
    for (Vec3f& p : sheet.positions) p.z = 0;
    EXPECT_TRUE(map_strands(sheet, map, Addressing::normal_plus_position).strands.empty());
}

}  // namespace
}  // namespace relievo
