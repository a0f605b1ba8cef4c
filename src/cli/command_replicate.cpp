#include "cli/commands.h"

#include "cli/options.h"
#include "cli/progress_display.h"
#include "core/error.h"
#include "core/suggest.h"
#include "pipeline/replicate.h"
#include "techniques/catalogue.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

namespace relievo {

namespace {

using Json = nlohmann::ordered_json;

Json ranking_json(const std::vector<Ranked>& ranking) {
    Json list = Json::array();
    for (const Ranked& r : ranking)
        list.push_back({{"technique", r.technique->id}, {"place", r.place}, {"published_place", r.published_place ? Json(*r.published_place) : Json(nullptr)},
                        {"error_class", r.error_class}, {"wrong", r.wrong}, {"time_ratio", r.time_ratio}});
    return list;
}

Json replication_json(const Replication& replication) {
    Json json{{"published_source", published_tests_source}, {"device", replication.device}, {"driver", replication.driver}, {"width", replication.width},
              {"height", replication.height}, {"runs", replication.runs}, {"tests", Json::array()}};
    for (const ReplicatedTest& test : replication.tests) {
        Json one{{"test", test.test->id}, {"scene", test.test->scene}, {"view", test.test->view}, {"colour_texels", test.test->colour_texels},
                 {"height_texels", test.test->height_texels}, {"runs", Json::array()}};
        for (const ReplicatedRun& run : test.runs) {
            Json knobs = Json::object();
            for (const KnobDefault& k : run.technique->knobs) knobs[std::string(k.knob->id)] = k.knob->get(run.params);
            one["runs"].push_back({{"technique", run.technique->id}, {"knobs", knobs}, {"gpu_ms", run.ms}, {"frames_per_second", run.frames_per_second()},
                                   {"published_frames_per_second", run.published ? Json(run.published->frames_per_second) : Json(nullptr)},
                                   {"time_ratio", run.time_ratio}, {"published_time_ratio", run.published_ratio ? Json(*run.published_ratio) : Json(nullptr)},
                                   {"wrong", run.wrong}, {"missed_first_hit", run.missed}, {"uv_p99_texels", run.uv_p99_texels}, {"fetches", run.fetches}});
        }
        json["tests"].push_back(std::move(one));
    }
    json["ranking"] = ranking_json(replication.ranking);
    json["ranking_with_others"] = ranking_json(replication.with_others);
    return json;
}

std::vector<const PublishedTest*> parse_tests(const std::vector<std::string>& texts) {
    std::vector<const PublishedTest*> tests;
    for (const std::string& text : texts) {
        const PublishedTest* test = find_published_test(text);
        if (test == nullptr) {
            std::vector<std::string> known;
            for (const PublishedTest& t : published_tests()) known.emplace_back(t.id);
            throw UsageError(unknown_word("test", text, known));
        }
        if (std::ranges::find(tests, test) == tests.end()) tests.push_back(test);
    }
    return tests;
}

}  // namespace

void add_replicate_command(CLI::App& app, const CommandLine& command_line) {
    struct Options {
        ReplicateSettings settings;
        std::vector<std::string> tests, techniques;
        std::string size = "448x252";
        bool only_published = false, no_cache = false, json = false, quiet = false;
    };
    auto o = std::make_shared<Options>();
    const std::string command = command_line.text;
    auto* verb = app.add_subcommand("replicate", "Runs the eight tests of a published comparison again and measures what was judged by eye; with fur: those of a thesis on fur");
    verb->add_option("--test", o->tests, "test_1 to test_8, comma-separated or repeated (default: all; relievo list tests)")->delimiter(',');
    auto* techniques_option = verb->add_option("--technique", o->techniques, "further techniques beside the published ones, at their defaults (default: all)");
    verb->add_flag("--only-published", o->only_published, "no further techniques")->excludes(techniques_option);
    verb->add_option("--size", o->size, "picture size, WIDTHxHEIGHT")->capture_default_str();
    verb->add_option("--runs", o->settings.runs, "timed runs of each technique, interleaved")->check(CLI::Range(1, 10000))->capture_default_str();
    verb->add_option("--device", o->settings.device, "software, or part of a device's name (relievo list devices)");
    verb->add_option("--threads", o->settings.threads, "threads of the CPU work (0: all cores)")->check(CLI::NonNegativeNumber);
    verb->add_flag("--no-cache", o->no_cache, "bake every map anew");
    verb->add_flag("--quiet", o->quiet, "no progress");
    verb->add_flag("--json", o->json, "print every number as JSON instead of tables");
    verb->add_option("--page", o->settings.page, "FILE.md: also write the page that sets both rankings beside each other and says why they differ");
    verb->footer("Examples:\n  relievo replicate\n  relievo replicate --test test_7,test_8 --only-published --json\n"
                 "  relievo replicate --page docs/replication.md");
    add_replicate_fur_command(*verb, command_line);
    verb->callback([o, command, verb] {
        if (!verb->get_subcommands().empty()) return;  // another comparison
        ReplicateSettings& s = o->settings;
        s.tests = parse_tests(o->tests);
        s.techniques = parse_techniques(o->techniques);
        if (s.techniques.empty() && !o->only_published)
            for (const Technique& t : techniques()) s.techniques.push_back(&t);
        const Size size = parse_size(o->size);
        s.width = size.width;
        s.height = size.height;
        s.use_cache = !o->no_cache;
        s.command = command;
        const Replication replication = replicate(s, progress_display(o->quiet));
        std::fputs(o->json ? (replication_json(replication).dump(2) + "\n").c_str() : replication_text(replication).c_str(), stdout);
    });
}

}  // namespace relievo
