#include "assets/mesh_file.h"

#include "core/error.h"

#include <algorithm>
#include <string>

#include "assets/file_bytes.h"
#include "assets/mesh_formats.h"

namespace relievo {

namespace {

// The ending that tells the format: "obj" of "dragon.obj" and of "dragon.obj.gz".
std::string ending_of(const std::filesystem::path& file) {
    std::filesystem::path name = file.filename();
    if (name.extension() == ".gz") name = name.stem();
    std::string ending = name.extension().string();
    if (!ending.empty()) ending.erase(0, 1);
    std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c); });
    return ending;
}

std::string name_of(const std::filesystem::path& file) {
    std::filesystem::path name = file.filename();
    if (name.extension() == ".gz") name = name.stem();
    return name.stem().string();
}

}  // namespace

Mesh load_mesh(const std::filesystem::path& file, int threads) {
    const FileBytes bytes = FileBytes::open(file);
    const std::string ending = ending_of(file);
    if (ending != "obj") throw Error("read", file.string(), "its ending \"" + ending + "\" is none of a mesh that is read here", "known: obj");
    Mesh mesh = parse_obj(bytes.view(), file.string(), threads);
    mesh.name = name_of(file);
    return mesh;
}

}  // namespace relievo
