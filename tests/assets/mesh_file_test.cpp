#include "assets/mesh_file.h"

#include "assets/file_bytes.h"
#include "assets/mesh_formats.h"
#include "assets/temporary_folder.h"
#include "core/error.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <random>

namespace relievo {
namespace {

using test::has;
using test::message_of;

class MeshFile : public test::InTemporaryFolder {};

// A closed bumpy sphere with every attribute; colours are multiples of 1/255, so that 8 bits hold them.
Mesh bumpy(int rings, bool attributes) {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> bump(0.8f, 1.2f);
    Mesh mesh;
    const int segments = 2 * rings;
    for (int r = 0; r <= rings; ++r)
        for (int s = 0; s < segments; ++s) {
            const float a = 3.14159265f * static_cast<float>(r) / static_cast<float>(rings), b = 6.2831853f * static_cast<float>(s) / static_cast<float>(segments);
            const Vec3f n(std::sin(a) * std::cos(b), std::sin(a) * std::sin(b), std::cos(a));
            mesh.positions.push_back(n * (bump(random) * 123.456f));
            if (!attributes) continue;
            mesh.normals.push_back(normalize(n));
            mesh.uvs.emplace_back(static_cast<float>(s) / static_cast<float>(segments), static_cast<float>(r) / static_cast<float>(rings));
            mesh.colours.emplace_back(static_cast<float>(random() % 256) / 255.0f, static_cast<float>(random() % 256) / 255.0f, 1.0f);
        }
    for (int r = 0; r < rings; ++r)
        for (int s = 0; s < segments; ++s) {
            const auto at = [&](int i, int k) { return static_cast<std::uint32_t>(i * segments + k % segments); };
            for (const std::uint32_t i : {at(r, s), at(r + 1, s), at(r + 1, s + 1), at(r, s), at(r + 1, s + 1), at(r, s + 1)}) mesh.indices.push_back(i);
        }
    return mesh;
}

float farthest(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
    EXPECT_EQ(a.size(), b.size());
    float most = a.size() == b.size() ? 0.0f : INFINITY;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) most = std::max({most, std::abs(a[i].x - b[i].x), std::abs(a[i].y - b[i].y), std::abs(a[i].z - b[i].z)});
    return most;
}

TEST_F(MeshFile, every_format_brings_a_mesh_back_compressed_or_not) {
    for (const bool attributes : {false, true}) {
        const Mesh mesh = bumpy(24, attributes);
        for (const std::string ending : {"obj", "ply", "glb", "gltf", "rmesh"})
            for (const std::string gz : {"", ".gz"})
                for (const int threads : {1, 2}) {
                    const auto file = folder / ("m." + ending + gz);
                    save_mesh(file, mesh, threads);
                    EXPECT_EQ(bytes_of(file).substr(0, 2) == "\x1f\x8b", !gz.empty());
                    const Mesh back = load_mesh(file, threads);
                    const std::string what = ending + gz;
                    EXPECT_EQ(back.positions, mesh.positions) << what;
                    EXPECT_EQ(back.indices, mesh.indices) << what;
                    EXPECT_EQ(back.normals, mesh.normals) << what;
                    const bool gltf = ending == "glb" || ending == "gltf";
                    EXPECT_TRUE(gltf || back.uvs == mesh.uvs) << what;
                    ASSERT_EQ(back.uvs.size(), mesh.uvs.size()) << what;
                    for (std::size_t i = 0; i < mesh.uvs.size(); ++i) ASSERT_NEAR(back.uvs[i].y, mesh.uvs[i].y, 6e-8f) << what;  // 1 - (1 - v)
                    // Bits elsewhere; to linear light and back in glTF.
                    EXPECT_LE(farthest(back.colours, mesh.colours), gltf ? 3e-7f : 0.0f) << what;
                    EXPECT_EQ(back.name, "m");
                    EXPECT_TRUE(back.notes.empty()) << what << ": " << back.notes[0];
                }
    }
}

TEST_F(MeshFile, the_cache_keeps_name_and_notes) {
    Mesh mesh = bumpy(4, false);
    mesh.name = "Drache";
    mesh.notes = {"3 faces were skipped.", "", "And more."};
    save_mesh(folder / "c.rmesh", mesh);
    const Mesh back = load_mesh(folder / "c.rmesh");
    EXPECT_EQ(back.name, mesh.name);
    EXPECT_EQ(back.notes, mesh.notes);
}

TEST_F(MeshFile, the_cache_notices_every_changed_byte_and_every_length) {
    const std::string bytes = write_mesh_cache(bumpy(3, true), 1);
    EXPECT_NO_THROW(parse_mesh_cache(bytes, "c"));
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (i >= 56 && i < 64) continue;  // reserved, checked by nobody
        std::string changed = bytes;
        changed[i] = static_cast<char>(changed[i] ^ 1);
        EXPECT_THROW(parse_mesh_cache(changed, "c"), Error) << "byte " << i;
    }
    for (std::size_t length = 0; length < bytes.size(); length += 7) EXPECT_THROW(parse_mesh_cache(bytes.substr(0, length), "c"), Error) << length;
    EXPECT_THROW(parse_mesh_cache(bytes + "x", "c"), Error);
}

