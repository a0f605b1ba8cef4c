#include "assets/shells_gltf.h"

#include "assets/png_bytes.h"
#include "core/error.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <nlohmann/json.hpp>

namespace relievo {

namespace {

using nlohmann::json;

constexpr int for_vertices = 34962, for_indices = 34963, f32 = 5126, u32 = 5125;
constexpr int linear = 9729, clamp_to_edge = 33071;

class Buffer {
public:
    template <class T>
    int view(const T* data, std::size_t count, int target) {
        static_assert(std::endian::native == std::endian::little);
        json view = {{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", count * sizeof(T)}};
        if (target != 0) view["target"] = target;
        bytes_.append(reinterpret_cast<const char*>(data), count * sizeof(T));
        bytes_.append((4 - bytes_.size() % 4) % 4, '\0');  // every accessor begins at a multiple of its component's size
        views_.push_back(std::move(view));
        return static_cast<int>(views_.size()) - 1;
    }
    int accessor(int view, int component, const char* type, std::size_t count, json more = json::object()) {
        more.update({{"bufferView", view}, {"componentType", component}, {"type", type}, {"count", count}});
        accessors_.push_back(std::move(more));
        return static_cast<int>(accessors_.size()) - 1;
    }
    int vectors(const std::vector<Vec3f>& values, bool bounds) {
        json more = json::object();
        if (bounds) {
            Vec3f low = values[0], high = low;
            for (const Vec3f& p : values) {
                low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
                high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
            }
            more = {{"min", {low.x, low.y, low.z}}, {"max", {high.x, high.y, high.z}}};
        }
        return accessor(view(values.data(), values.size(), for_vertices), f32, "VEC3", values.size(), std::move(more));
    }
    json views_ = json::array(), accessors_ = json::array();
    std::string bytes_;
};

void append(std::string& bytes, std::uint32_t value) { bytes.append(reinterpret_cast<const char*>(&value), 4); }

}  // namespace

std::string write_shells_glb(const ShellScene& scene) {
    const std::size_t count = scene.skin.size();
    assert(count > 0 && scene.skin_normals.size() == count && scene.uvs.size() == count && scene.texture.channels == 4);
    Buffer buffer;
    const int indices = buffer.accessor(buffer.view(scene.indices.data(), scene.indices.size(), for_indices), u32, "SCALAR", scene.indices.size());
    std::vector<Vec2f> uvs;
    for (const Vec2f& uv : scene.uvs) uvs.emplace_back(uv.x, 1 - uv.y);  // v runs down in glTF
    const int coordinates = buffer.accessor(buffer.view(uvs.data(), uvs.size(), for_vertices), f32, "VEC2", count);

    json primitives = json::array(), materials = json::array();
    const auto colour = [](Vec3f c) { return json{c.x, c.y, c.z, 1.0f}; };
    materials.push_back({{"name", "skin"}, {"pbrMetallicRoughness", {{"baseColorFactor", colour(scene.skin_colour)}, {"metallicFactor", 0}, {"roughnessFactor", 1}}}});
    primitives.push_back({{"attributes", {{"POSITION", buffer.vectors(scene.skin, true)}, {"NORMAL", buffer.vectors(scene.skin_normals, false)}}}, {"indices", indices}, {"material", 0}});
    for (const ShellScene::Layer& layer : scene.layers) {
        assert(layer.positions.size() == count && layer.normals.size() == count);
        primitives.push_back({{"attributes", {{"POSITION", buffer.vectors(layer.positions, true)}, {"NORMAL", buffer.vectors(layer.normals, false)}, {"TEXCOORD_0", coordinates}}},
                              {"indices", indices},
                              {"material", materials.size()}});
        materials.push_back({{"name", "layer " + std::to_string(materials.size())},
                             {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}, {"baseColorFactor", colour(layer.shade)}, {"metallicFactor", 0}, {"roughnessFactor", 1}}},
                             {"alphaMode", "MASK"},
                             {"alphaCutoff", layer.cutoff}});
    }
    Image8 top_first(scene.texture.width, scene.texture.height, 4);
    for (int y = 0; y < top_first.height; ++y) std::copy_n(scene.texture.at(0, scene.texture.height - 1 - y), top_first.width * 4, top_first.at(0, y));
    const std::string png = png_bytes(top_first);
    const int picture = buffer.view(png.data(), png.size(), 0);

    // JSON is UTF-8; a name from a file system need not be.
    std::string name;
    for (const char c : scene.name) name += static_cast<unsigned char>(c) < 128 ? c : '?';
    const json document = {{"asset", {{"version", "2.0"}, {"generator", "relievo"}}},
                           {"scene", 0},
                           {"scenes", {{{"nodes", {0}}}}},
                           {"nodes",
                            {{{"name", name}, {"mesh", 0}, {"translation", {scene.centre.x, scene.centre.y, scene.centre.z}}, {"scale", {scene.radius, scene.radius, scene.radius}}}}},
                           {"meshes", {{{"name", name}, {"primitives", primitives}}}},
                           {"materials", materials},
                           {"textures", {{{"source", 0}, {"sampler", 0}}}},
                           {"images", {{{"bufferView", picture}, {"mimeType", "image/png"}}}},
                           // No mip levels: their alpha would be a mean height, and layers above it would go bald from afar.
                           {"samplers", {{{"magFilter", linear}, {"minFilter", linear}, {"wrapS", clamp_to_edge}, {"wrapT", clamp_to_edge}}}},
                           {"accessors", buffer.accessors_},
                           {"bufferViews", buffer.views_},
                           {"buffers", {{{"byteLength", buffer.bytes_.size()}}}}};
    std::string text = document.dump();
    text.append((4 - text.size() % 4) % 4, ' ');
    const std::size_t all = 12 + 8 + text.size() + 8 + buffer.bytes_.size();
    if (all > 0xffffffffu) throw Error("write", scene.name + " as .glb", "it would be " + std::to_string(all >> 30) + " GiB, and the format ends at 4", "take fewer layers or a smaller atlas");
    std::string bytes = "glTF";
    append(bytes, 2);
    append(bytes, static_cast<std::uint32_t>(all));
    append(bytes, static_cast<std::uint32_t>(text.size()));
    bytes += "JSON" + text;
    append(bytes, static_cast<std::uint32_t>(buffer.bytes_.size()));
    bytes += std::string("BIN\0", 4) + buffer.bytes_;
    return bytes;
}

}  // namespace relievo
