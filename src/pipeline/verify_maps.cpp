#include "pipeline/verify_maps.h"

#include "core/error.h"
#include "core/map_set.h"
#include "maps/cell_cone_verifier.h"
#include "maps/map_kinds.h"
#include "maps/pyramid_verifier.h"
#include "maps/quick_cone.h"
#include "maps/safe_rounding.h"
#include "pipeline/map_set_bake.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace relievo {

namespace {

constexpr std::array<Rounding, 4> safe_cone = {Rounding::up, Rounding::down, Rounding::nearest, Rounding::nearest};

struct Context {
    const MapSet& maps;
    int threads;
    const Progress& progress;
};

Verification at_texels(const Context& c, const ImageF& cones, ConePromise promise) {
    return verify_cones(c.maps.height, texel_cones(as_stored(cones, safe_cone)), promise, c.threads, c.progress);
}

Verification of_pyramid(const Context& c) {
    MaxPyramid stored = c.maps.max_pyramid;
    for (ImageF& level : stored.levels) level = as_stored(std::move(level), {Rounding::up, Rounding::up, Rounding::up, Rounding::up});
    const PyramidVerification p = verify_max_pyramid(c.maps.height, stored);
    return {.cones = p.nodes, .pairs = p.cells, .checks = p.checks, .violated = p.violated};
}

// A device holds them in 8 bits (maps/cell_cone.h).
Verification of_cell_cones(const Context& c) {
    ImageF stored = c.maps.cell_cone;
    for (float& v : stored.texels) v = std::round(v * 255.0f) / 255.0f;
    return verify_cell_cone(c.maps.height, stored, c.threads);
}

// Ours first; the published definitions in the order of their years.
struct Row {
    std::string_view id, claim, source;
    bool promised;
    std::optional<Map> map;
    Verification (*verify)(const Context&);
};
constexpr Row rows[] = {
    {"max_pyramid", "no node lies below the surface", "Tevs 2008", true, Map::max_pyramid, of_pyramid},
    {"conservative_cone", "the surface enters no cone", "ours", true, Map::conservative_cone,
     [](const Context& c) { return at_texels(c, c.maps.conservative_cone, ConePromise::conservative); }},
    {"relaxed_cone", "no ray leaves the solid in a cone", "ours", true, Map::relaxed_cone,
     [](const Context& c) { return at_texels(c, c.maps.relaxed_cone, ConePromise::relaxed); }},
    {"cell_cone", "no terrace lies below the surface", "ours", true, Map::cell_cone,
     of_cell_cones},
    {"cone", "the surface enters no cone", "Dummer 2006", false, Map::cone,
     [](const Context& c) { return at_texels(c, c.maps.cone, ConePromise::conservative); }},
    {"quick_cone", "the surface enters no cone", "Valasek 2022", false, std::nullopt,
     [](const Context& c) { return at_texels(c, quick_cone(c.maps.height, c.threads), ConePromise::conservative); }},
    {"robust_cone", "the surface enters no cone, anywhere in a texel", "Ban 2024", false, Map::robust_cone,
     [](const Context& c) {
         return verify_cones(c.maps.height, scattered_cones(c.maps.height, as_stored(c.maps.robust_cone, safe_cone), 1), ConePromise::conservative,
                             c.threads, c.progress);
     }},
};

}  // namespace

std::vector<std::string> verifiable_maps() {
    std::vector<std::string> ids;
    for (const Row& row : rows) ids.emplace_back(row.id);
    return ids;
}

std::vector<VerifiedMap> verify_maps(const VerifySettings& settings, const Progress& progress) {
    std::vector<const Row*> chosen;
    std::vector<Map> wanted;
    for (const Row& row : rows) {
        if (settings.map && row.map != settings.map) continue;
        chosen.push_back(&row);
        if (row.map) wanted.push_back(*row.map);
    }
    if (chosen.empty()) {
        std::string known;
        for (const Row& row : rows)
            if (row.map) known += (known.empty() ? "" : ", ") + std::string(row.id);
        throw UsageError("the " + std::string(map_kind(*settings.map).id) + " map makes no promise that could be verified; these do: " + known);
    }
    report(progress, "loading", 0);
    const BakedMaps baked = bake_maps(load_source(settings.material), wanted, {.threads = settings.threads, .use_cache = settings.use_cache, .progress = progress});
    std::vector<VerifiedMap> verified;
    for (const Row* row : chosen) {
        const auto began = std::chrono::steady_clock::now();
        const Verification proof = row->verify({baked.maps, settings.threads, progress});
        const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began).count();
        verified.push_back({row->id, row->claim, row->source, row->promised, proof, ms});
    }
    return verified;
}

}  // namespace relievo