TEST_F(MeshFile, the_cache_is_not_believed_even_if_its_checksum_fits) {
    const auto with = [](std::size_t at, auto value) {
        std::string bytes = write_mesh_cache(bumpy(3, false), 1);
        std::memcpy(bytes.data() + at, &value, sizeof(value));
        seal_mesh_cache(bytes, 1);
        return message_of<Error>([&] { parse_mesh_cache(bytes, "c"); });
    };
    EXPECT_TRUE(has(with(24, std::uint64_t{1000000000}), "promises"));
    EXPECT_TRUE(has(with(24, std::uint64_t{0xffffffffffff}), "absurd"));
    EXPECT_TRUE(has(with(32, std::uint64_t{4}), "absurd")) << "not three per face";
    EXPECT_TRUE(has(with(16, std::uint32_t{2}), "version 2"));
    EXPECT_TRUE(has(with(20, std::uint32_t{8}), "attributes unknown"));
    EXPECT_TRUE(has(with(64 + 24 * 12, std::uint32_t{24}), "out of range")) << "an index";
}

TEST_F(MeshFile, the_format_is_told_by_content_then_by_name) {
    const Mesh mesh = bumpy(3, false);
    for (const std::string& bytes : {write_ply(mesh), write_glb(mesh), write_mesh_cache(mesh, 1)}) EXPECT_EQ(load_mesh(put("x.dat", bytes)).indices, mesh.indices);
    EXPECT_EQ(load_mesh(put("X.OBJ", write_obj(mesh, 1))).indices, mesh.indices);
    EXPECT_EQ(load_mesh(put("packed.obj", gzip(write_obj(mesh, 1)))).indices, mesh.indices) << "compressed without saying so";
    EXPECT_TRUE(has(message_of<Error>([&] { load_mesh(put("x.dat", "v 0 0 0\n")); }), "\".dat\" is no format"));
    EXPECT_TRUE(has(message_of<Error>([&] { load_mesh(put("x", "v 0 0 0\n")); }), "no ending"));
    EXPECT_TRUE(has(message_of<Error>([&] { load_mesh(put("x.ply", "obj\n")); }), "byte 0"));
    EXPECT_TRUE(has(message_of<Error>([&] { save_mesh(folder / "x.stl", mesh); }), "no format of meshes written here"));
    EXPECT_EQ(load_mesh(put("dragon.vrip.PLY.gz", gzip(write_ply(mesh)))).name, "dragon.vrip");
}

