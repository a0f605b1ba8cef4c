#include "assets/mesh_formats.h"
#include "assets/temporary_folder.h"
#include "core/error.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace relievo {
namespace {

using test::has;
using test::message_of;
using Indices = std::vector<std::uint32_t>;

Mesh ply(const std::string& bytes, int threads = 1) { return parse_ply(bytes, "test.ply", threads); }
std::string refusal(const std::string& bytes) {
    return message_of<Error>([&] { ply(bytes); });
}

// Bytes of a number, lowest first or last.
template <class T>
std::string raw(T value, bool big = false) {
    std::string bytes(reinterpret_cast<const char*>(&value), sizeof(T));
    if (big) std::reverse(bytes.begin(), bytes.end());
    return bytes;
}

const std::string plain = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
                          "property list uchar int vertex_indices\nend_header\n";
const std::string square = "0 0 0\n1 0 0\n1 1 0\n0 1 0\n";

TEST(MeshPly, text) {
    const Mesh mesh = ply(plain + square + "3 0 1 2\n3 0 2 3\n");
    EXPECT_EQ(mesh.positions, (std::vector<Vec3f>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2, 0, 2, 3}));
}

TEST(MeshPly, text_in_any_lines) {
    std::string returns = plain + square + "3 0 1 2\n3 0 2 3\n";
    std::replace(returns.begin(), returns.end(), '\n', '\r');
    for (const std::string& text : {plain + "0 0 0 1 0 0\n1 1 0\n0 1\n0 3 0 1 2 3 0 2 3", plain + "\n" + square + "\n 3 0 1 2 \n\n3 0 2 3\n\n", plain + square + "3 0 1 2\n3 0 2 3\nextra\n", returns})
        EXPECT_EQ(ply(text).indices, (Indices{0, 1, 2, 0, 2, 3}));
}

TEST(MeshPly, quads_and_triangles_mixed_over_many_pieces) {
    // Pieces are half a megabyte; the first quad comes late.
    std::string faces;
    std::size_t count = 0;
    while (faces.size() < 1600000) {
        faces += "3 0 1 2\n";
        ++count;
    }
    for (int i = 0; i < 100000; ++i) {
        faces += i % 3 == 0 ? "4 0 1 2 3\n" : "3 0 2 3\n";
        ++count;
    }
    std::string header = plain;
    header.replace(header.find("face 2"), 6, "face " + std::to_string(count));
    const Mesh one = ply(header + square + faces, 1), two = ply(header + square + faces, 2);
    EXPECT_EQ(one.faces(), count + 33334);
    EXPECT_EQ(one.indices, two.indices);
    EXPECT_EQ(Indices(one.indices.end() - 9, one.indices.end()), (Indices{0, 2, 3, 0, 1, 2, 0, 2, 3})) << "the last face is a square";
}

TEST(MeshPly, binary_of_both_byte_orders_any_types_and_any_order) {
    for (const bool big : {false, true}) {
        const std::string header = std::string("ply\nformat binary_") + (big ? "big" : "little") +
                                   "_endian 1.0\ncomment of no use\nobj_info neither\nelement face 1\nproperty uchar flag\nproperty list ushort short vertex_index\nproperty double weight\n"
                                   "element vertex 4\nproperty list uchar float others\nproperty uchar blue\nproperty double z\nproperty short x\nproperty int8 y\nproperty uchar red\nproperty uchar green\nend_header\n";
        std::string bytes = header + raw<std::uint8_t>(9) + raw<std::uint16_t>(4, big);
        for (const std::int16_t i : {0, 1, 2, 3}) bytes += raw(i, big);
        bytes += raw(0.5, big);
        for (int i = 0; i < 4; ++i) {
            bytes += raw<std::uint8_t>(static_cast<std::uint8_t>(i));
            for (int k = 0; k < i; ++k) bytes += raw(1.5f, big);
            bytes += raw<std::uint8_t>(255) + raw(-0.25 * i, big) + raw<std::int16_t>(static_cast<std::int16_t>(i == 1 || i == 2 ? -300 : 0), big) +
                     raw<std::int8_t>(i >= 2 ? -5 : 0) + raw<std::uint8_t>(0) + raw<std::uint8_t>(51);
        }
        const Mesh mesh = ply(bytes);
        EXPECT_EQ(mesh.positions[2], Vec3f(-300, -5, -0.5f));
        EXPECT_EQ(mesh.faces(), 2u);
        EXPECT_EQ(mesh.colours[3].z, 1.0f);
        EXPECT_NEAR(mesh.colours[3].y, 0.2f, 1e-7f);
        EXPECT_TRUE(has(refusal(bytes.substr(0, bytes.size() - 1)), "ends at byte"));
    }
}

