#include "cli/commands.h"

#include "cli/material_options.h"
#include "cli/progress_display.h"
#include "core/error.h"
#include "core/suggest.h"
#include "maps/map_kinds.h"
#include "pipeline/bake_map.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

namespace relievo {

void add_bake_command(CLI::App& app) {
    struct Options {
        BakeSettings settings;
        std::string map;
        bool no_cache = false, json = false, quiet = false;
    };
    auto o = std::make_shared<Options>();
    auto* verb = app.add_subcommand("bake", "Writes one map of a material to a file");
    add_material_options(*verb, o->settings.material);
    verb->add_option("--map", o->map, "id of the map (relievo list maps)")->required();
    verb->add_flag("--no-cache", o->no_cache, "bake anew, whatever the cache holds");
    verb->add_flag("--quiet", o->quiet, "no progress and no notes");
    verb->add_flag("--json", o->json, "print {map, size, ms, threads} as JSON");
    verb->add_option("--out", o->settings.out, "FILE.png (8 or 16 bit) or FILE.exr (32-bit float)")->required();
    verb->footer("Examples:\n  relievo bake --material wall --map normal --out wall_normal.png\n"
                 "  relievo bake --material wall --map cone --no-cache --json --out wall_cone.exr");
    verb->callback([o] {
        BakeSettings& s = o->settings;
        const MapKind* kind = find_map_kind(o->map);
        if (kind == nullptr) {
            std::vector<std::string> known;
            for (const MapKind& m : map_kinds()) known.emplace_back(m.id);
            throw UsageError(unknown_word("map", o->map, known));
        }
        s.map = kind->map;
        s.use_cache = !o->no_cache;
        s.threads = s.material.threads;
        const BakedMap baked = bake_map(s, progress_display(o->quiet));
        if (!o->quiet)
            for (const std::string& note : baked.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
        if (o->json) {
            std::printf("%s\n", nlohmann::ordered_json{{"map", o->map},
                                                       {"size", {baked.width, baked.height}},
                                                       {"ms", baked.ms},
                                                       {"threads", baked.threads},
                                                       {"from_cache", baked.from_cache},
                                                       {"out", s.out}}
                                    .dump(2)
                                    .c_str());
        } else if (!o->quiet) {
            std::fprintf(stderr, "%s: %s, %d x %d, %.1f ms%s\n", s.out.c_str(), o->map.c_str(), baked.width, baked.height, baked.ms,
                         baked.from_cache ? " (from the cache)" : "");
        }
    });
}

}  // namespace relievo
