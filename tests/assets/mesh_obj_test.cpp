#include "assets/mesh_formats.h"
#include "assets/temporary_folder.h"
#include "core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace relievo {
namespace {

using test::has;
using test::message_of;
using Indices = std::vector<std::uint32_t>;

Mesh obj(const std::string& text, int threads = 1) { return parse_obj(text, "test.obj", threads); }
std::string refusal(const std::string& text) {
    return message_of<Error>([&] { obj(text); });
}

const std::string corner = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST(MeshObj, positions_and_faces) {
    const Mesh mesh = obj("# comment\no thing\nv 0 0 0\nv 1 0 0.5\n\nv\t0  1\t0 \ng part\ns off\nusemtl m\nf 1 2 3\n");
    ASSERT_EQ(mesh.positions.size(), 3u);
    EXPECT_EQ(mesh.positions[1], Vec3f(1, 0, 0.5f));
    EXPECT_EQ(mesh.positions[2], Vec3f(0, 1, 0));
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2}));
    EXPECT_TRUE(mesh.normals.empty() && mesh.uvs.empty() && mesh.colours.empty() && mesh.notes.empty());
}

TEST(MeshObj, every_kind_of_line_end) {
    for (const std::string end : {"\n", "\r\n", "\r"})
        for (const bool last : {true, false}) {
            std::string text = "v 0 0 0" + end + "v 1 0 0" + end + "v 0 1 0" + end + "f 1 2 3" + (last ? end : "");
            EXPECT_EQ(obj(text).indices, (Indices{0, 1, 2}));
        }
    EXPECT_EQ(obj("\xef\xbb\xbf" + corner + "f 1 2 3").indices, (Indices{0, 1, 2})) << "a byte order mark of UTF-8";
}

TEST(MeshObj, every_form_of_a_face) {
    for (const char* face : {"f 1 2 3", "f 1/1 2/1 3/1", "f 1//1 2//1 3//1", "f 1/1/1 2/1/1 3/1/1", "f 1// 2// 3//", "f 1/ 2/ 3/", "f 1/1/ 2/1/ 3/1/", "f  1 2\t3 # last", "f -3 -2 -1",
                             "f -3/-1/-1 2/1/-1 -1/-1/1", "f +1 +2 +3"}) {
        const Mesh mesh = obj(corner + "vt 0.25 0.75\nvn 0 0 1\n" + face + "\n");
        EXPECT_EQ(mesh.indices, (Indices{0, 1, 2})) << face;
        EXPECT_TRUE(mesh.notes.empty()) << face;
        const bool uv = std::string(face).find("/1") != std::string::npos && std::string(face).find("//1") == std::string::npos;
        EXPECT_EQ(mesh.uvs.empty(), !uv && !has(face, "/-1/")) << face;
        if (!mesh.uvs.empty()) {
            EXPECT_EQ(mesh.uvs[2], Vec2f(0.25f, 0.75f)) << face;
        }
        if (!mesh.normals.empty()) {
            EXPECT_EQ(mesh.normals[0], Vec3f(0, 0, 1)) << face;
        }
    }
}

TEST(MeshObj, negative_indices_count_from_the_line_they_stand_on) {
    const Mesh mesh = obj(corner + "f -3 -2 -1\nv 5 0 0\nv 6 0 0\nf -1 -2 -3\nf -5 -4 -1\nf -6 1 2\n");
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2, 4, 3, 2, 0, 1, 4}));
    ASSERT_EQ(mesh.notes.size(), 1u);
    EXPECT_EQ(mesh.notes[0], "1 face was skipped: it names a vertex that the file does not hold.");
}

TEST(MeshObj, a_vertex_per_combination_and_no_more) {
    // Two triangles that share an edge, with a seam of texture coordinates along it.
    const Mesh mesh = obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0.5 0.5\nf 1/1 2/2 3/3\nf 1/4 3/3 4/1\n");
    ASSERT_EQ(mesh.positions.size(), 5u);
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2, 4, 2, 3}));
    EXPECT_EQ(mesh.positions[4], mesh.positions[0]);
    EXPECT_EQ(mesh.uvs[0], Vec2f(0, 0));
    EXPECT_EQ(mesh.uvs[4], Vec2f(0.5f, 0.5f));
}

