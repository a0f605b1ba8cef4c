// OFF, STL and glTF.
#include "assets/mesh_formats.h"
#include "assets/temporary_folder.h"
#include "core/error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace relievo {
namespace {

using test::has;
using test::message_of;
using Indices = std::vector<std::uint32_t>;

Mesh off(const std::string& text) { return parse_off(text, "test.off", 1); }
Mesh stl(const std::string& bytes) { return parse_stl(bytes, "test.stl", 1); }

Mesh gltf(const std::string& bytes) {
    return parse_gltf(bytes, "test.gltf", [](const std::string& uri) -> std::string { throw Error("read", uri, "it is not there"); }, 1);
}

template <class T>
std::string raw(T value) {
    return {reinterpret_cast<const char*>(&value), sizeof(T)};
}

TEST(MeshOff, plain_and_without_a_keyword) {
    const std::string body = "4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
    for (const std::string& text : {"OFF\n" + body, "# first\nOFF # second\n\n" + body, "OFF " + body, body, "OFF\r\n" + body, "OFF\n4 2\n" + body.substr(6)}) {
        EXPECT_EQ(off(text).indices, (Indices{0, 1, 2, 0, 2, 3})) << text;
        EXPECT_TRUE(off(text).colours.empty());
    }
}

TEST(MeshOff, what_vertices_carry) {
    const Mesh colours = off("COFF\n3 1 0\n0 0 0 255 51 0 255 # whole numbers\n1 0 0 0.5 0.25 0#real ones\n0 1 0\n3 0 1 2 0.5 0.5 0.5\n");
    EXPECT_NEAR(colours.colours[0].y, 0.2f, 1e-7f);
    EXPECT_EQ(colours.colours[1], Vec3f(0.5f, 0.25f, 0));
    EXPECT_EQ(colours.colours[2], Vec3f(1, 1, 1));
    const Mesh all = off("STCNOFF\n3 1 0\n0 0 0 0 0 1 1 1 1 1 0.25 0.75\n1 0 0 0 0 1 1 1 1 1 0 0\n0 1 0 0 0 1 1 1 1 1 0 0\n3 0 1 2\n");
    EXPECT_EQ(all.normals[0], Vec3f(0, 0, 1));
    EXPECT_EQ(all.uvs[0], Vec2f(0.25f, 0.75f));
    EXPECT_EQ(all.colours.size(), 3u);
}

TEST(MeshOff, refusals) {
    const auto refusal = [](const std::string& text) { return message_of<Error>([&] { off(text); }); };
    EXPECT_TRUE(has(refusal("OFF\n353535235358 6 0\n0 0 0\n"), "line 2: it promises 353535235358 vertices"));
    EXPECT_TRUE(has(refusal("OFF\n3 1000000000 0\n0 0 0\n1 0 0\n0 1 0\n"), "line 2: it promises"));
    EXPECT_TRUE(has(refusal("OFF\n3 1 0\n0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n"), "line 4: something that is no number"));
    EXPECT_TRUE(has(refusal("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n999 0 1 2\n"), "line 6"));
    EXPECT_TRUE(has(refusal("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1"), "in the middle"));
    EXPECT_TRUE(has(refusal("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 7\n"), "no face"));
    EXPECT_TRUE(has(refusal("4OFF\n1 1 0\n"), "other than three dimensions"));
    EXPECT_TRUE(has(refusal(std::string("OFF BINARY\n\0\0\0\3", 15)), "binary form"));
    EXPECT_TRUE(has(refusal("OFF\n-3 1 0\n"), "negative"));
}

std::string binary_stl(std::uint32_t promised, std::uint32_t held, std::string start = {}) {
    start.resize(80, ' ');
    std::string bytes = start + raw(promised);
    for (std::uint32_t i = 0; i < held; ++i)
        bytes += raw(Vec3f(0, 0, 1)) + raw(Vec3f(0, 0, static_cast<float>(i))) + raw(Vec3f(1, 0, 0)) + raw(Vec3f(0, 1, 0)) + raw(std::uint16_t{7});
    return bytes;
}

TEST(MeshStl, binary_whatever_it_begins_with) {
    for (const char* start : {"", "solid of a careless exporter", "solid\n facet normal"}) {
        const Mesh mesh = stl(binary_stl(2, 2, start));
        EXPECT_EQ(mesh.indices, (Indices{0, 1, 2, 3, 4, 5})) << start;
        EXPECT_EQ(mesh.positions[3], Vec3f(0, 0, 1)) << start;
    }
    EXPECT_EQ(stl(binary_stl(2, 2) + "more").notes.size(), 1u);
    EXPECT_TRUE(has(message_of<Error>([] { stl(binary_stl(1000000000, 2)); }), "promises 1000000000 triangles, its 184 bytes hold 2"));
    EXPECT_TRUE(has(message_of<Error>([] { stl(binary_stl(0, 0)); }), "no face"));
}

TEST(MeshStl, text) {
    const std::string facet = "facet normal 0 0 1\n outer loop\n  vertex 0 0 0\n  vertex 1e0 0 0\n  VERTEX 0 1 -0.5\n endloop\nendfacet\n";
    const Mesh mesh = stl("solid a name with facet in it\n" + facet + "endsolid\nsolid\n" + facet + "endsolid");
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2, 3, 4, 5}));
    EXPECT_EQ(mesh.positions[2], Vec3f(0, 1, -0.5f));
    const auto refusal = [](const std::string& text) { return message_of<Error>([&] { stl(text); }); };
    EXPECT_TRUE(has(refusal("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n"), "line 4: a vertex"));
    EXPECT_TRUE(has(refusal("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\n"), "in the middle of a triangle"));
    EXPECT_TRUE(has(refusal("solid\nfacet\nnonsense\n"), "line 3"));
    EXPECT_TRUE(has(refusal("solid Empty\nendsolid Empty"), "no face"));
}

