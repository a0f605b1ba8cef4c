#include "fuzz/mesh_seeds.h"

#include "assets/file_bytes.h"
#include "assets/mesh_file.h"
#include "assets/mesh_formats.h"
#include "core/error.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>

namespace relievo::fuzz {

namespace {

Mesh octahedron(bool attributes) {
    Mesh mesh;
    mesh.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    mesh.indices = {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5};
    if (!attributes) return mesh;
    mesh.normals = mesh.positions;
    for (const Vec3f p : mesh.positions) {
        mesh.uvs.emplace_back(0.5f + p.x / 2, 0.5f + p.y / 2);
        mesh.colours.emplace_back(0.5f + p.x / 2, 0.5f + p.y / 2, 0.5f + p.z / 2);
    }
    return mesh;
}

std::string binary_stl(const Mesh& mesh) {
    std::string bytes(80, ' ');
    const auto append = [&](const auto& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof(value)); };
    append(static_cast<std::uint32_t>(mesh.faces()));
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        append(Vec3f());
        for (std::size_t k = 0; k < 3; ++k) append(mesh.positions[mesh.indices[i + k]]);
        append(std::uint16_t{0});
    }
    return bytes;
}

// The bytes of 32-bit and larger numbers of a little-endian PLY turned round: our writer's layout, positions and faces only.
std::string big_endian_ply() {
    const Mesh mesh = octahedron(false);
    std::string bytes = write_ply(mesh);
    bytes.replace(bytes.find("little"), 6, "big");
    std::size_t at = bytes.find("end_header\n") + 11;
    const auto turn = [&] {
        std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.begin() + static_cast<std::ptrdiff_t>(at + 4));
        at += 4;
    };
    for (std::size_t i = 0; i < 3 * mesh.positions.size(); ++i) turn();
    for (std::size_t f = 0; f < mesh.faces(); ++f) {
        ++at;
        for (int k = 0; k < 3; ++k) turn();
    }
    return bytes;
}

const char* const gltf_nodes = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0,3]}],"nodes":[{"children":[1,2],"translation":[1,2,3]},
{"mesh":0,"rotation":[0,0.6,0,0.8],"scale":[1,-2,1]},{"mesh":0,"matrix":[2,0,0,0,0,2,0,0,0,0,2,0,4,5,6,1]},{"mesh":1,"skin":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":5}]},{"primitives":[{"attributes":{"POSITION":2},"mode":6},{"attributes":{"POSITION":3},"indices":1,"mode":4},{"attributes":{"POSITION":0},"mode":1}]}],
"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3},{"bufferView":1,"byteOffset":0,"componentType":5121,"type":"SCALAR","count":3},
{"bufferView":0,"componentType":5122,"normalized":true,"type":"VEC3","count":6},
{"componentType":5126,"type":"VEC3","count":4,"sparse":{"count":2,"indices":{"bufferView":1,"componentType":5121,"byteOffset":1},"values":{"bufferView":0,"byteOffset":12}}}],
"bufferViews":[{"buffer":0,"byteLength":36,"byteStride":0},{"buffer":0,"byteOffset":36,"byteLength":4}],
"buffers":[{"byteLength":40,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAECAw=="}]})";

void check(bool good, const char* promise) {
    if (good) return;
    std::fprintf(stderr, "a promise of core/mesh.h is broken: %s\n", promise);
    std::abort();
}

bool same_bits(const std::vector<Vec3f>& a, const std::vector<Vec3f>& b) {
    return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Vec3f)) == 0);
}

void check_mesh(const Mesh& mesh) {
    const std::size_t n = mesh.positions.size();
    check(!mesh.indices.empty() && mesh.indices.size() % 3 == 0, "three indices per face, some face");
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        check(a < n && b < n && c < n, "indices in range");
        check(a != b && b != c && c != a, "distinct corners");
    }
    for (const auto& [size, name] : {std::pair{mesh.normals.size(), "normals"}, {mesh.uvs.size(), "uvs"}, {mesh.colours.size(), "colours"}})
        check(size == 0 || size == n, name);
    for (const Vec3f p : mesh.positions) check(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z), "finite positions");
    for (const Vec3f v : mesh.normals) {
        const double square = dot(Vec3d(v), Vec3d(v));
        check(square == 0 || std::abs(square - 1) < 1e-4, "unit normals");
    }
    for (const Vec2f uv : mesh.uvs) check(std::isfinite(uv.x) && std::isfinite(uv.y), "finite uvs");
    for (const Vec3f c : mesh.colours)
        for (const float share : {c.x, c.y, c.z}) check(share >= 0 && share <= 1, "colours in [0,1]");
}

}  // namespace