TEST(MeshObj, many_combinations_of_one_vertex_are_found_again) {
    std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\n", faces;
    for (int i = 1; i <= 3000; ++i) {
        text += "vt " + std::to_string(i) + "\n";
        faces += "f 1/" + std::to_string(i) + " 2/1 3/1\n";
    }
    const Mesh mesh = obj(text + faces + faces);
    EXPECT_EQ(mesh.positions.size(), 3002u);
    EXPECT_EQ(mesh.faces(), 6000u);
    for (std::size_t i = 0; i < 3000; ++i) {
        EXPECT_EQ(mesh.uvs[mesh.indices[3 * i]].x, static_cast<float>(i + 1));
        EXPECT_EQ(mesh.indices[3 * i], mesh.indices[3 * (i + 3000)]);
    }
}

TEST(MeshObj, polygons_are_triangles_and_concave_ones_keep_their_area) {
    const Mesh mesh = obj("v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\n");
    ASSERT_EQ(mesh.faces(), 3u);
    double area = 0;
    for (std::size_t i = 0; i < 9; i += 3) {
        const Vec3d a(mesh.positions[mesh.indices[i]]), b(mesh.positions[mesh.indices[i + 1]]), c(mesh.positions[mesh.indices[i + 2]]);
        const Vec3d n = cross(b - a, c - a);
        EXPECT_GE(n.z, 0);
        area += length(n) / 2;
    }
    EXPECT_NEAR(area, 10.0, 1e-9);
}

TEST(MeshObj, lines_go_on_behind_a_backslash) {
    EXPECT_EQ(obj("v 0 0 \\\n0\nv 1 \\\r\n 0 0\nv 0 1 0\nf 1 \\\n2 \\\n3\n").indices, (Indices{0, 1, 2}));
    EXPECT_EQ(obj(corner + "f 1 2 \\\n3").indices, (Indices{0, 1, 2})) << "into a last line without an end";
    EXPECT_EQ(obj(corner + "# C:\\models\\\nf 1 2 3\n").indices, (Indices{0, 1, 2})) << "but not in comments";
    EXPECT_TRUE(has(refusal(corner + "f 1 2 \\\n"), "no vertex number"));
}

TEST(MeshObj, vertex_colours_and_weights) {
    const Mesh mesh = obj("v 0 0 0 1 0.5 0\nv 1 0 0\nv 0 1 0 nan nan nan\nv 0 0 1 1\nf 1 2 3\nf 1 2 4\n");
    ASSERT_EQ(mesh.colours.size(), 4u);
    EXPECT_EQ(mesh.colours[0], Vec3f(1, 0.5f, 0));
    EXPECT_EQ(mesh.colours[1], Vec3f(1, 1, 1));
    EXPECT_EQ(mesh.colours[2], Vec3f(1, 1, 1));
    EXPECT_EQ(mesh.notes, std::vector<std::string>{"1 vertex colour is not finite: taken for white."});
    const Mesh bytes = obj("v 0 0 0 255 51 0\nv 1 0 0 0 0 0\nv 0 1 0 0 0 0\nf 1 2 3\n");
    EXPECT_NEAR(bytes.colours[0].y, 0.2f, 1e-6f);
    EXPECT_EQ(bytes.notes.size(), 1u);
}

TEST(MeshObj, broken_faces_are_skipped_and_counted) {
    const Mesh mesh = obj(corner + "v nan 0 0\nv 1e99 0 0\nf 1 2 3\nf 1 2\nf 1 1 2\nf 0 1 2\nf 1 2 9\nf 1 2 99999999999999999999\nf 1 2 4\nf 1 2 3 5\nl 1 2\np 1\n");
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2}));
    EXPECT_EQ(mesh.positions.size(), 3u) << "vertices that are not finite go";
    std::string notes;
    for (const std::string& note : mesh.notes) notes += note + "\n";
    EXPECT_TRUE(has(notes, "3 faces were skipped: they name vertices that the file does not hold.")) << notes;
    EXPECT_TRUE(has(notes, "2 faces were skipped: they have fewer than three distinct vertices.")) << notes;
    EXPECT_TRUE(has(notes, "2 vertices were left out")) << notes;
    EXPECT_TRUE(has(notes, "2 faces were skipped: they touch a vertex whose position is not finite.")) << notes;
    EXPECT_TRUE(has(notes, "2 lines, points or curves were passed over")) << notes;
}