TEST_F(MeshFile, what_is_no_file_of_a_mesh_is_refused) {
    EXPECT_TRUE(has(message_of<Error>([&] { load_mesh(folder / "none.obj"); }), "No such file"));
    EXPECT_TRUE(has(message_of<Error>([&] { load_mesh(folder); }), "folder"));
    EXPECT_TRUE(has(message_of<Error>([&] { load_mesh(put("e.obj", "")); }), "empty"));
    EXPECT_TRUE(has(message_of<Error>([&] { load_mesh("/dev/null"); }), "plain file"));
    EXPECT_THROW(save_mesh(folder / "no" / "m.obj", bumpy(3, false)), Error);
}

TEST_F(MeshFile, damaged_compression_is_refused) {
    const std::string packed = gzip(write_obj(bumpy(20, true), 1));
    for (const std::size_t length : {19u, 100u, 1000u}) EXPECT_TRUE(has(message_of<Error>([&] { load_mesh(put("t.obj.gz", packed.substr(0, length))); }), "compressed data")) << length;
    EXPECT_TRUE(has(message_of<Error>([&] { load_mesh(put("t.obj.gz", packed.substr(0, packed.size() - 4))); }), "compressed data ends at byte"));
    std::string changed = packed;
    changed[packed.size() / 2] = static_cast<char>(changed[packed.size() / 2] ^ 0x55);
    EXPECT_THROW(load_mesh(put("t.obj.gz", changed)), Error);
    const std::string two = gzip("v 0 0 0\nv 1 0 0\n") + gzip("v 0 1 0\nf 1 2 3\n");
    EXPECT_EQ(load_mesh(put("two.obj.gz", two)).faces(), 1u) << "members follow each other";
}

TEST_F(MeshFile, what_inflates_without_end_is_refused) {
    const std::string bomb = gzip(std::string(8 << 20, ' '));
    ASSERT_LT(bomb.size(), 10000u);
    EXPECT_TRUE(has(message_of<Error>([&] { FileBytes::inflate(bomb, "bomb", 1 << 20); }), "more than 1 MiB"));
    EXPECT_EQ(FileBytes::inflate(bomb, "bomb", 8 << 20).view().size(), 8u << 20);
}

TEST_F(MeshFile, gltf_buffers_lie_beside_the_file) {
    const Mesh mesh = bumpy(3, false);
    std::string text = write_gltf(mesh);
    const std::size_t begin = text.find("data:"), end = text.find('"', begin);
    text.replace(begin, end - begin, "the%20data.bin");
    const std::string glb = write_glb(mesh);
    put("the data.bin", glb.substr(glb.find(std::string("BIN\0", 4)) + 4));
    EXPECT_EQ(load_mesh(put("m.gltf", text)).positions, mesh.positions);
    std::filesystem::remove(folder / "the data.bin");
    EXPECT_TRUE(has(message_of<Error>([&] { load_mesh(folder / "m.gltf"); }), "its buffer is missing"));
    text.replace(text.find("the%20data.bin"), 14, "https://x/y.bin");
    EXPECT_TRUE(has(message_of<Error>([&] { load_mesh(put("m.gltf", text)); }), "no file beside it"));
}

TEST_F(MeshFile, numbers_survive_as_text_bit_by_bit) {
    std::mt19937 random(4);
    Mesh mesh = bumpy(100, false);  // more than one block of lines
    for (Vec3f& p : mesh.positions)
        for (float* value : {&p.x, &p.y, &p.z}) do
                *value = std::bit_cast<float>(static_cast<std::uint32_t>(random()));
            while (!std::isfinite(*value));
    const std::string text = write_obj(mesh, 1);
    EXPECT_EQ(text, write_obj(mesh, 3));
    const Mesh back = parse_obj(text, "m", 1);
    ASSERT_EQ(back.positions.size(), mesh.positions.size());
    EXPECT_EQ(std::memcmp(back.positions.data(), mesh.positions.data(), mesh.positions.size() * sizeof(Vec3f)), 0);
}

}  // namespace
}  // namespace relievo
