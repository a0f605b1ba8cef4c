// Materials from other people's files: a folder of pictures, or pictures named one by one.
#pragma once

#include "core/material.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace relievo {

// The files of one material. Height or normal must be there.
struct MaterialFiles {
    std::string name;  // shown to people; empty: from the sidecar's folder or the first file
    std::optional<std::filesystem::path> colour;
    std::optional<std::filesystem::path> height;
    std::optional<std::filesystem::path> normal;
    std::optional<std::filesystem::path> sidecar;  // material.toml, see material_sidecar.h
};

// The maps of a folder, recognised by their names (map_names.h) or named by its material.toml. Two equally good candidates for
// height or normal, none of both, a folder that is missing, empty or no folder throw Error; of several colours the first by name
// is taken. Choices that could have gone otherwise are added to `notes`.
MaterialFiles find_material_files(const std::filesystem::path& folder, std::vector<std::string>& notes);

// Reads the files into one Material. Colours are kept in sRGB, 8 bits; heights as 8, 16 or 32 bits gave them, in [0,1] (floats
// outside are normalised), normals as unit vectors with +Y along +v. Where height and normal are both there they are checked
// against each other (map_agreement.h) and an inverted height or a flipped green channel is read the right way round; the sidecar
// overrides. Whatever was assumed or corrected is a note. Throws Error for what cannot be read or cannot be meant: NaN, a
// colour picture in place of a height, a picture that holds no normals.
Material load_material(const MaterialFiles& files);
Material load_material(const std::filesystem::path& folder);

}  // namespace relievo