std::string base64(std::string_view bytes) {
    const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    unsigned bits = 0;
    int held = 0;
    for (const char c : bytes) {
        bits = bits << 8 | static_cast<unsigned char>(c);
        for (held += 8; held >= 6; held -= 6) text += letters[bits >> (held - 6) & 63];
    }
    if (held > 0) text += letters[bits << (6 - held) & 63];
    return text;
}

// A scene around one buffer: a triangle (0,0,0) (1,0,0) (0,1,0) as floats, then indices 0 1 2 as bytes.
std::string scene(const std::string& nodes, const std::string& accessors, const std::string& meshes, const std::string& rest = {}) {
    const std::string data = raw(Vec3f(0, 0, 0)) + raw(Vec3f(1, 0, 0)) + raw(Vec3f(0, 1, 0)) + std::string("\0\1\2\0", 4);
    return R"({"asset":{"version":"2.0"},"nodes":)" + nodes + R"(,"accessors":)" + accessors + R"(,"meshes":)" + meshes +
           R"(,"bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":4}],"buffers":[{"byteLength":40,"uri":"data:x;base64,)" + base64(data) + "\"}]" + rest + "}";
}
const std::string accessors = R"([{"bufferView":0,"componentType":5126,"type":"VEC3","count":3},{"bufferView":1,"componentType":5121,"type":"SCALAR","count":3}])";
const std::string meshes = R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])";

