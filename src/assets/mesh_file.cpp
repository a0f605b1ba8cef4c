#include "assets/mesh_file.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <string>

#include "assets/atomic_file.h"
#include "assets/file_bytes.h"
#include "assets/mesh_formats.h"

namespace relievo {

namespace {

// The ending that tells the format: "obj" of "dragon.obj" and of "dragon.OBJ.gz".
std::string ending_of(const std::filesystem::path& file, bool& compressed) {
    const auto lower = [](const std::filesystem::path& extension) {
        std::string ending = extension.string();
        if (!ending.empty()) ending.erase(0, 1);
        std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
        return ending;
    };
    compressed = lower(file.extension()) == "gz";
    return lower(compressed ? file.stem().extension() : file.extension());
}

std::string name_of(const std::filesystem::path& file) {
    bool compressed = false;
    ending_of(file, compressed);
    return compressed ? file.stem().stem().string() : file.stem().string();
}

std::string read_beside(const std::filesystem::path& folder, const std::string& uri) {
    const std::filesystem::path path(uri);
    const bool remote = uri.find("://") != std::string::npos;
    if (remote || path.is_absolute() || folder.empty()) throw Error("read", uri, "it is no file beside it", "save it with its buffers, as GLB for instance");
    return std::string(FileBytes::open(folder / path).view());
}

Mesh parse_plain(std::string_view bytes, const std::string& ending, const std::string& file, const std::filesystem::path& folder, int threads, const Forget& forget = {}) {
    const auto read_uri = [&](const std::string& uri) { return read_beside(folder, uri); };
    if (bytes.empty()) throw Error("read", file, "byte 0: the file is empty");
    if (is_mesh_cache(bytes)) return parse_mesh_cache(bytes, file, threads);
    if (bytes.starts_with("ply") && bytes.size() > 3 && (bytes[3] == '\n' || bytes[3] == '\r' || bytes[3] == ' ')) return parse_ply(bytes, file, threads);
    if (bytes.starts_with("glTF")) return parse_gltf(bytes, file, read_uri, threads);
    if (ending == "obj") return parse_obj(bytes, file, threads, forget);
    if (ending == "off") return parse_off(bytes, file, threads);
    if (ending == "stl") return parse_stl(bytes, file, threads);
    if (ending == "gltf" || ending == "glb") return parse_gltf(bytes, file, read_uri, threads);
    if (ending == "ply") throw Error("read", file, "byte 0: it does not begin with \"ply\"");
    if (ending == "rmesh") throw Error("read", file, "byte 0: it is no mesh cache of relievo");
    throw Error("read", file, ending.empty() ? "its name has no ending that tells the format" : "\"." + ending + "\" is no format of meshes known here",
                "known: obj, ply, off, stl, gltf, glb, rmesh, each also with .gz");
}

}  // namespace

Mesh parse_mesh(std::string_view bytes, const std::string& ending, const std::string& file, const std::filesystem::path& folder, int threads) {
    if (!is_gzip(bytes)) return parse_plain(bytes, ending, file, folder, threads);
    return parse_plain(FileBytes::inflate(bytes, file).view(), ending, file, folder, threads);
}

Mesh load_mesh(const std::filesystem::path& file, int threads) {
    bool compressed = false;
    const std::string ending = ending_of(file, compressed);
    const FileBytes bytes = FileBytes::open(file);
    const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : std::filesystem::path(".");
    Mesh mesh = parse_plain(bytes.view(), ending, file.string(), folder, threads, [&](std::string_view part) { bytes.forget(part); });
    if (mesh.name.empty()) mesh.name = name_of(file);
    return mesh;
}

void save_mesh(const std::filesystem::path& file, const Mesh& mesh, int threads, const std::vector<Vec4f>& tangents) {
    bool compressed = false;
    const std::string ending = ending_of(file, compressed);
    if (!tangents.empty() && ending != "glb" && ending != "gltf")
        throw Error("write", file.string(), "its format has no place for tangents", "write a .glb or .gltf file");
    std::string bytes;
    if (ending == "obj")
        bytes = write_obj(mesh, threads);
    else if (ending == "ply")
        bytes = write_ply(mesh);
    else if (ending == "glb")
        bytes = write_glb(mesh, tangents);
    else if (ending == "gltf")
        bytes = write_gltf(mesh, tangents);
    else if (ending == "rmesh")
        bytes = write_mesh_cache(mesh, threads);
    else
        throw Error("write", file.string(), ending.empty() ? "its name has no ending that tells the format" : "\"." + ending + "\" is no format of meshes written here",
                    "known: obj, ply, gltf, glb, rmesh, each also with .gz");
    write_file_atomically(file, compressed ? gzip(bytes) : bytes);
}

}  // namespace relievo
