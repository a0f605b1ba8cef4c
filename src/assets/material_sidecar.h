// material.toml: what the pictures of a material cannot say. Every key may be left out.
//
//   height_scale = 0.05        # amplitude of the relief in UV units: 0.02 m deep on a 2 m tile is 0.01; in (0, 1]
//   physical_size_m = 2.0      # edge length of one repeat in metres
//   zero_level = 1.0           # height of the polygon: 1 = carved below it, 0 = raised above it; in [0, 1]
//   white_is_high = true       # false: the height map is a depth map
//   normal_y = "up"            # where the normals' green points: "up" (OpenGL) or "down" (DirectX)
//
//   [files]                    # relative to this file; for names that are not recognised, or to choose among several
//   colour = "rock.png"
//   height = "rock_v2.exr"
//   normal = "rock_n.png"
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace relievo {

struct MaterialSidecar {
    std::optional<float> height_scale;
    std::optional<float> physical_size_m;
    std::optional<float> zero_level;
    std::optional<bool> white_is_high;
    std::optional<bool> normal_y_up;
    std::optional<std::string> colour, height, normal;
};

// Throws Error naming file and line for what is no TOML, an unknown key (with the nearest known one), a wrong type or a value out
// of range.
MaterialSidecar read_sidecar(const std::filesystem::path& file);

// Writes the keys that are set, whole or not at all. Throws Error.
void write_sidecar(const std::filesystem::path& file, const MaterialSidecar& sidecar);

}  // namespace relievo
