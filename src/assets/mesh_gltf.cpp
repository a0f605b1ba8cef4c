// glTF 2.0 (Khronos, 2021): the triangles of a scene as one mesh, every node's transform applied.
#include "core/error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>

#include "assets/gltf_accessor.h"
#include "assets/json_place.h"
#include "assets/mesh_assembly.h"
#include "assets/mesh_formats.h"
#include "assets/polygon_list.h"

namespace relievo {

namespace {

using nlohmann::json;

// An affine map, columns of a 3x3 matrix and a translation.
struct Affine {
    Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin;

    Vec3d direction(Vec3d v) const { return x * v.x + y * v.y + z * v.z; }
    Vec3d point(Vec3d p) const { return direction(p) + origin; }
    double determinant() const { return dot(x, cross(y, z)); }
    // Normals go by the transposed inverse; times the determinant it is the matrix of cofactors.
    Vec3d normal(Vec3d n) const { return cross(y, z) * n.x + cross(z, x) * n.y + cross(x, y) * n.z; }
    friend Affine operator*(const Affine& a, const Affine& b) { return {a.direction(b.x), a.direction(b.y), a.direction(b.z), a.point(b.origin)}; }
    bool identity() const { return x == Vec3d(1, 0, 0) && y == Vec3d(0, 1, 0) && z == Vec3d(0, 0, 1) && origin == Vec3d(0.0); }
};

std::vector<double> numbers(const json& object, const char* key, std::vector<double> otherwise) {
    if (!object.contains(key)) return otherwise;
    const auto given = object.at(key).get<std::vector<double>>();
    return given.size() == otherwise.size() ? given : otherwise;
}

Affine transform_of(const json& node) {
    if (node.contains("matrix")) {
        const auto m = numbers(node, "matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1});
        return {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}, {m[12], m[13], m[14]}};
    }
    const auto t = numbers(node, "translation", {0, 0, 0}), q = numbers(node, "rotation", {0, 0, 0, 1}), s = numbers(node, "scale", {1, 1, 1});
    const double x = q[0], y = q[1], z = q[2], w = q[3];
    return {Vec3d(1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w)) * s[0],
            Vec3d(2 * (x * y - z * w), 1 - 2 * (x * x + z * z), 2 * (y * z + x * w)) * s[1],
            Vec3d(2 * (x * z + y * w), 2 * (y * z - x * w), 1 - 2 * (x * x + y * y)) * s[2], {t[0], t[1], t[2]}};
}

// sRGB's transfer function (IEC 61966-2-1): glTF's vertex colours are linear light, ours are encoded.
float encoded(float linear) {
    const float c = std::clamp(linear, 0.0f, 1.0f);
    return c <= 0.0031308f ? 12.92f * c : 1.055f * std::pow(c, 1 / 2.4f) - 0.055f;
}

class SceneReader {
public:
    SceneReader(const json& document, std::string_view text, std::string_view bytes, std::string_view binary, const ReadUri& read_uri, const std::string& file)
        : document_(document), data_(document, text, bytes, binary, read_uri, file), file_bytes_(bytes.size()), file_(file) {}

    Mesh read(int threads) {
        refuse_unknown_extensions();
        if (!document_.contains("nodes")) {
            for (std::size_t m = 0; m < size_of("meshes"); ++m) add_mesh(static_cast<std::int64_t>(m), {});
        } else {
            add_scene();
        }
        if (passed_over_ > 0) mesh_.notes.push_back(std::to_string(passed_over_) + " primitives of points or lines were passed over: only faces make a mesh.");
        finish_mesh(mesh_, faults_, file_bytes_, file_, threads);
        return std::move(mesh_);
    }

    const json& reading() const { return data_.reading(); }

private:
    std::size_t size_of(const char* key) const { return document_.contains(key) ? document_.at(key).size() : 0; }

    const json& item(const char* key, std::int64_t index) const {
        if (index < 0 || index >= static_cast<std::int64_t>(size_of(key))) data_.fail(size_of(key) > 0 ? document_.at(key) : document_, std::string(key) + " has no entry " + std::to_string(index));
        return document_.at(key).at(static_cast<std::size_t>(index));
    }

    std::vector<std::int64_t> integers(const json& array) const {
        std::vector<std::int64_t> values;
        for (const json& value : array) values.push_back(data_.integer(value));
        return values;
    }