TEST(MeshGltf, nodes_move_turn_scale_and_mirror) {
    const Mesh mesh = gltf(scene(R"([{"translation":[10,0,0],"children":[1]},{"mesh":0,"rotation":[0,0,0.70710678,0.70710678],"scale":[2,1,1]},{"mesh":0,"matrix":[-1,0,0,0,0,1,0,0,0,0,1,0,0,0,5,1]}])",
                                 accessors, meshes, R"(,"scene":0,"scenes":[{"nodes":[0,2]}])"));
    ASSERT_EQ(mesh.positions.size(), 6u);
    // x doubled, then turned by 90 degrees about z, then moved.
    EXPECT_NEAR(mesh.positions[1].x, 10, 1e-6);
    EXPECT_NEAR(mesh.positions[1].y, 2, 1e-6);
    EXPECT_NEAR(mesh.positions[2].x, 9, 1e-6);
    EXPECT_EQ(mesh.positions[4], Vec3f(-1, 0, 5));
    EXPECT_EQ(mesh.indices, (Indices{0, 1, 2, 3, 5, 4})) << "a mirror turns faces round";
}

TEST(MeshGltf, strips_fans_sparse_and_normalised_accessors) {
    const std::string more = R"([{"bufferView":0,"componentType":5126,"type":"VEC3","count":3},{"bufferView":1,"componentType":5121,"type":"SCALAR","count":3},
        {"componentType":5126,"type":"VEC3","count":4,"sparse":{"count":2,"indices":{"bufferView":1,"byteOffset":1,"componentType":5121},"values":{"bufferView":0,"byteOffset":12}}},
        {"bufferView":1,"componentType":5120,"normalized":true,"type":"VEC3","count":1}])";
    const Mesh strip = gltf(scene(R"([{"mesh":0}])", more, R"([{"primitives":[{"attributes":{"POSITION":2},"mode":5},{"attributes":{"POSITION":2},"mode":6},{"attributes":{"POSITION":0},"mode":0}]}])"));
    EXPECT_EQ(strip.positions[1], Vec3f(1, 0, 0)) << "replaced by the sparse part";
    EXPECT_EQ(strip.positions[2], Vec3f(0, 1, 0));
    EXPECT_EQ(strip.positions[3], Vec3f(0, 0, 0)) << "zero otherwise";
    EXPECT_EQ(strip.indices, (Indices{0, 1, 2, 2, 1, 3, 4, 5, 6, 4, 6, 7}));
    EXPECT_EQ(strip.notes.size(), 1u) << "points are passed over";
}

TEST(MeshGltf, a_bad_index_costs_its_face_only) {
    std::string text = scene(R"([{"mesh":0}])", accessors, R"([{"primitives":[{"attributes":{"POSITION":0},"indices":1},{"attributes":{"POSITION":0}}]}])");
    text.replace(text.find("AAECAA"), 6, "AAEJAA");  // 0 1 9
    const Mesh mesh = gltf(text);
    EXPECT_EQ(mesh.faces(), 1u);
    EXPECT_EQ(mesh.notes.size(), 1u);
}

