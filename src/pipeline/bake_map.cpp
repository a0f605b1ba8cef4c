#include "pipeline/bake_map.h"

#include "assets/atomic_file.h"
#include "assets/image_file.h"
#include "core/error.h"
#include "core/parallel_for.h"
#include "maps/map_kinds.h"
#include "pipeline/map_set_bake.h"

#include <chrono>
#include <filesystem>
#include <string_view>

namespace relievo {

namespace {

// All levels of the pyramid on one sheet: the finest at the left, the others stacked upward at its right.
ImageF pyramid_sheet(const MaxPyramid& pyramid) {
    const ImageF& finest = pyramid.levels.front();
    const int second = pyramid.levels.size() > 1 ? pyramid.levels[1].width : 0;
    int stacked = 0;
    for (std::size_t k = 1; k < pyramid.levels.size(); ++k) stacked += pyramid.levels[k].height;
    ImageF sheet(finest.width + second, std::max(finest.height, stacked), 1);
    int x0 = 0;
    int y0 = 0;
    for (std::size_t k = 0; k < pyramid.levels.size(); ++k) {
        const ImageF& level = pyramid.levels[k];
        for (int y = 0; y < level.height; ++y)
            for (int x = 0; x < level.width; ++x) sheet(x0 + x, y0 + y) = level(x, y);
        y0 = k == 0 ? 0 : y0 + level.height;
        x0 = finest.width;
    }
    return sheet;
}

// Channels beyond what a file's viewers agree on, as equal tiles from the lower left, four abreast.
ImageF tiled(const ImageF& map) {
    constexpr int abreast = 4;
    const int rows = (map.channels + abreast - 1) / abreast;
    ImageF sheet(map.width * abreast, map.height * rows, 1);
    for (int c = 0; c < map.channels; ++c)
        for (int y = 0; y < map.height; ++y)
            for (int x = 0; x < map.width; ++x) sheet((c % abreast) * map.width + x, (c / abreast) * map.height + y) = map(x, y, c);
    return sheet;
}

// A map as it goes into a file: EXR takes the values as they are; PNG takes values in [0,1], and those of [-1,1] at half their size.
ImageF sheet_of(const MapKind& kind, const MapSet& maps) {
    if (kind.image != nullptr) {
        const ImageF& map = maps.*kind.image;
        return map.channels > static_cast<int>(kind.channels.size()) ? tiled(map) : map;
    }
    switch (kind.map) {
        case Map::height: return maps.height.texels;
        case Map::normal: return maps.normal.front();
        case Map::max_pyramid: return pyramid_sheet(maps.max_pyramid);
        default: break;
    }
    throw UsageError("the " + std::string(kind.id) + " map is not baked; it is the material's own picture");
}

// A PNG has 1, 3 or 4 channels that viewers agree on; two channels get an empty third.
ImageF for_png(const MapKind& kind, const ImageF& in) {
    const int channels = in.channels == 2 ? 3 : in.channels;
    ImageF out(in.width, in.height, channels);
    for (int y = 0; y < in.height; ++y)
        for (int x = 0; x < in.width; ++x)
            for (int c = 0; c < in.channels; ++c) {
                const bool is_signed = kind.map == Map::normal || kind.map == Map::distance;
                const float value = is_signed ? in(x, y, c) * 0.5f + 0.5f : in(x, y, c);
                out(x, y, c) = on_grid(value, kind.channels[static_cast<std::size_t>(c)].rounding);
            }
    return out;
}

}  // namespace

BakedMap bake_map(const BakeSettings& settings, const Progress& progress) {
    const std::filesystem::path out = settings.out;
    const bool exr = out.extension() == ".exr";
    if (!exr && out.extension() != ".png") throw UsageError("--out " + settings.out + ": a map is written as .png or .exr");
    if (exr && settings.map == Map::colour) throw UsageError("--out " + settings.out + ": the colour map is 8-bit sRGB and is written as .png");
    const AtomicFile probe(out);  // an unwritable target is known before the work

    const auto now = [] { return std::chrono::steady_clock::now(); };
    const auto started = now();
    BakeMachine machine = BakeMachine::named(settings.device);
    const bool on_device = machine.baker_of(settings.map) != nullptr;  // so is a device that is not there
    const double start_ms = on_device ? std::chrono::duration<double, std::milli>(now() - started).count() : 0;
    report(progress, "loading", 0);
    Material material = load_source(settings.material);
    report(progress, "baking", 0);  // hears an interruption of the loading
    const auto began = now();
    const Map wanted[] = {settings.map};
    const BakedMaps baked = bake_maps(std::move(material), wanted,
                                      {.threads = settings.threads, .use_cache = settings.use_cache, .progress = progress, .machine = &machine});
    const auto ended = now();

    BakedMap result{.width = 0,
                    .height = 0,
                    .ms = std::chrono::duration<double, std::milli>(ended - began).count(),
                    .start_ms = start_ms,
                    .device = baked.device,
                    .threads = settings.threads > 0 ? settings.threads : default_threads(),
                    .from_cache = baked.from_cache,
                    .notes = baked.notes};
    if (settings.map == Map::colour) {
        const Image8& colour = baked.maps.colour.front();
        result.width = colour.width;
        result.height = colour.height;
        write_png(out, colour, FirstRow::bottom);
    } else {
        const MapKind& kind = map_kind(settings.map);
        const ImageF sheet = sheet_of(kind, baked.maps);
        result.width = sheet.width;
        result.height = sheet.height;
        if (exr) {
            std::vector<ExrChannel> channels;
            for (int c = 0; c < sheet.channels; ++c)
                channels.push_back({std::string(kind.channels[static_cast<std::size_t>(c)].name), &sheet, c});
            write_exr(out, channels, FirstRow::bottom);
        } else {
            write_png_16(out, for_png(kind, sheet), FirstRow::bottom);
        }
    }
    report(progress, "baking", 1);
    return result;
}

}  // namespace relievo