    void refuse_unknown_extensions() const {
        if (!document_.contains("extensionsRequired")) return;
        for (const json& name : document_.at("extensionsRequired")) {
            // Those that change no triangle.
            const auto& text = name.get_ref<const std::string&>();
            const bool harmless = text == "KHR_mesh_quantization" || text.starts_with("KHR_materials") || text.starts_with("KHR_texture") ||
                                  text.starts_with("EXT_texture") || text == "KHR_lights_punctual";
            if (!harmless) data_.fail(name, "it requires the extension " + text + ", which is not read here");
        }
    }

    void add_scene() {
        std::vector<std::int64_t> roots;
        if (size_of("scenes") > 0) {
            const std::int64_t scene = document_.contains("scene") ? data_.integer(document_.at("scene")) : 0;
            const json& object = item("scenes", scene);
            data_.read_at(object);
            if (object.contains("nodes")) roots = integers(object.at("nodes"));
        } else {
            std::vector<bool> child(size_of("nodes"));
            for (const json& node : document_.at("nodes"))
                if (node.contains("children"))
                    for (const std::int64_t c : integers(node.at("children")))
                        if (c >= 0 && c < static_cast<std::int64_t>(child.size())) child[static_cast<std::size_t>(c)] = true;
            for (std::size_t n = 0; n < child.size(); ++n)
                if (!child[n]) roots.push_back(static_cast<std::int64_t>(n));
            if (roots.empty() && !child.empty()) data_.fail(document_.at("nodes"), "every node is another one's child: the nodes form a circle");
        }
        // A node has one parent at most, so that a walk meets each once; a second time means a circle or a shared child.
        std::vector<bool> met(size_of("nodes"));
        struct Visit {
            std::int64_t node;
            Affine parent;
        };
        std::vector<Visit> open;
        for (auto root = roots.rbegin(); root != roots.rend(); ++root) open.push_back({*root, {}});
        while (!open.empty()) {
            const Visit visit = open.back();
            open.pop_back();
            const json& node = item("nodes", visit.node);
            data_.read_at(node);
            if (met[static_cast<std::size_t>(visit.node)]) data_.fail(node, "node " + std::to_string(visit.node) + " is reached twice: the nodes are no tree");
            met[static_cast<std::size_t>(visit.node)] = true;
            const Affine transform = visit.parent * transform_of(node);
            // The vertices of a skinned mesh lie in the skeleton's space, whatever its node says.
            if (node.contains("mesh")) add_mesh(data_.integer(node.at("mesh")), node.contains("skin") ? Affine{} : transform);
            if (node.contains("children")) {
                const auto children = integers(node.at("children"));
                for (auto child = children.rbegin(); child != children.rend(); ++child) open.push_back({*child, transform});
            }
        }
    }

    void add_mesh(std::int64_t index, const Affine& transform) {
        const json& mesh = item("meshes", index);
        data_.read_at(mesh);
        for (const json& primitive : mesh.at("primitives")) add_primitive(primitive, transform);
    }

    std::vector<float> attribute(const json& attributes, const char* name, std::size_t at_least, std::size_t vertices, std::size_t& components) {
        if (!attributes.contains(name)) return {};
        std::vector<float> values = data_.floats(data_.integer(attributes.at(name)), components);
        if (components < at_least) data_.fail(attributes.at(name), std::string(name) + " has " + std::to_string(components) + " components, expected " + std::to_string(at_least));
        if (values.size() / components != vertices)
            data_.fail(attributes.at(name), std::string(name) + " has " + std::to_string(values.size() / components) + " elements for " + std::to_string(vertices) + " positions");
        return values;
    }

    // Nodes may show one mesh many times: a few bytes could ask for more memory than there is.
    void check_amount(const json& primitive, std::size_t vertices, std::size_t indices) {
        // The last term is for the time that a primitive takes, however few triangles it has.
        constexpr std::size_t always = 64 << 20, times = 64, for_a_primitive = 1024;
        bytes_ += 12 * vertices + 4 * indices + for_a_primitive;
        if (bytes_ > always && bytes_ / times > file_bytes_) data_.fail(primitive, "its nodes repeat meshes until they hold more than " + std::to_string(times) + " times the file");
        if (mesh_.positions.size() + vertices > max_vertices) data_.fail(primitive, "it holds more than 2^32 vertices");
    }