TEST(MeshGltf, refusals) {
    const auto refusal = [](const std::string& text) { return message_of<Error>([&] { gltf(text); }); };
    const std::string node = R"([{"mesh":0}])";
    const auto with = [&](const std::string& from, const std::string& to) {
        std::string text = scene(node, accessors, meshes, R"(,"scene":0,"scenes":[{"nodes":[0]}])");
        text.replace(text.find(from), from.size(), to);
        return text;
    };
    EXPECT_EQ(gltf(with("\"scene\":0", "\"scene\":0")).faces(), 1u);
    EXPECT_TRUE(has(refusal("{ \"a\": 1, x"), "byte 11: it is no JSON"));
    EXPECT_TRUE(has(refusal("[1,2]"), "no glTF"));
    EXPECT_TRUE(has(refusal(with("\"2.0\"", "\"1.0\"")), "version 1.0"));
    EXPECT_TRUE(has(refusal(with("\"count\":3", "\"count\":1000000000")), "promises 1000000000 elements"));
    EXPECT_TRUE(has(refusal(with("\"byteLength\":40", "\"byteLength\":41")), "promises 41 bytes and has 40"));
    EXPECT_TRUE(has(refusal(with("\"byteLength\":36", "\"byteLength\":360")), "bufferView 0 ends at byte 360"));
    EXPECT_TRUE(has(refusal(with("\"mesh\":0", "\"mesh\":7")), "meshes has no entry 7"));
    EXPECT_TRUE(has(refusal(with("\"mesh\":0", "\"children\":[0]")), "reached twice"));
    EXPECT_TRUE(has(refusal(with("\"scene\":0", "\"scene\":\"first\"")), "string where a number belongs"));
    EXPECT_TRUE(has(refusal(with("5126", "5124")), "unknown component type"));
    EXPECT_TRUE(has(refusal(with("data:x;base64,", "other.bin?")), "not there"));
    EXPECT_TRUE(has(refusal(with("\"scene\":0", "\"extensionsRequired\":[\"KHR_draco_mesh_compression\"],\"scene\":0")), "KHR_draco_mesh_compression"));
    EXPECT_TRUE(has(refusal(with("\"attributes\":{\"POSITION\":0}", "\"attributes\":{}")), "POSITION"));
    EXPECT_TRUE(has(refusal(scene(node, R"([{"componentType":5126,"type":"VEC3","count":1000000},{"bufferView":1,"componentType":5121,"type":"SCALAR","count":3}])", meshes)), "no data"));
    EXPECT_TRUE(has(refusal("glTF"), "within its header"));
    EXPECT_TRUE(has(refusal("glTF" + raw(1u) + raw(20u) + raw(0u) + raw(0u)), "version 1"));
    EXPECT_TRUE(has(refusal("glTF" + raw(2u) + raw(20u) + raw(99u) + "JSON"), "byte 12: a chunk promises 99 bytes"));
}

TEST(MeshGltf, refusals_name_the_byte_at_which_the_value_stands) {
    // What is wrong is put last among values that look like it: spaces, escaped names, names that come twice.
    const auto refused_at = [](const std::string& text, const std::string& value) {
        const std::string said = message_of<Error>([&] { gltf(text); });
        EXPECT_TRUE(has(said, "byte " + std::to_string(text.rfind(value)) + ": ")) << said;
    };
    const std::string start = R"({"asset":{"version":"2.0"}, "extras":{"nodes":[{"mesh":7}], "a":"]}\"\\"}, )";
    refused_at(start + R"("meshes" : [ {"primitives":[]} ], "nodes":[ {"name":"{"}, {"mesh" :  false } ], "scenes":[{"nodes":[0,1]}]})", "false");
    refused_at(start + R"("sc\u0065nes":[3], "scenes" : [ {"nodes":[]}, {"nodes":[0, "x"] } ], "nodes":[{}], "scene":1})", "\"x\"");
    refused_at(start + R"("meshes":[{"primitives":[{"mode":4},{"mode": 9}]}]})", "{\"mode\":4}");  // a key that is missing: where its object begins
    refused_at(R"({"asset":{"version":"2.0"},"scene":1e999})", "1e999");
    const std::string deep = R"({"asset":{"version":"2.0"},"extras":)" + std::string(300000, '[') + std::string(300000, ']') + R"(,"nodes":[{"mesh":4}]})";
    refused_at(deep, "{\"asset");  // no mesh at all: the document
}

TEST(MeshGltf, nodes_cannot_multiply_a_file_without_limit) {
    // 20,000 nodes that show a mesh of 10,000 primitives: a gigabyte and more out of a file of a few hundred kilobytes.
    std::string nodes = "[", primitives;
    for (int i = 0; i < 20000; ++i) nodes += i ? ",{\"mesh\":0}" : "{\"mesh\":0}";
    for (int i = 0; i < 10000; ++i) primitives += std::string(i ? "," : "") + R"({"attributes":{"POSITION":0}})";
    EXPECT_TRUE(has(message_of<Error>([&] { gltf(scene(nodes + "]", accessors, R"([{"primitives":[)" + primitives + "]}]")); }), "times the file"));
}

}  // namespace
}  // namespace relievo