std::vector<std::string> seeds(const std::string& format) {
    const Mesh bare = octahedron(false), full = octahedron(true);
    if (format == "obj")
        return {write_obj(bare), write_obj(full),
                "# quirks\r\nmtllib a.mtl\r\no one\r\nv 0 0 0 1 0.5 0\r\nv 1 0 0\r\nv 1.5e-1 +1. -.25e+2\r\nv 0 1 1 0.5\r\nvt 0.5 0.5\r\nvt 1\r\nvn 0 0 1\r\ng a\r\n"
                "f -4/1/-1 -3/2/1 -2//1\r\nf 1 2 3 4 1\r\nf 1/1 2/1 \\\r\n 3/2 4/1\r\nl 1 2\r\np 1\r\nf 1 2 9\r\nf 1 1 2\r\nv 3 4 5\r\nf -1 -2 -3",
                "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 2 1 0\nv 0 4 0\nf 1 2 3 4 5\nf 5 4 3 2 1\nv nan inf 1e99\nf 1 2 6\n", "v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r"};
    if (format == "ply")
        return {write_ply(bare), write_ply(full), big_endian_ply(),
                "ply\nformat ascii 1.0\ncomment c\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"
                "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n",
                "ply\r\nformat ascii 1.0\r\nelement face 1\r\nproperty uchar red\r\nproperty list int short vertex_index\r\nelement vertex 3\r\nproperty list char int l\r\n"
                "property double x\r\nproperty short y\r\nproperty int8 z\r\nproperty uchar r\r\nproperty uchar g\r\nproperty uchar b\r\nend_header\r\n9 3\r\n0 1 2\r\n0 0 0 0 1 2 3 1 7 1 0 0 1 2 3 0 0 1 0 255 255 255\r\n",
                std::string("ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty uchar x\nproperty short y\nproperty double z\nelement tristrips 1\n"
                            "property list int int vertex_indices\nend_header\n") +
                    std::string("\0\1\0\0\0\0\0\0\0\0\0", 11) + std::string("\1\1\0\0\0\0\0\0\0\0\0", 11) + std::string("\0\2\0\0\0\0\0\0\0\0\0", 11) +
                    std::string("\1\2\0\0\0\0\0\0\0\0\0", 11) + std::string("\6\0\0\0\0\0\0\0\1\0\0\0\2\0\0\0\3\0\0\0\xff\xff\xff\xff\0\0\0\0", 28)};
    if (format == "off")
        return {"OFF\n4 2 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n", "# c\nCOFF\n4 1 0 # n\n\n0 0 0 0.9 0 0 #red\n1 0 0 255 0 0 255\n1 1 0 0 0 0\n0 1 0 0 1 0 1\n4 0 1 2 3 0.5 0.5 0.5\n",
                "NOFF 3 1 0\n0 0 0 0 0 1 1 0 0 0 0 1 0 1 0\n0 0 1\n3 0 1 2", "STCNOFF\r\n3 1\r\n0 0 0 0 0 1 255 255 0 255 0.5 0.5\r\n1 0 0 0 0 1 1 1 1 1 0 0\r\n0 1 0 0 0 1 1 1 1 1 1 0\r\n3 0 1 2\r\n",
                "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"};
    if (format == "stl")
        return {binary_stl(bare), "solid binary" + binary_stl(bare).substr(12),
                "solid a\n facet normal 0 0 1\n  outer loop\n   vertex 0 0 0\n   vertex 1 0 0\n   vertex 0 1 0\n  endloop\n endfacet\nendsolid a\nsolid b\nfacet normal 0 0 0\nOUTER LOOP\nVERTEX 0 "
                "0 1\nvertex 1 0 1e0\nvertex 1 1 1\nvertex 0 1 1\nendloop\nendfacet\nendsolid",
                "solid\rfacet normal 0 0 1\router loop\rvertex 0 0 0\rvertex 1 0 0\rvertex 0 1 0\rendloop\rendfacet\rendsolid\r"};
    if (format == "gltf") return {write_gltf(bare), write_gltf(full), write_glb(bare), write_glb(full), gltf_nodes};
    if (format == "rmesh") return {write_mesh_cache(bare, 1), write_mesh_cache(full, 1)};
    if (format == "gz") return {gzip(write_obj(bare)), gzip(write_ply(full)), gzip("v 0 0 0\n") + gzip("v 1 0 0\nv 0 1 0\nf 1 2 3\n")};
    return {};
}