    void add_primitive(const json& primitive, const Affine& transform) {
        data_.read_at(primitive);
        const std::int64_t mode = primitive.contains("mode") ? data_.integer(primitive.at("mode")) : 4;
        if (mode < 0 || mode > 6) data_.fail(primitive.at("mode"), "a primitive has the unknown mode " + std::to_string(mode));
        if (mode < 4) {
            ++passed_over_;
            return;
        }
        if (primitive.contains("extensions") && primitive.at("extensions").contains("KHR_draco_mesh_compression"))
            data_.fail(primitive, "a primitive is compressed with Draco, which is not read here");
        const json& attributes = primitive.at("attributes");
        const std::int64_t position = data_.integer(attributes.at("POSITION"));
        const std::size_t n = data_.count(position);
        const bool indexed = primitive.contains("indices");
        check_amount(primitive, n, indexed ? data_.count(data_.integer(primitive.at("indices"))) * (mode == 4 ? 1 : 3) : n * (mode == 4 ? 1 : 3));

        std::size_t components = 0;
        const std::vector<float> positions = attribute(attributes, "POSITION", 3, n, components);
        const auto base = static_cast<std::uint32_t>(mesh_.positions.size());
        for (std::size_t i = 0; i < n; ++i) {
            const float* const p = &positions[i * components];
            mesh_.positions.push_back(transform.identity() ? Vec3f(p[0], p[1], p[2]) : narrowed(transform.point(Vec3d(Vec3f(p[0], p[1], p[2])))));
        }
        const std::vector<float> normals = attribute(attributes, "NORMAL", 3, n, components);
        const bool mirrored = transform.determinant() < 0;
        if (!normals.empty()) mesh_.normals.resize(base);
        for (std::size_t i = 0; i < n && !normals.empty(); ++i) {
            const Vec3f given(normals[i * components], normals[i * components + 1], normals[i * components + 2]);
            Vec3d turned = transform.identity() ? Vec3d(given) : transform.normal(Vec3d(given)) * (mirrored ? -1.0 : 1.0);
            const double square = dot(turned, turned);
            if (!transform.identity() && square > 0 && std::isfinite(square)) turned = turned / std::sqrt(square);
            mesh_.normals.push_back(narrowed(turned));
        }
        const std::vector<float> uvs = attribute(attributes, "TEXCOORD_0", 2, n, components);
        if (!uvs.empty()) mesh_.uvs.resize(base);
        for (std::size_t i = 0; i < n && !uvs.empty(); ++i) mesh_.uvs.emplace_back(uvs[i * components], 1 - uvs[i * components + 1]);  // v runs down there
        const std::vector<float> colours = attribute(attributes, "COLOR_0", 3, n, components);
        if (!colours.empty()) mesh_.colours.resize(base, Vec3f(1.0f));
        for (std::size_t i = 0; i < n && !colours.empty(); ++i)
            mesh_.colours.emplace_back(encoded(colours[i * components]), encoded(colours[i * components + 1]), encoded(colours[i * components + 2]));
        // Attributes that only some primitives have.
        if (!mesh_.normals.empty()) mesh_.normals.resize(mesh_.positions.size());
        if (!mesh_.uvs.empty()) mesh_.uvs.resize(mesh_.positions.size());
        if (!mesh_.colours.empty()) mesh_.colours.resize(mesh_.positions.size(), Vec3f(1.0f));

        std::vector<std::uint32_t> indices;
        if (indexed) {
            indices = data_.indices(data_.integer(primitive.at("indices")));
        } else {
            indices.resize(n);
            for (std::size_t i = 0; i < n; ++i) indices[i] = static_cast<std::uint32_t>(i);
        }
        add_triangles(indices, mode, n, base, mirrored);
    }

    void add_triangles(const std::vector<std::uint32_t>& indices, std::int64_t mode, std::size_t vertices, std::uint32_t base, bool mirrored) {
        const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            if (a >= vertices || b >= vertices || c >= vertices) {
                ++faults_.faces_out_of_range;
                return;
            }
            if (mode != 4 && (a == b || b == c || c == a)) return;  // strips turn corners with such
            if (mirrored) std::swap(b, c);
            mesh_.indices.insert(mesh_.indices.end(), {base + a, base + b, base + c});
        };
        const std::size_t n = indices.size();
        if (mode == 4) {
            for (std::size_t i = 0; i + 3 <= n; i += 3) add(indices[i], indices[i + 1], indices[i + 2]);
            if (n % 3 != 0) ++faults_.faces_degenerate;
        } else {
            for (std::size_t i = 2; i < n; ++i) {
                if (mode == 6)
                    add(indices[0], indices[i - 1], indices[i]);
                else if (i % 2 == 0)
                    add(indices[i - 2], indices[i - 1], indices[i]);
                else
                    add(indices[i - 1], indices[i - 2], indices[i]);
            }
        }
    }

