#include "textures/procedural.h"

#include "core/error.h"
#include "core/parallel_for.h"
#include "textures/curves.h"
#include "textures/materials.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace relievo {

namespace {

struct Entry {
    ProceduralMaterial material;
    SurfaceFunction (*surface)(const Detail&);
};

// The ids are also those of the scenes that show them, which hold each one's height_scale.
constexpr Entry entries[] = {
    {.material = {.id = "bricks",
                  .title = "Brick wall",
                  .summary = "fired clay in running bond, chipped, with raked sandy joints",
                  .physical_size_m = 0.69f},
     .surface = bricks},
    {.material = {.id = "cobbles",
                  .title = "Cobblestones",
                  .summary = "river stones of many sizes, bedded in sand",
                  .physical_size_m = 0.80f},
     .surface = cobbles},
    {.material = {.id = "spikes",
                  .title = "Thin spikes",
                  .summary = "iron nails of differing height through dark old planks",
                  .physical_size_m = 0.40f},
     .surface = spikes},
    {.material = {.id = "engraving",
                  .title = "Engraved stone",
                  .summary = "lettering, meander and rosettes cut into veined limestone",
                  .physical_size_m = 0.50f},
     .surface = engraving},
    {.material = {.id = "dunes",
                  .title = "Dunes",
                  .summary = "wind-blown sand: long waves with slip faces, covered in ripples",
                  .physical_size_m = 12.0f},
     .surface = dunes},
};

constexpr auto materials_only = [] {
    std::array<ProceduralMaterial, std::size(entries)> list{};
    for (std::size_t i = 0; i < list.size(); ++i) list[i] = entries[i].material;
    return list;
}();

// Levenshtein's distance: the least number of letters to insert, remove or replace.
int edit_distance(std::string_view a, std::string_view b) {
    std::vector<int> row(b.size() + 1);
    std::iota(row.begin(), row.end(), 0);
    for (std::size_t i = 0; i < a.size(); ++i) {
        int diagonal = row[0]++;
        for (std::size_t j = 0; j < b.size(); ++j) {
            const int replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, diagonal + 1});
        }
    }
    return row.back();
}

[[noreturn]] void fail_unknown(std::string_view id) {
    const auto* nearest = &entries[0];
    std::string known;
    for (const Entry& e : entries) {
        if (edit_distance(id, e.material.id) < edit_distance(id, nearest->material.id)) nearest = &e;
        known += (known.empty() ? "" : ", ") + std::string(e.material.id);
    }
    const bool close = edit_distance(id, nearest->material.id) <= 3;
    throw Error("make", "procedural material '" + std::string(id) + "'", "there is none of that name",
                (close ? "did you mean '" + std::string(nearest->material.id) + "'? " : std::string()) + "known: " + known);
}

std::uint8_t to_byte(float x) { return static_cast<std::uint8_t>(std::floor(saturate(x) * 255 + 0.5f)); }

}  // namespace

std::span<const ProceduralMaterial> procedural_materials() { return materials_only; }

const ProceduralMaterial* find_procedural_material(std::string_view id) {
    const auto it = std::ranges::find(materials_only, id, &ProceduralMaterial::id);
    return it == materials_only.end() ? nullptr : &*it;
}

Material procedural_material(std::string_view id, int size, std::uint32_t seed, int threads) {
    const auto* entry = std::ranges::find(entries, id, [](const Entry& e) { return e.material.id; });
    if (entry == std::end(entries)) fail_unknown(id);
    if (size < 1 || size > 16384) {
        throw Error("make", "procedural material '" + std::string(id) + "'",
                    "its size would be " + std::to_string(size) + " texels", "choose a size from 1 to 16384");
    }

    // Below 512 texels the finest features (joints, nails, letters) fall between texel centres, so a texel averages several
    // samples.
    const int split = (511 + size) / size;
    const float step = 1.0f / static_cast<float>(size * split);
    const SurfaceFunction surface = entry->surface({.seed = seed, .sample_uv = step});

    ImageF height(size, size, 1);
    Image8 colour(size, size, 4);
    std::vector<float> row_low(static_cast<std::size_t>(size));
    std::vector<float> row_high(static_cast<std::size_t>(size));
    parallel_for(size, 4, threads, [&](int begin, int end) {
        for (int j = begin; j < end; ++j) {
            float low = 1e30f;
            float high = -1e30f;
            for (int i = 0; i < size; ++i) {
                double sum = 0;
                Vec3d squares;
                for (int sj = 0; sj < split; ++sj) {
                    for (int si = 0; si < split; ++si) {
                        const SurfacePoint p = surface({(static_cast<float>(i * split + si) + 0.5f) * step,
                                                        (static_cast<float>(j * split + sj) + 0.5f) * step});
                        low = std::min(low, p.height);
                        high = std::max(high, p.height);
                        sum += p.height;
                        const Vec3f c{saturate(p.colour.x), saturate(p.colour.y), saturate(p.colour.z)};
                        squares += Vec3d(Vec3f{c.x * c.x, c.y * c.y, c.z * c.z});
                    }
                }
                const double share = 1.0 / (split * split);
                height(i, j) = static_cast<float>(sum * share);
                // Light averages in linear RGB; a power of 2 stands for sRGB's curve because the square root is exact everywhere.
                std::uint8_t* texel = colour.at(i, j);
                texel[0] = to_byte(static_cast<float>(std::sqrt(squares.x * share)));
                texel[1] = to_byte(static_cast<float>(std::sqrt(squares.y * share)));
                texel[2] = to_byte(static_cast<float>(std::sqrt(squares.z * share)));
                texel[3] = 255;
            }
            row_low[static_cast<std::size_t>(j)] = low;
            row_high[static_cast<std::size_t>(j)] = high;
        }
    });

    // The relief fills [0,1] whatever the seed, so that height_scale means the same for all. The range is that of the samples, not
    // of the averages: a small map keeps the contrast of the large one.
    const float low = *std::ranges::min_element(row_low);
    const float high = *std::ranges::max_element(row_high);
    const float scale = high > low ? 1 / (high - low) : 0;
    for (float& h : height.texels) h = std::floor(saturate((h - low) * scale) * 65535 + 0.5f) / 65535;

    Material material;
    material.name = entry->material.id;
    material.height = HeightField(std::move(height));
    material.colour = std::move(colour);
    material.physical_size_m = entry->material.physical_size_m;
    return material;
}

}  // namespace relievo