TEST(MeshPly, binary_triangles_with_a_quad_among_them) {
    std::string bytes = plain;
    bytes.replace(bytes.find("ascii"), 5, "binary_little_endian");
    for (const Vec3f p : {Vec3f{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}) bytes += raw(p);
    const auto face = [&](std::initializer_list<std::int32_t> corners) {
        std::string f = raw(static_cast<std::uint8_t>(corners.size()));
        for (const std::int32_t c : corners) f += raw(c);
        return f;
    };
    EXPECT_EQ(ply(bytes + face({0, 1, 2}) + face({0, 2, 3})).indices, (Indices{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(ply(bytes + face({0, 1, 2, 3}) + face({0, 2, 3})).faces(), 3u);
    EXPECT_EQ(ply(bytes + face({0, 1, 2}) + face({0, 2, -1})).notes.size(), 1u);
}

TEST(MeshPly, strips_turn_every_second_triangle_and_start_again_at_minus_one) {
    const std::string header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n";
    EXPECT_EQ(ply(header + square + "8 0 1 2 3 -1 1 2 3\n").indices, (Indices{0, 1, 2, 2, 1, 3, 1, 2, 3}));
    const Mesh turning = ply(header + square + "6 0 1 2 2 3 0\n");
    EXPECT_EQ(turning.indices, (Indices{0, 1, 2, 3, 2, 0})) << "a repeated vertex turns a corner and counts for the turning";
    EXPECT_TRUE(turning.notes.empty());
}

TEST(MeshPly, ends_of_header_lines) {
    std::string bytes = plain;
    bytes.replace(bytes.find("ascii"), 5, "binary_little_endian");
    bytes.replace(bytes.find("face 2"), 6, "face 1");
    std::string data = raw(Vec3f(3.8581e-34f, 0, 0));  // its first byte is 10, a newline
    data[0] = '\n';
    data += raw(Vec3f(1, 0, 0)) + raw(Vec3f(1, 1, 0)) + raw(Vec3f(0, 1, 0)) + "\3" + raw(0) + raw(1) + raw(2);
    for (const std::string end : {"\n", "\r\n", "\r"}) {
        std::string header;
        for (const char c : bytes) header += c == '\n' ? end : std::string(1, c);
        const Mesh mesh = ply(header + data);
        EXPECT_EQ(mesh.positions[2], Vec3f(1, 1, 0));
        EXPECT_EQ(mesh.indices, (Indices{0, 1, 2}));
    }
}

TEST(MeshPly, attributes) {
    const Mesh mesh = ply("ply\nformat ascii 1.0\nA line without the word comment\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty float nx\nproperty float ny\n"
                          "property float nz\nproperty float s\nproperty float t\nproperty ushort red\nproperty ushort green\nproperty ushort blue\nelement face 1\n"
                          "property list uchar uint vertex_indices\nend_header\n0 0 0 0 0 2 0.25 0.75 65535 0 13107\n1 0 0 0 0 1 0 0 0 0 0\n0 1 0 0 0 1 0 0 0 0 0\n3 0 1 2\n");
    EXPECT_EQ(mesh.normals[0], Vec3f(0, 0, 1));
    EXPECT_EQ(mesh.uvs[0], Vec2f(0.25f, 0.75f));
    EXPECT_EQ(mesh.colours[0].x, 1.0f);
    EXPECT_NEAR(mesh.colours[0].z, 0.2f, 1e-7f);
    EXPECT_EQ(mesh.notes.size(), 1u);
}

TEST(MeshPly, promises_are_checked_against_the_size_before_anything_is_allocated) {
    std::string many = plain;
    many.replace(many.find("vertex 4"), 8, "vertex 1000000000");
    EXPECT_TRUE(has(refusal(many + square), "promises 1000000000 elements \"vertex\""));
    many = plain;
    many.replace(many.find("face 2"), 6, "face 1000000000");
    EXPECT_TRUE(has(refusal(many + square + "3 0 1 2\n"), "promises 1000000000 elements \"face\""));
    many.replace(many.find("ascii"), 5, "binary_big_endian");
    EXPECT_TRUE(has(refusal(many + std::string(48, '\0')), "promises"));
    EXPECT_TRUE(has(refusal(plain + square + "3 0 1 2\n1000000000 1 2 3\n"), "line 15: a list promises more values"));
}

TEST(MeshPly, what_cannot_be_understood_is_refused_with_its_place) {
    EXPECT_TRUE(has(refusal("ply\nformat ascii 1.0\nelement vertex 3\n"), "not ended by end_header"));
    EXPECT_TRUE(has(refusal("ply\nformat ascii 1.0\nend_header\n"), "no element"));
    EXPECT_TRUE(has(refusal("ply\nelement vertex 1\nproperty float x\nend_header\n0\n"), "no format"));
    EXPECT_TRUE(has(refusal("ply\nformat cuneiform 1.0\n"), "line 2 of the header"));
    EXPECT_TRUE(has(refusal("ply\nformat ascii 1.0\nproperty float x\n"), "line 3 of the header"));
    EXPECT_TRUE(has(refusal("ply\nformat ascii 1.0\nelement vertex -1\n"), "line 3 of the header"));
    EXPECT_TRUE(has(refusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty quaternion q\n"), "line 4 of the header"));
    EXPECT_TRUE(has(refusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty list float int q\n"), "line 4 of the header"));
    EXPECT_TRUE(has(refusal("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n"), "no x, y and z"));
    EXPECT_TRUE(has(refusal(plain + "0 0 0\n1 zero 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n"), "line 11: something that is no number"));
    EXPECT_TRUE(has(refusal(plain + square + "3 0 1 2\n"), "in the middle of its elements"));
    EXPECT_TRUE(has(refusal(plain + square + "3 0 1 9\n3 0 0 1\n"), "no face"));
}

}  // namespace
}  // namespace relievo