TEST(MeshObj, corners_may_name_attributes_that_are_not_there) {
    const Mesh mesh = obj(corner + "vt 1 1\nf 1/1 2/7 3/1\n");
    EXPECT_EQ(mesh.uvs[1], Vec2f(0, 0));
    EXPECT_EQ(mesh.notes.size(), 1u);
}

TEST(MeshObj, normals_become_unit_vectors) {
    const Mesh mesh = obj(corner + "vn 0 0 2\nvn 0 0 0\nvn nan 0 0\nf 1//1 2//2 3//3\n");
    EXPECT_EQ(mesh.normals[0], Vec3f(0, 0, 1));
    EXPECT_EQ(mesh.normals[1], Vec3f(0, 0, 0));
    EXPECT_EQ(mesh.normals[2], Vec3f(0, 0, 0));
}

TEST(MeshObj, what_cannot_be_understood_is_refused_with_its_line) {
    EXPECT_TRUE(has(refusal("v 0 0 0\nv 1 x 0\n"), "test.obj: line 2: a vertex has something that is no number"));
    EXPECT_TRUE(has(refusal("v 0 0 0\n\nv 1 0"), "line 3: a vertex has fewer than three"));
    EXPECT_TRUE(has(refusal(corner + "f 1 2 a\n"), "line 4: a face"));
    EXPECT_TRUE(has(refusal(corner + "f 1 2 3.5\n"), "line 4: a face"));
    EXPECT_TRUE(has(refusal(corner + "f 1/1/1/1 2 3\n"), "line 4: a face"));
    EXPECT_TRUE(has(refusal(corner + "vn 1 2\n"), "line 4: a normal"));
    EXPECT_TRUE(has(refusal(corner + "vt x\n"), "line 4: a texture"));
    EXPECT_TRUE(has(refusal("v 0,5 0 0\n"), "line 1"));
    EXPECT_TRUE(has(refusal("v 0 0 0\rv 1 x 0\r"), "line 2")) << "lines of an old Macintosh are counted too";
    EXPECT_TRUE(has(refusal(corner), "3 vertices and no face"));
    EXPECT_TRUE(has(refusal("hello\n"), "no vertex"));
    EXPECT_TRUE(has(refusal(std::string("\xff\xfev\0 \0", 6)), "UTF-16"));
    EXPECT_TRUE(has(refusal(std::string("v 0 0\0", 6)), "byte 5 is 0"));
}

// Pieces are half a megabyte: a text of several, with every kind of line near their ends, must come out as if it were one.
TEST(MeshObj, long_texts_come_out_the_same_on_any_number_of_threads) {
    std::mt19937 random(3);
    std::string text;
    std::vector<Vec3f> positions;
    Indices expected;
    while (text.size() < 3u << 20) {
        const float x = static_cast<float>(random() % 1000) / 8;
        positions.emplace_back(x, static_cast<float>(positions.size()), 0.5f);
        text += "v " + std::to_string(x) + (random() % 5 == 0 ? " \\\n" : " ") + std::to_string(positions.size() - 1) + " 0.5\n";
        const auto n = static_cast<std::uint32_t>(positions.size());
        if (n < 5) continue;
        const auto a = static_cast<std::uint32_t>(random() % (n - 4)), far = n - 1 - a;
        if (random() % 2)
            text += "f -1 " + std::to_string(a + 1) + " -2\n";
        else
            text += "f " + std::to_string(n) + " -" + std::to_string(far + 1) + " \\\n  " + std::to_string(n - 1) + "\n";
        expected.insert(expected.end(), {n - 1, a, n - 2});
    }
    for (const int threads : {1, 2, 5}) {
        const Mesh mesh = obj(text, threads);
        ASSERT_EQ(mesh.positions.size(), positions.size());
        EXPECT_EQ(mesh.indices, expected);
        for (std::size_t i = 0; i < positions.size(); ++i) ASSERT_EQ(mesh.positions[i], positions[i]) << i;
    }
    // A mistake far behind is found with its line.
    const auto lines = 1 + std::count(text.begin(), text.end(), '\n');
    EXPECT_TRUE(has(refusal(text + "v 1 2 three\n"), "line " + std::to_string(lines) + ":"));
}

}  // namespace
}  // namespace relievo
