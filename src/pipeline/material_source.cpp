#include "pipeline/material_source.h"

#include "assets/material_file.h"
#include "core/error.h"
#include "core/suggest.h"
#include "scenes/scene.h"
#include "textures/procedural.h"

#include <filesystem>

namespace relievo {

namespace {

namespace fs = std::filesystem;

Material make_procedural(const Scene& scene, const MaterialSource& source) {
    Material material = procedural_material(scene.id, source.procedural_size, source.seed, source.threads);
    material.height_scale = scene.height_scale;
    return material;
}

// What a source names: one of our scenes, or files.
struct Found {
    const Scene* scene = nullptr;
    MaterialFiles files = {};
    std::vector<std::string> notes = {};
};

Found find_source(const MaterialSource& source) {
    const bool named_files = !source.colour.empty() || !source.height.empty() || !source.normal.empty();
    if (source.folder.empty() && !named_files) throw UsageError("no material named: --material FOLDER, or --height FILE, or the id of a procedural one");

    Found found;
    std::error_code ignored;
    if (!source.folder.empty() && !fs::exists(source.folder, ignored)) {
        if (const Scene* scene = find_scene(source.folder); scene != nullptr && !named_files) return {.scene = scene};
        std::vector<std::string> ids;
        for (const Scene& s : scenes()) ids.emplace_back(s.id);
        const std::string near = nearest_word(source.folder, ids);
        throw Error("open material", source.folder, "there is no such folder",
                    near.empty() ? "Give a folder of maps, or a procedural material (relievo list scenes)."
                                 : "Did you mean the procedural material '" + near + "'?");
    }
    if (!source.folder.empty()) found.files = find_material_files(source.folder, found.notes);
    if (!source.colour.empty()) found.files.colour = source.colour;
    if (!source.height.empty()) found.files.height = source.height;
    if (!source.normal.empty()) found.files.normal = source.normal;
    return found;
}

}  // namespace

void check_source(const MaterialSource& source) { find_source(source); }

Material load_source(const MaterialSource& source) {
    const Found found = find_source(source);
    if (found.scene != nullptr) return make_procedural(*found.scene, source);
    Material material = load_material(found.files);
    material.notes.insert(material.notes.begin(), found.notes.begin(), found.notes.end());
    return material;
}

}  // namespace relievo
