#include "cli/commands.h"

#include "cli/options.h"
#include "cli/progress_display.h"
#include "effects/effects_table.h"
#include "pipeline/fur_effects.h"
#include "techniques/catalogue.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

namespace relievo {

namespace {

using Json = nlohmann::ordered_json;

Json table_json(const EffectsTable& table) {
    Json json{{"published_source", published_effects_source}, {"effects", Json::array()}, {"techniques", Json::array()}, {"not_measured", Json::array()}};
    for (const EffectKind& kind : effect_kinds())
        json["effects"].push_back({{"id", kind.id}, {"title", kind.title}, {"scene", kind.scene}, {"number", kind.number},
                                   {"present_from", kind.present_from}, {"absent_to", kind.absent_to}});
    for (const EffectRow& row : table.rows) {
        Json one{{"technique", row.technique->id}};
        for (std::size_t k = 0; k < effect_count; ++k) {
            const EffectCell& cell = row.cells[k];
            Json& place = one[std::string(effect_kinds()[k].id)];
            place = {{"share", cell.share}, {"present", cell.present}, {"published", cell.published ? Json(*cell.published) : Json(nullptr)}};
            if (cell.differs()) place["reason"] = cell.reason;
        }
        json["techniques"].push_back(std::move(one));
    }
    for (const PublishedEffects* p : table.not_measured) {
        Json one{{"technique", p->technique}, {"title", p->title}};
        for (const EffectKind& kind : effect_kinds()) one[std::string(kind.id)] = p->effects.*kind.claim;
        json["not_measured"].push_back(std::move(one));
    }
    return json;
}

Json fur_json(const std::vector<FurEffectRow>& rows) {
    Json json{{"effects", Json::array()}, {"modes", Json::array()}};
    for (const FurEffectKind& k : fur_effect_kinds())
        json["effects"].push_back({{"id", k.id}, {"title", k.title}, {"scene", k.scene}, {"number", k.number}, {"present_from", k.present_from}, {"absent_to", k.absent_to}});
    for (const FurEffectRow& row : rows) {
        Json one{{"mode", row.mode->id}};
        for (std::size_t k = 0; k < fur_effect_count; ++k) {
            const FurEffectKind& kind = fur_effect_kinds()[k];
            one[std::string(kind.id)] = {{"share", row.shares[k]}, {"present", row.shares[k] >= kind.present_from}, {"claimed", row.mode->effects.*kind.claim}};
        }
        json["modes"].push_back(std::move(one));
    }
    return json;
}

}  // namespace

void add_effects_command(CLI::App& app) {
    struct Options {
        std::vector<std::string> techniques;
        int threads = 0;
        std::string device;
        bool fur = false, json = false, quiet = false;
    };
    auto o = std::make_shared<Options>();
    auto* verb = app.add_subcommand("effects", "Measures which effects each technique shows, beside the published table");
    verb->add_option("--technique", o->techniques, "ids, comma-separated or repeated (default: all)");
    verb->add_option("--threads", o->threads, "threads to use (0: all cores)")->check(CLI::NonNegativeNumber);
    verb->add_flag("--fur", o->fur, "the modes of fur instead of the techniques, drawn on a device")->excludes("--technique");
    verb->add_option("--device", o->device, "of --fur: software, or part of a device's name (relievo list devices)")->needs("--fur");
    verb->add_flag("--quiet", o->quiet, "no progress");
    verb->add_flag("--json", o->json, "print the table with scenes and thresholds as JSON");
    verb->footer("Examples:\n  relievo effects\n  relievo effects --technique binary_search,relief_mapping --json\n  relievo effects --fur");
    verb->callback([o] {
        if (o->fur) {
            const std::vector<FurEffectRow> rows = fur_effects_table(o->device, progress_display(o->quiet));
            std::fputs(o->json ? (fur_json(rows).dump(2) + "\n").c_str() : fur_effects_text(rows, false).c_str(), stdout);
            return;
        }
        auto list = parse_techniques(o->techniques);
        if (list.empty())
            for (const Technique& t : techniques()) list.push_back(&t);
        const EffectsTable table = effects_table(list, o->threads, progress_display(o->quiet));
        std::fputs(o->json ? (table_json(table).dump(2) + "\n").c_str() : effects_text(table, false).c_str(), stdout);
    });
}

}  // namespace relievo
