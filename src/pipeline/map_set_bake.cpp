#include "pipeline/map_set_bake.h"

#include "core/error.h"
#include "maps/height_from_normal.h"
#include "maps/map_kinds.h"
#include "maps/mip_chain.h"
#include "pipeline/map_cache.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace relievo {

namespace {

// Mid grey of a photographer's card, 50 % in linear light: shading is judged, not taste.
constexpr std::uint8_t neutral_grey = 188;

template <class T>
Digest digest_of(const Image<T>& image, int threads) {
    return content_digest(std::as_bytes(std::span(image.texels)), threads);
}

// Sizes and texels of everything the material brought; absent maps count as absent, not as empty bytes.
std::string input_hash(const Material& m, const Digest& heights, int threads) {
    std::string text;
    const auto add = [&](std::string_view name, const auto& image, const Digest& digest) {
        text += std::string(name) + ' ' + std::to_string(image.width) + 'x' + std::to_string(image.height) + ' ' + hex(digest) + '\n';
    };
    if (!m.height.empty()) add("height", m.height.texels, heights);
    if (m.normal) add("normal", *m.normal, digest_of(*m.normal, threads));
    if (m.colour) add("colour", *m.colour, digest_of(*m.colour, threads));
    const Digest digest = sha256(std::as_bytes(std::span(text)));
    return hex(std::span(digest).first(16));
}

void check(const Material& m) {
    const std::string subject = "the maps of material " + m.name;
    if (m.height.empty() && (!m.normal || m.normal->empty()))
        throw Error("bake", subject, "it has neither heights nor normals", "give it a height map, or a normal map to integrate");
    // The searches below rely on it, and a NaN would spread over everything that sees it.
    for (const float h : m.height.texels.texels)
        if (!(h >= 0 && h <= 1)) throw Error("bake", subject, "a height is not a number in [0,1]", "bring the heights into that range");
    if (!(m.height_scale > 0) || !std::isfinite(m.height_scale))
        throw Error("bake", subject, "its height_scale is " + std::to_string(m.height_scale), "give a positive amplitude in UV units");
}

std::string percent(double share) {
    char text[32];
    std::snprintf(text, sizeof text, "%.1f %%", 100 * share);
    return text;
}

// Heights for a material that has only normals, at the height_scale that those normals imply.
void integrate(Material& m, const BakeOptions& options) {
    IntegratedHeight found = height_from_normal(*m.normal, options.threads, options.progress);
    if (found.height_scale > 0) m.height_scale = found.height_scale;
    char scale[32];
    std::snprintf(scale, sizeof scale, "%.4g", static_cast<double>(m.height_scale));
    m.notes.push_back(found.height_scale > 0
                          ? "There was no height map: heights were integrated from the normals, whose slopes imply a height_scale of " +
                                std::string(scale) + "; " + percent(found.inconsistency) + " of the slopes belong to no surface."
                          : "There was no height map, and the normals are flat: so is the relief.");
    m.height = std::move(found.height);
}

}  // namespace

std::vector<Map> maps_to_draw(std::span<const Technique* const> techniques, std::span<const DrawOptions> options) {
    MapFlags needed;
    for (const Map m : {Map::height, Map::normal, Map::colour}) needed.set(index_of(m));
    for (const Technique* t : techniques)
        for (const Map m : t->maps) needed.set(index_of(m));
    for (const DrawOptions& o : options) needed |= maps_of(o);
    std::vector<Map> maps;
    for (const Map m : every_map)
        if (needed[index_of(m)]) maps.push_back(m);
    return maps;
}

BakedMaps bake_maps(Material material, std::span<const Map> wanted, const BakeOptions& options) {
    check(material);
    const int threads = options.threads;
    const auto wants = [&](Map map) { return std::ranges::find(wanted, map) != wanted.end(); };

    Digest heights = digest_of(material.height.texels, threads);
    BakedMaps baked;
    baked.input_hash = input_hash(material, heights, threads);
    if (material.height.empty()) {
        integrate(material, options);
        heights = digest_of(material.height.texels, threads);
    }
    baked.height_scale = material.height_scale;
    baked.zero_level = material.zero_level;
    if (material.physical_size_m) baked.physical_size_m = *material.physical_size_m;
    baked.notes = std::move(material.notes);

    MapSet& maps = baked.maps;
    maps.height = std::move(material.height);
    if (wants(Map::normal) && material.normal) maps.normal = normal_mip_chain(std::move(*material.normal), threads);
    if (wants(Map::colour)) {
        Image8 grey(1, 1, 4, neutral_grey);
        grey(0, 0, 3) = 255;
        maps.colour = colour_mip_chain(material.colour ? std::move(*material.colour) : std::move(grey), threads);
    }
    const auto bake_now = [&](const MapKind& kind, const MapBake& bake) {
        DeviceBaker* device = options.machine != nullptr ? options.machine->baker_of(kind.map) : nullptr;
        if (device == nullptr) {
            kind.bake(maps, bake);
            return;
        }
        try {
            maps.*kind.image = device->bake(kind.map, maps.height, bake);
            baked.device = device->device_name();
        } catch (const Error& e) {
            if (options.machine->insists()) throw;
            baked.notes.push_back("The CPU baked instead of the GPU: " + std::string(e.what()));
            kind.bake(maps, bake);
        }
    };
    const auto folder = options.use_cache ? MapCache::default_folder() : std::nullopt;
    for (const MapKind& kind : map_kinds()) {
        if (kind.bake == nullptr || !wants(kind.map) || (kind.map == Map::normal && !maps.normal.empty())) continue;
        const MapBake bake{.height_scale = baked.height_scale, .threads = threads, .progress = options.progress};
        if (!folder || kind.cached_version == 0) {
            bake_now(kind, bake);
            continue;
        }
        const MapKey key{.map_id = kind.id, .baker_version = kind.cached_version, .width = maps.height.width(), .height = maps.height.height(), .content = heights};
        if (auto cached = MapCache(*folder).find(key)) {
            maps.*kind.image = std::move(*cached);
            baked.from_cache = true;
        } else {
            bake_now(kind, bake);
            MapCache(*folder).store(key, maps.*kind.image);
        }
    }
    return baked;
}

}  // namespace relievo
