// A mesh file in fur as the 2009 thesis has it: layers textured by an environment map.
#pragma once

#include "assets/dds_file.h"
#include "fur/fur_map.h"
#include "fur/map_strands.h"
#include "pipeline/fur_picture.h"
#include "render/layers_renderer.h"

#include <filesystem>

namespace relievo {

struct ClassicSettings {
    MapShape shape = MapShape::cube;
    Addressing addressing = Addressing::normal_plus_position;
    FurMapSettings map{.density = 0.2};  // of each face; its width is the edge, a power of two
    bool filtered = false;
    float height = 0.05f;                // in radii
    int layers = 16;
    CombPaint comb;                      // where strands lean; the picture is read here
    float tilt = 0.7f, bend = 0.6f;      // there, as of a coat
    LayersLight light;
    bool fit_light = false;              // to the reference, where there is one
    Vec3f colour{0.5f, 0.4f, 0.3f};      // of the strands where there is no colour map, linear albedo
    Vec3f skin{0.2f, 0.15f, 0.1f};
    float gloss = 0.4f;                  // of the reference's strands
    std::filesystem::path colour_map;    // a picture; empty: none
    std::filesystem::path fur_map_file, tinted_map_file;  // where the maps are written too; empty: nowhere
    DdsCode dds_code = DdsCode::bc3;
    int width_px = 1280, height_px = 800;
    int passes = 16;
    std::string device;
    bool measure = false;
    int reference_samples = 0;
    int threads = 0;
};

// The mesh as the thesis draws it, in fur space: with normals of its own kind and in the order that draws quickest here. Throws Error.
PaintedSkin classic_skin(Mesh mesh, const CombPaint& comb = {}, int threads = 0);

// The map of strands alone, each face with a seed of its own. Throws Error where the colour map cannot be read.
DirectionMap classic_fur_map(const ClassicSettings& settings, std::vector<std::string>& notes);
std::size_t strands_on(const DirectionMap& fur);
DirectionMap classic_colour_map(const ClassicSettings& settings);

// What a map and the normal can say of a coat: its length and its colours. Its number of strands is the map's.
ClassicSettings classic_of(const Coat& coat);

// How even the map's strands are on the mesh. `grown`: map_strands of both.
Evenness classic_evenness(const Mesh& mesh, const MapStrands& grown, const DirectionMap& fur, int threads = 0);

// What the maps stand for: upright strands of even thickness, that cover the map's density of the skin. `strands`: as many as the map has.
Coat upright_coat(const ClassicSettings& settings, std::size_t strands);

// The light of the layers that brings their picture nearest to the reference, by least squares over the pixels that either covers. The
// picture is a sum of what the ambient, the diffuse and the specular light show and of the skin, so three numbers are a linear fit.
LayersLight fitted_light(LayersRenderer& renderer, const FurView& view, const FurFrames& reference, const LayersLight& start);

// Writes the maps as FILE.dds, block-compressed with all their levels, or as FILE.png: the finest level, a cube's faces side by side in the
// order +x -x +y -y +z -z. With `colour` each texel is tinted by it; else RGB is white. `code` is for DDS. Throws Error.
void write_fur_map(const std::filesystem::path& file, const DirectionMap& fur, const DirectionMap* colour, DdsCode code, int threads = 0);

// `mesh` is in fur space and has unit normals; `comb`, where there is one, has a vector for each vertex.
LayersModel classic_model(const ClassicSettings& settings, const Mesh& mesh, const DirectionMap& fur, const DirectionMap& colour, const std::vector<Vec3f>* comb = nullptr);

// Throws Error.
FurPicture classic_picture(const std::filesystem::path& mesh, const ClassicSettings& settings, const Progress& progress = {});

}  // namespace relievo
