#include "cli/commands.h"

#include "cli/material_options.h"
#include "cli/progress_display.h"
#include "core/error.h"
#include "core/suggest.h"
#include "maps/map_kinds.h"
#include "pipeline/bake_map.h"
#include "pipeline/verify_maps.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

namespace relievo {

namespace {

using Json = nlohmann::ordered_json;

// A proof that fails is work that failed: exit code 1, after everything was said.
void verify(const VerifySettings& settings, bool json, bool quiet) {
    const std::vector<VerifiedMap> maps = verify_maps(settings, progress_display(quiet));
    Json all = Json::array();
    std::uint64_t failures = 0;
    for (const VerifiedMap& m : maps) {
        const Verification& p = m.proof;
        if (m.promised) failures += p.violated + p.undecided;
        Json entry{{"map", m.id}, {"claim", m.claim}, {"source", m.source}, {"promised", m.promised}, {"proven_for", p.cones},
                   {"violated", p.violated}, {"undecided", p.undecided}, {"pairs", p.pairs}, {"checks", p.checks}, {"deepest", p.deepest}, {"ms", m.ms}};
        if (p.violated > 0 && m.id != "max_pyramid")
            entry["first"] = {{"texel", {p.first.x, p.first.y}}, {"height", p.first.height}, {"ratio", p.first.ratio}};
        all.push_back(entry);
        if (!json)
            std::printf("%-18s %-13s %9llu of %llu violated (%.2f %%), %llu undecided; %.3g checks decide %.3g pairs; deepest %.1f %%; %.1f s\n", std::string(m.id).c_str(),
                        std::string(m.source).c_str(), static_cast<unsigned long long>(p.violated), static_cast<unsigned long long>(p.cones),
                        100.0 * static_cast<double>(p.violated) / static_cast<double>(p.cones), static_cast<unsigned long long>(p.undecided),
                        static_cast<double>(p.checks), static_cast<double>(p.pairs), 100 * p.deepest, m.ms / 1e3);
    }
    if (json) std::printf("%s\n", all.dump(2).c_str());
    std::fflush(stdout);
    if (failures > 0)
        throw Error("prove", "the maps", std::to_string(failures) + " of their bounds are broken or undecided", "this is a fault of the baker: please report it with the heights");
}

}  // namespace

void add_bake_command(CLI::App& app) {
    struct Options {
        BakeSettings settings;
        std::string map;
        bool no_cache = false, json = false, quiet = false, verify = false;
    };
    auto o = std::make_shared<Options>();
    auto* verb = app.add_subcommand("bake", "Writes one map of a material to a file");
    add_material_options(*verb, o->settings.material);
    auto* map = verb->add_option("--map", o->map, "id of the map (relievo list maps)");
    auto* verifies = verb->add_flag("--verify", o->verify, "prove instead that the maps, as stored in 16 bits, keep what they promise (--map: that one only)");
    verb->add_option("--device", o->settings.device,
                     "that bakes, the same bits on each: cpu; auto, a GPU where there is one that has programs for the map; gpu; software; or part of a device's name")
        ->excludes(verifies)
        ->capture_default_str();
    verb->add_flag("--no-cache", o->no_cache, "bake anew, whatever the cache holds");
    verb->add_flag("--quiet", o->quiet, "no progress and no notes");
    verb->add_flag("--json", o->json, "print {map, size, machine, ms, threads} as JSON");
    verb->add_option("--out", o->settings.out, "FILE.png (8 or 16 bit) or FILE.exr (32-bit float)")->excludes(verifies);
    verb->footer("Examples:\n  relievo bake --material wall --map normal --out wall_normal.png\n"
                 "  relievo bake --material wall --map cone --no-cache --json --out wall_cone.exr\n"
                 "  relievo bake --material wall --map cone --device gpu --json --out wall_cones.exr\n"
                 "  relievo bake --material wall --verify");
    verb->callback([o, map] {
        BakeSettings& s = o->settings;
        if (!o->verify && map->empty()) throw CLI::RequiredError("--map");
        if (!o->verify && s.out.empty()) throw CLI::RequiredError("--out");
        if (o->verify && map->empty()) {
            verify({.material = s.material, .map = {}, .use_cache = !o->no_cache, .threads = s.material.threads}, o->json, o->quiet);
            return;
        }
        const MapKind* kind = find_map_kind(o->map);
        if (kind == nullptr) {
            std::vector<std::string> known;
            for (const MapKind& m : map_kinds()) known.emplace_back(m.id);
            throw UsageError(unknown_word("map", o->map, known));
        }
        s.map = kind->map;
        s.use_cache = !o->no_cache;
        s.threads = s.material.threads;
        if (o->verify) {
            verify({.material = s.material, .map = s.map, .use_cache = s.use_cache, .threads = s.threads}, o->json, o->quiet);
            return;
        }
        const BakedMap baked = bake_map(s, progress_display(o->quiet));
        if (!o->quiet)
            for (const std::string& note : baked.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
        if (o->json) {
            std::printf("%s\n", nlohmann::ordered_json{{"map", o->map},
                                                       {"size", {baked.width, baked.height}},
                                                       {"machine", baked.from_cache ? "cache" : baked.device.empty() ? "CPU" : baked.device},
                                                       {"ms", baked.ms},
                                                       {"start_ms", baked.start_ms},
                                                       {"threads", baked.threads},
                                                       {"from_cache", baked.from_cache},
                                                       {"out", s.out}}
                                    .dump(2)
                                    .c_str());
        } else if (!o->quiet) {
            std::fprintf(stderr, "%s: %s, %d x %d, %.1f ms%s%s\n", s.out.c_str(), o->map.c_str(), baked.width, baked.height, baked.ms,
                         baked.from_cache ? " (from the cache)" : "", baked.device.empty() ? "" : (" on " + baked.device).c_str());
        }
    });
}

}  // namespace relievo
