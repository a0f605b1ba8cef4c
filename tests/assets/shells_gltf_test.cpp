// Layers as glTF, checked against the rules of the format and read back.
#include "assets/shells_gltf.h"

#include "assets/image_file.h"
#include "assets/mesh_formats.h"
#include "assets/png_bytes.h"
#include "core/error.h"
#include "temporary_folder.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstring>

namespace relievo::test {
namespace {

ShellScene two_layers() {
    ShellScene s;
    s.name = "l\xf6we";
    s.centre = {1e6, -2, 3};
    s.radius = 10;
    s.skin = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0.5f}, {0.25f, 0.5f, 1}};
    s.skin_normals.assign(5, {0, 0, 1});
    s.uvs = {{0, 0}, {1, 0}, {0, 1}, {1, 1}, {0.5f, 0.25f}};
    s.indices = {0, 1, 2, 2, 1, 3, 0, 1, 4};
    s.skin_colour = {0.1f, 0.2f, 0.3f};
    for (int k = 0; k < 2; ++k) {
        ShellScene::Layer l;
        for (const Vec3f& p : s.skin) l.positions.push_back(p + Vec3f(0, 0, 0.25f * static_cast<float>(k + 1)));
        l.normals = s.skin_normals;
        l.cutoff = 0.25f + 0.5f * static_cast<float>(k);
        l.shade = {0.5f, 0.5f, 1};
        s.layers.push_back(l);
    }
    s.texture = Image8(3, 2, 4);
    for (std::size_t i = 0; i < s.texture.texels.size(); ++i) s.texture.texels[i] = static_cast<std::uint8_t>(11 * i);
    return s;
}

class ShellsGltf : public InTemporaryFolder {};

TEST_F(ShellsGltf, KeepsTheRulesOfTheFormat) {
    const ShellScene scene = two_layers();
    const std::string bytes = write_shells_glb(scene);
    const auto word = [&](std::size_t at) {
        std::uint32_t v;
        std::memcpy(&v, bytes.data() + at, 4);
        return v;
    };
    ASSERT_EQ(bytes.substr(0, 4), "glTF");
    EXPECT_EQ(word(4), 2u);
    EXPECT_EQ(word(8), bytes.size());
    const std::size_t text = word(12);
    EXPECT_EQ(text % 4, 0u);
    const auto j = nlohmann::json::parse(bytes.substr(20, text));
    const std::size_t binary = 20 + text + 8;
    EXPECT_EQ(word(20 + text) % 4, 0u);
    EXPECT_EQ(j["buffers"][0]["byteLength"], bytes.size() - binary);
    EXPECT_EQ(j["meshes"][0]["primitives"].size(), 3u);
    EXPECT_EQ(j["materials"].size(), 3u);
    EXPECT_FALSE(j["materials"][0].contains("alphaMode"));
    for (std::size_t k = 1; k < 3; ++k) {
        EXPECT_EQ(j["materials"][k]["alphaMode"], "MASK");
        EXPECT_EQ(j["materials"][k]["alphaCutoff"], k == 1 ? 0.25 : 0.75);
        EXPECT_EQ(j["materials"][k]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
        EXPECT_TRUE(j["meshes"][0]["primitives"][k]["attributes"].contains("TEXCOORD_0"));
    }
    for (const auto& a : j["accessors"]) {
        const auto& view = j["bufferViews"][a["bufferView"].get<std::size_t>()];
        const std::size_t components = a["type"] == "SCALAR" ? 1 : a["type"] == "VEC2" ? 2 : 3, offset = view["byteOffset"], count = a["count"];
        EXPECT_EQ(offset % 4, 0u);
        EXPECT_EQ(view["byteLength"], count * components * 4);
        EXPECT_LE(offset + count * components * 4, j["buffers"][0]["byteLength"].get<std::size_t>());
        if (!a.contains("min")) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            float low = 1e9f, high = -1e9f;
            for (std::size_t i = 0; i < count; ++i) {
                float v;
                std::memcpy(&v, bytes.data() + binary + offset + (3 * i + c) * 4, 4);
                low = std::min(low, v);
                high = std::max(high, v);
            }
            EXPECT_EQ(a["min"][c].get<float>(), low);
            EXPECT_EQ(a["max"][c].get<float>(), high);
        }
    }
    for (const auto& p : j["meshes"][0]["primitives"]) {
        EXPECT_TRUE(j["accessors"][p["attributes"]["POSITION"].get<std::size_t>()].contains("min"));
    }
    // The picture within, as a file of its own.
    const auto& view = j["bufferViews"][j["images"][0]["bufferView"].get<std::size_t>()];
    EXPECT_FALSE(view.contains("target"));
    std::ofstream(folder / "in.png", std::ios::binary) << bytes.substr(binary + view["byteOffset"].get<std::size_t>(), view["byteLength"]);
    EXPECT_EQ(read_image_8(folder / "in.png", FirstRow::bottom).texels, scene.texture.texels);
}

TEST_F(ShellsGltf, IsReadBackInTheFilesOwnSpace) {
    const ShellScene scene = two_layers();
    const Mesh mesh = parse_gltf(write_shells_glb(scene), "shells.glb", {});
    EXPECT_EQ(mesh.faces(), 9u);
    ASSERT_EQ(mesh.positions.size(), 15u);
    for (std::size_t i = 0; i < 5; ++i) {
        const Vec3d there = Vec3d(scene.skin[i]) * 10.0 + scene.centre;
        EXPECT_LT(length(Vec3d(mesh.positions[i]) - there), 0.1);  // a float's step at a million is a sixteenth
        EXPECT_NEAR(mesh.positions[10 + i].z, there.z + 5, 1e-5);
        EXPECT_EQ(mesh.uvs[5 + i], scene.uvs[i]);
    }
}

TEST_F(ShellsGltf, PngsComeBackAsTheyWere) {
    for (int channels = 1; channels <= 4; ++channels) {
        Image8 image(37, 19, channels);
        for (std::size_t i = 0; i < image.texels.size(); ++i) image.texels[i] = static_cast<std::uint8_t>(i * i * 7 + i);
        std::ofstream(folder / "a.png", std::ios::binary) << png_bytes(image);
        const Image8 back = read_image_8(folder / "a.png", FirstRow::top);
        EXPECT_EQ(back.channels, channels);
        EXPECT_EQ(back.texels, image.texels);
    }
}

}  // namespace
}  // namespace relievo::test
