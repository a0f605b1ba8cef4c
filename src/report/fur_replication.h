// A published comparison of fur in layers, run again beside strands in object space, as one value, and its texts: JSON (all of it, and back,
// so that an interrupted run goes on), CSV (a line per trial), a table for the terminal and a page.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace relievo {

// Evangelista (2009), tables 7.6 and 7.7: frames per second on a GeForce 8600GT at 1280x800, the same for both densities.
struct PublishedFur {
    std::string_view mesh;
    std::size_t faces;
    double fps_8_layers_2_percent, fps_8_layers_5_percent, fps_16_layers_2_percent, fps_16_layers_5_percent;
};
std::span<const PublishedFur> published_fur();
std::optional<double> published_fur_fps(std::string_view mesh, int layers, double height_percent);
inline constexpr double published_fur_heights[] = {2.0, 5.0};     // percent of the radius
inline constexpr double published_fur_densities[] = {10.0, 20.0};  // percent of the map's texels
inline constexpr int published_fur_layers[] = {8, 16};

struct FurTrial {
    std::string mode;        // as in fur_modes
    int layers = 0;
    bool chosen = false;     // the mode's own choice of layers
    double ms = 0;           // median of a frame
    double frame_flip = 0;   // of one frame against the curves
    double flip = 0;         // of several averaged
    double coverage_error = 0, gaps = 0;  // of the averaged picture
};

// One mesh at one height and density.
struct FurUnit {
    std::string mesh;
    std::string from;        // the file, or how it was made
    std::size_t faces = 0, published_faces = 0;
    double height_percent = 0, density_percent = 0;
    std::size_t strands = 0; // of the reference and of mode strands
    std::vector<FurTrial> trials;
};

struct FurReplication {
    std::string device;
    int width = 0, height = 0, passes = 0, samples = 0;
    bool stand_ins = false;  // no folder of meshes was given
    std::vector<FurUnit> units;
};

// Whether strands keep what they promise beside uniform layers, in one unit. By single frames.
struct FurVerdict {
    const FurTrial* layers = nullptr;        // the uniform ones
    const FurTrial* as_good = nullptr;       // the quickest of strands whose FLIP is no higher; null: none
    const FurTrial* as_quick = nullptr;      // the best of strands that take no longer; null: none
    double speedup() const { return as_good == nullptr ? 0 : layers->ms / as_good->ms; }
    bool faster() const { return as_good != nullptr && as_good->ms < layers->ms; }
    bool better() const { return as_quick != nullptr && as_quick->frame_flip < layers->frame_flip; }
};
FurVerdict fur_verdict(const FurUnit& unit, std::string_view rival, int layers);

std::string fur_replication_json(const FurReplication& replication);
// Throws Error where the text is none of ours.
FurReplication fur_replication_from(const std::string& json, const std::string& file);
std::string fur_replication_csv(const FurReplication& replication);
std::string fur_replication_text(const FurReplication& replication, bool markdown = false);
std::string fur_replication_page(const FurReplication& replication, const std::string& command);

}  // namespace relievo
