// Meshes as OBJ, PLY and glTF. Text keeps the shortest digits that name the same float (Ryu, through std::to_chars).
#include "core/parallel_for.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string>

#include "assets/mesh_formats.h"

namespace relievo {

namespace {

void append(std::string& text, float value) {
    std::array<char, 32> digits;
    text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

void append(std::string& text, std::uint32_t value) {
    std::array<char, 16> digits;
    text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

void append(std::string& text, Vec3f v) {
    for (const float value : {v.x, v.y, v.z}) {
        text += ' ';
        append(text, value);
    }
}

// Lines of `count` things, written by all threads: `line(text, i)` appends the i-th.
template <class Line>
void append_lines(std::string& text, std::size_t count, int threads, const Line& line) {
    constexpr std::size_t block = 1 << 14;
    std::vector<std::string> blocks((count + block - 1) / block);
    parallel_for(static_cast<int>(blocks.size()), 1, threads, [&](int first, int last) {
        for (auto b = static_cast<std::size_t>(first); b < static_cast<std::size_t>(last); ++b)
            for (std::size_t i = b * block; i < std::min(count, (b + 1) * block); ++i) line(blocks[b], i);
    });
    std::size_t bytes = text.size();
    for (const std::string& b : blocks) bytes += b.size();
    text.reserve(bytes);
    for (std::string& b : blocks) {
        text += b;
        b = {};
    }
}

template <class T>
void append_bytes(std::string& bytes, const T& value) {
    static_assert(std::endian::native == std::endian::little);
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

char byte_of(float share) { return static_cast<char>(static_cast<unsigned char>(std::lround(std::clamp(share, 0.0f, 1.0f) * 255.0f))); }

// Linear light of an sRGB-encoded value (IEC 61966-2-1).
float linear(float encoded) { return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f); }

struct GltfParts {
    nlohmann::json document;
    std::string binary;
};

GltfParts gltf_parts(const Mesh& mesh, const std::vector<Vec4f>& tangents) {
    using nlohmann::json;
    GltfParts parts;
    json views = json::array(), accessors = json::array(), attributes = json::object();
    const auto add = [&](const std::string& bytes, int target, json accessor) {
        views.push_back({{"buffer", 0}, {"byteOffset", parts.binary.size()}, {"byteLength", bytes.size()}, {"target", target}});
        parts.binary += bytes;
        accessor["bufferView"] = views.size() - 1;
        accessors.push_back(std::move(accessor));
        return accessors.size() - 1;
    };
    const auto vectors = [](const std::vector<Vec3f>& values) { return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Vec3f)); };
    constexpr int for_vertices = 34962, for_indices = 34963, f32 = 5126, u32 = 5125;
    const std::size_t n = mesh.positions.size();

    Vec3f low = n ? mesh.positions[0] : Vec3f(), high = low;
    for (const Vec3f& p : mesh.positions) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    attributes["POSITION"] = add(vectors(mesh.positions), for_vertices,
        {{"componentType", f32}, {"type", "VEC3"}, {"count", n}, {"min", {low.x, low.y, low.z}}, {"max", {high.x, high.y, high.z}}});
    if (!mesh.normals.empty()) attributes["NORMAL"] = add(vectors(mesh.normals), for_vertices, {{"componentType", f32}, {"type", "VEC3"}, {"count", n}});
    // The sign needs no change although v does: glTF's bitangent points to the top of the picture as ours does.
    if (!tangents.empty()) {
        const std::string bytes(reinterpret_cast<const char*>(tangents.data()), tangents.size() * sizeof(Vec4f));
        attributes["TANGENT"] = add(bytes, for_vertices, {{"componentType", f32}, {"type", "VEC4"}, {"count", n}});
    }
    if (!mesh.uvs.empty()) {
        std::string bytes;
        for (const Vec2f& uv : mesh.uvs) append_bytes(bytes, Vec2f(uv.x, 1 - uv.y));  // v runs down in glTF
        attributes["TEXCOORD_0"] = add(bytes, for_vertices, {{"componentType", f32}, {"type", "VEC2"}, {"count", n}});
    }
    if (!mesh.colours.empty()) {
        std::string bytes;
        for (const Vec3f& c : mesh.colours) append_bytes(bytes, Vec3f(linear(c.x), linear(c.y), linear(c.z)));
        attributes["COLOR_0"] = add(bytes, for_vertices, {{"componentType", f32}, {"type", "VEC3"}, {"count", n}});
    }
    const std::string indices(reinterpret_cast<const char*>(mesh.indices.data()), mesh.indices.size() * 4);
    const std::size_t index_accessor = add(indices, for_indices, {{"componentType", u32}, {"type", "SCALAR"}, {"count", mesh.indices.size()}});

    // JSON is UTF-8; a name from a file system need not be.
    std::string name;
    for (const char c : mesh.name) name += static_cast<unsigned char>(c) < 128 ? c : '?';
    parts.document = {{"asset", {{"version", "2.0"}, {"generator", "relievo"}}},
                      {"scene", 0},
                      {"scenes", {{{"nodes", {0}}}}},
                      {"nodes", {{{"mesh", 0}, {"name", name}}}},
                      {"meshes", {{{"name", name}, {"primitives", {{{"attributes", attributes}, {"indices", index_accessor}}}}}}},
                      {"accessors", accessors},
                      {"bufferViews", views},
                      {"buffers", {{{"byteLength", parts.binary.size()}}}}};
    return parts;
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += k <= n ? letters[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

}  // namespace

std::string write_obj(const Mesh& mesh, int threads) {
    std::string text = "# " + std::to_string(mesh.positions.size()) + " vertices, " + std::to_string(mesh.faces()) + " faces\n";
    append_lines(text, mesh.positions.size(), threads, [&](std::string& t, std::size_t i) {
        t += 'v';
        append(t, mesh.positions[i]);
        if (!mesh.colours.empty()) append(t, mesh.colours[i]);
        t += '\n';
    });
    append_lines(text, mesh.uvs.size(), threads, [&](std::string& t, std::size_t i) {
        t += "vt ";
        append(t, mesh.uvs[i].x);
        t += ' ';
        append(t, mesh.uvs[i].y);
        t += '\n';
    });
    append_lines(text, mesh.normals.size(), threads, [&](std::string& t, std::size_t i) {
        t += "vn";
        append(t, mesh.normals[i]);
        t += '\n';
    });
    append_lines(text, mesh.faces(), threads, [&](std::string& t, std::size_t f) {
        t += 'f';
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t i = mesh.indices[3 * f + k] + 1;
            t += ' ';
            append(t, i);
            if (!mesh.uvs.empty() || !mesh.normals.empty()) t += '/';
            if (!mesh.uvs.empty()) append(t, i);
            if (!mesh.normals.empty()) {
                t += '/';
                append(t, i);
            }
        }
        t += '\n';
    });
    return text;
}

std::string write_ply(const Mesh& mesh) {
    std::string bytes = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
                        "\nproperty float x\nproperty float y\nproperty float z\n";
    if (!mesh.normals.empty()) bytes += "property float nx\nproperty float ny\nproperty float nz\n";
    if (!mesh.uvs.empty()) bytes += "property float s\nproperty float t\n";
    if (!mesh.colours.empty()) bytes += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
    bytes += "element face " + std::to_string(mesh.faces()) + "\nproperty list uchar uint vertex_indices\nend_header\n";
    const std::size_t stride = 12u + (mesh.normals.empty() ? 0 : 12) + (mesh.uvs.empty() ? 0 : 8) + (mesh.colours.empty() ? 0 : 3);
    bytes.reserve(bytes.size() + mesh.positions.size() * stride + mesh.faces() * 13);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        append_bytes(bytes, mesh.positions[i]);
        if (!mesh.normals.empty()) append_bytes(bytes, mesh.normals[i]);
        if (!mesh.uvs.empty()) append_bytes(bytes, mesh.uvs[i]);
        if (!mesh.colours.empty())
            for (const float c : {mesh.colours[i].x, mesh.colours[i].y, mesh.colours[i].z}) bytes += byte_of(c);
    }
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        bytes += '\3';
        append_bytes(bytes, std::array{mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2]});
    }
    return bytes;
}

std::string write_glb(const Mesh& mesh, const std::vector<Vec4f>& tangents) {
    GltfParts parts = gltf_parts(mesh, tangents);
    std::string text = parts.document.dump();
    text.append((4 - text.size() % 4) % 4, ' ');
    parts.binary.append((4 - parts.binary.size() % 4) % 4, '\0');
    std::string bytes = "glTF";
    append_bytes(bytes, std::uint32_t{2});
    append_bytes(bytes, static_cast<std::uint32_t>(12 + 8 + text.size() + 8 + parts.binary.size()));
    append_bytes(bytes, static_cast<std::uint32_t>(text.size()));
    bytes += "JSON" + text;
    append_bytes(bytes, static_cast<std::uint32_t>(parts.binary.size()));
    bytes += std::string("BIN\0", 4) + parts.binary;
    return bytes;
}

std::string write_gltf(const Mesh& mesh, const std::vector<Vec4f>& tangents) {
    GltfParts parts = gltf_parts(mesh, tangents);
    parts.document["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64(parts.binary);
    return parts.document.dump(1);
}

}  // namespace relievo