std::string mutated(const std::string& file, const std::string& other, std::mt19937_64& random) {
    static const std::array<const char*, 40> awkward = {"0", "-1", "1", "3", "4294967295", "4294967296", "-2147483648", "9999999999999999999999", "1e39", "-1e-46", "1e309",
        "nan", "-inf", "1.#QNAN", "1..2", "+", "-", ".", "e5", "0x10", "1/1/1", "-1//-1", "/", "\\\n", "\\", "#", "\r", "\n", "\n\n", " ", "\t", "\0", "list", "end_header\n", "property float x\n",
        "element face 3\n", "[", "{", "null", "1e400"};
    if (is_gzip(file) && random() % 2 == 0) {  // what is inside changed, and packed again: the checksum fits
        try {
            return gzip(mutated(std::string(FileBytes::inflate(file, "fuzz").view()), other, random));
        } catch (const Error&) {
        }
    }
    std::string bytes = file;
    const auto below = [&](std::size_t n) { return n == 0 ? 0 : static_cast<std::size_t>(random() % n); };
    // Few changes leave a file that is read to the end, many find odd company.
    const std::size_t changes = below(4) > 0 ? 1 + below(2) : 1 + below(8);
    for (std::size_t c = 0; c < changes; ++c) {
        const std::size_t at = below(bytes.size() + 1);
        const std::size_t length = std::min(bytes.size() - at, std::size_t{1} + below(below(4) == 0 ? 64 : 6));
        switch (below(10)) {
            case 0:
                if (at < bytes.size()) bytes[at] = static_cast<char>(random());
                break;
            case 1:
                if (at < bytes.size()) bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
                break;
            case 2: bytes.erase(at, length); break;
            case 3: bytes.insert(at, bytes.substr(at, length)); break;
            case 4: bytes.replace(at, length, other.substr(below(other.size()), 1 + below(64))); break;
            case 5: bytes.insert(at, awkward[below(awkward.size())]); break;
            case 6: {  // a number of the text replaced
                std::size_t begin = bytes.find_first_of("0123456789", at);
                if (begin == std::string::npos) break;
                const std::size_t end = std::min(bytes.find_first_not_of("0123456789.eE+-", begin), bytes.size());
                bytes.replace(begin, end - begin, awkward[below(awkward.size())]);
                break;
            }
            case 7: {  // a line repeated or exchanged
                const std::size_t begin = bytes.rfind('\n', at) == std::string::npos ? 0 : bytes.rfind('\n', at) + 1;
                const std::size_t end = std::min(bytes.find('\n', at), bytes.size());
                if (end > begin) bytes.insert(below(bytes.size()), bytes.substr(begin, end - begin) + "\n");
                break;
            }
            case 8: {  // a 32-bit number of binary data
                static const std::array<std::uint32_t, 8> values = {0, 1, 3, 0x7fffffff, 0x80000000, 0xffffffff, 0x7f800000, 0x7fc00000};
                const std::uint32_t value = values[below(values.size())];
                if (at + 4 <= bytes.size()) std::memcpy(bytes.data() + at, &value, 4);
                break;
            }
            default:  // cut short, now and then
                if (below(4) == 0) bytes.resize(at);
                break;
        }
        // Long files only make runs slow: what they can break, short ones can.
        if (bytes.size() > 1 << 16) bytes.resize(1 << 16);
    }
    // Otherwise the checksum would turn everything away.
    if (is_mesh_cache(bytes) && bytes.size() >= 64 && below(8) > 0) seal_mesh_cache(bytes, 1);
    return bytes;
}

// "line 7" or "byte 12" somewhere in it.
bool names_a_place(const std::string& refusal) {
    for (const char* word : {"line ", "byte "})
        for (std::size_t at = refusal.find(word); at != std::string::npos; at = refusal.find(word, at + 1))
            if (std::isdigit(static_cast<unsigned char>(refusal.c_str()[at + 5]))) return true;
    return false;
}

bool try_mesh(const std::string& format, std::string_view bytes) {
    std::array<std::optional<Mesh>, 2> meshes;
    std::array<std::string, 2> refusals;
    for (const int threads : {1, 2}) {
        const auto at = static_cast<std::size_t>(threads - 1);
        try {
            meshes[at] = parse_mesh(bytes, format == "gz" ? "obj" : format, "fuzz", {}, threads);
        } catch (const Error& e) {
            refusals[at] = e.what();
        }
    }
    check(meshes[0].has_value() == meshes[1].has_value() && refusals[0] == refusals[1], "the same answer for any number of threads");
    if (!meshes[0]) {
        check(names_a_place(refusals[0]), "a refusal that names a line or a byte");
        return false;
    }
    check_mesh(*meshes[0]);
    check(same_bits(meshes[0]->positions, meshes[1]->positions) && same_bits(meshes[0]->normals, meshes[1]->normals) &&
              same_bits(meshes[0]->colours, meshes[1]->colours) && meshes[0]->indices == meshes[1]->indices && meshes[0]->notes == meshes[1]->notes,
          "the same mesh for any number of threads");
    return true;
}

}  // namespace relievo::fuzz