    // The cast of a double beyond every float is undefined.
    static Vec3f narrowed(Vec3d v) {
        const auto one = [](double d) { return std::abs(d) <= 0x1.fffffefp127 ? static_cast<float>(d) : std::isnan(d) ? NAN : d > 0 ? INFINITY : -INFINITY; };
        return {one(v.x), one(v.y), one(v.z)};
    }

    const json& document_;
    GltfData data_;
    std::size_t file_bytes_;
    const std::string& file_;
    Mesh mesh_;
    MeshFaults faults_;
    std::size_t passed_over_ = 0, bytes_ = 0;
};

std::uint32_t word(std::string_view bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
}

// The JSON and the binary chunk of a GLB.
void split_glb(std::string_view bytes, std::string_view& text, std::string_view& binary, const std::string& file) {
    if (bytes.size() < 20) throw Error("read", file, "it ends at byte " + std::to_string(bytes.size()) + ", within its header");
    if (word(bytes, 4) != 2) throw Error("read", file, "byte 4: it is glTF of version " + std::to_string(word(bytes, 4)) + ", read is version 2");
    if (word(bytes, 8) > bytes.size())
        throw Error("read", file, "byte 8: it promises " + std::to_string(word(bytes, 8)) + " bytes and has " + std::to_string(bytes.size()), "copy the file again");
    bytes = bytes.substr(0, word(bytes, 8));
    for (std::size_t at = 12; at + 8 <= bytes.size();) {
        const std::uint32_t length = word(bytes, at), type = word(bytes, at + 4);
        if (length > bytes.size() - at - 8)
            throw Error("read", file, "byte " + std::to_string(at) + ": a chunk promises " + std::to_string(length) + " bytes, more than are left", "copy the file again");
        const std::string_view chunk = bytes.substr(at + 8, length);
        if (type == 0x4e4f534a && text.empty()) text = chunk;      // "JSON"
        if (type == 0x004e4942 && binary.empty()) binary = chunk;  // "BIN"
        at += 8 + length + (4 - length % 4) % 4;
    }
    if (text.empty()) throw Error("read", file, "byte 12: it has no JSON chunk");
}

}  // namespace

Mesh parse_gltf(std::string_view bytes, const std::string& file, const ReadUri& read_uri, int threads) {
    std::string_view text, binary;
    if (bytes.starts_with("glTF"))
        split_glb(bytes, text, binary, file);
    else
        text = bytes;
    const auto at_byte = [&](std::size_t in_text) { return "byte " + std::to_string(in_text + static_cast<std::size_t>(text.data() - bytes.data())) + ": "; };
    json document;
    try {
        document = json::parse(text);
    } catch (const json::parse_error& e) {
        throw Error("read", file, at_byte(e.byte) + "it is no JSON");
    } catch (const json::out_of_range& e) {  // a number: the message ends with it, in quotes
        const std::string what = e.what();
        const std::size_t quote = what.find('\'');
        const std::size_t at = quote == std::string::npos ? 0 : text.find(std::string_view(what).substr(quote + 1, what.rfind('\'') - quote - 1));
        throw Error("read", file, at_byte(at == std::string_view::npos ? 0 : at) + "a number is larger than numbers of JSON are read");
    }
    const auto fail = [&](const json& value, const std::string& why) { return Error("read", file, at_byte(byte_of(text, document, value)) + why); };
    if (!document.is_object() || !document.contains("asset")) throw fail(document, "it is JSON but no glTF: it has no \"asset\"");
    SceneReader reader(document, text, bytes, binary, read_uri, file);
    try {
        const std::string version = document.at("asset").value("version", "2.0");
        if (!version.starts_with("2")) throw fail(document.at("asset"), "it is glTF of version " + version + ", read is version 2");
        return reader.read(threads);
    } catch (const json::exception& e) {
        const std::string what = e.what();
        throw fail(reader.reading(), "its JSON is no glTF: " + what.substr(what.find("] ") == std::string::npos ? 0 : what.find("] ") + 2));
    }
}

}  // namespace relievo
