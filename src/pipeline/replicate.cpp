#include "pipeline/replicate.h"

#include "assets/atomic_file.h"
#include "core/error.h"
#include "measure/hits.h"
#include "pipeline/map_set_bake.h"
#include "pipeline/reference_picture.h"
#include "pipeline/shown_picture.h"
#include "render/gpu_renderer.h"
#include "techniques/catalogue.h"
#include "textures/procedural.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>

namespace relievo {

namespace {

constexpr std::string_view baseline_id = "normal_mapping";  // whose time the ranking's costs are multiples of

double median(std::vector<double> values) {
    std::ranges::sort(values);
    const std::size_t n = values.size();
    return n % 2 == 1 ? values[n / 2] : (values[n / 2 - 1] + values[n / 2]) / 2;
}

// A relief on the device. Several tests look at one.
struct Relief {
    BakedMaps baked;
    std::shared_ptr<const GpuMaterial> material;
};

// The test's relief: colour in its own size.
BakedMaps maps_of(const PublishedTest& test, const std::vector<ReplicatedRun>& runs, const ReplicateSettings& s, const Progress& progress) {
    const Scene& scene = *find_scene(test.scene);
    Material material = procedural_material(scene.id, test.height_texels, 1, s.threads);
    if (test.colour_texels != test.height_texels) material.colour = procedural_material(scene.id, test.colour_texels, 1, s.threads).colour;
    material.height_scale = scene.height_scale;
    std::vector<Map> wanted{Map::height, Map::normal, Map::colour};
    for (const ReplicatedRun& run : runs)
        for (const Map m : run.technique->maps) wanted.push_back(m);
    return bake_maps(std::move(material), wanted, {.threads = s.threads, .use_cache = s.use_cache, .progress = progress});
}

std::vector<ReplicatedRun> runs_of(const PublishedTest& test, const ReplicateSettings& s) {
    std::vector<ReplicatedRun> runs;
    const auto add = [&](const Technique& technique, const PublishedRun* published) {
        if (std::ranges::find(runs, &technique, &ReplicatedRun::technique) != runs.end()) return;
        ReplicatedRun run{.technique = &technique, .params = default_params(technique), .published = published};
        if (published != nullptr)
            for (const KnobDefault& k : published->knobs) k.knob->set(run.params, k.value);
        runs.push_back(run);
    };
    for (const PublishedRun& p : test.runs) add(*find_technique(p.technique), &p);
    // What the ranking needs in every test, and what was asked for besides.
    for (const PublishedPlace& p : published_ranking()) add(*find_technique(p.technique), nullptr);
    for (const Technique* t : s.techniques) add(*t, nullptr);
    return runs;
}

using Reliefs = std::map<std::tuple<std::string_view, int, int>, Relief>;

ReplicatedTest run_test(const PublishedTest& test, GpuRenderer& gpu, Reliefs& reliefs, const ReplicateSettings& s, const Progress& progress) {
    ReplicatedTest result{.test = &test, .runs = runs_of(test, s)};
    Relief& relief = reliefs[{test.scene, test.colour_texels, test.height_texels}];
    if (relief.material == nullptr) {
        relief.baked = maps_of(test, result.runs, s, progress);
        relief.material = gpu.upload(relief.baked.maps, relief.baked.height_scale, relief.baked.zero_level);
    }
    const BakedMaps& baked = relief.baked;
    const auto& material = relief.material;
    const Stage stage = stage_for(*parse_view(test.view));
    const RayField rays = gpu.rays(stage, *material, s.width, s.height, {0, 0});
    // The published shaders search and shade; a shadow would be a second search.
    DrawOptions unshadowed;
    unshadowed.shadow = glsl::shadow_none;
    const Frame truth = reference_picture(stage, baked.maps, {&rays, 1},
                                          {.height_scale = baked.height_scale, .zero_level = baked.zero_level, .options = unshadowed, .threads = s.threads}, progress);
    std::vector<GpuRenderer::Timed> timed;
    for (const ReplicatedRun& run : result.runs) timed.push_back({run.technique, run.params, unshadowed});
    const std::vector<Frame> frames = gpu.draw_timed(stage, *material, timed, {.width = s.width, .height = s.height, .options = unshadowed}, s.runs, progress);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        ReplicatedRun& run = result.runs[i];
        const HitMetrics m = hit_metrics(frames[i], truth, rays, {baked.maps.height.width(), baked.maps.height.height()}, s.threads);
        run.ms = median(frames[i].gpu_ms);
        run.missed = *m.missed_first_hit;
        run.wrong = *m.missed_first_hit + *m.early_hit;
        run.uv_p99_texels = m.uv_error_texels ? m.uv_error_texels->p99 : 0;
        run.fetches = m.fetches ? m.fetches->mean : 0;
    }
    for (ReplicatedRun& run : result.runs) {
        run.time_ratio = run.ms / result.runs.front().ms;
        if (run.published != nullptr) run.published_ratio = result.runs.front().published->frames_per_second / run.published->frames_per_second;
    }
    return result;
}

Ranked over_all(const Technique& technique, const std::vector<ReplicatedTest>& tests) {
    Ranked r{.technique = &technique};
    double log_ratio = 0;
    for (const ReplicatedTest& test : tests) {
        const auto run_with = [&](const Technique* t) { return std::ranges::find(test.runs, t, &ReplicatedRun::technique); };
        const auto run = run_with(&technique);
        r.wrong += run->wrong / static_cast<double>(tests.size());
        log_ratio += std::log(run->ms / run_with(find_technique(baseline_id))->ms);
    }
    r.time_ratio = std::exp(log_ratio / static_cast<double>(tests.size()));
    const auto published = std::ranges::find(published_ranking(), technique.id, &PublishedPlace::technique);
    if (published != published_ranking().end()) r.published_place = published->place;
    return r;
}

}  // namespace

std::vector<Ranked> ranked(std::vector<Ranked> list) {
    std::ranges::stable_sort(list, {}, &Ranked::wrong);
    double best = -1;
    int error_class = 0;
    for (Ranked& r : list) {
        if (best < 0 || r.wrong > std::max(best * 1.25, best + 0.001)) {
            best = r.wrong;
            ++error_class;
        }
        r.error_class = error_class;
    }
    std::ranges::stable_sort(list, [](const Ranked& a, const Ranked& b) {
        return a.error_class != b.error_class ? a.error_class < b.error_class : a.time_ratio < b.time_ratio;
    });
    for (std::size_t i = 0; i < list.size(); ++i) list[i].place = static_cast<int>(i) + 1;
    return list;
}

Replication replicate(const ReplicateSettings& settings, const Progress& progress) {
    if (!settings.page.empty() && !settings.page.ends_with(".md")) throw UsageError("--page " + settings.page + ": a page is written as .md");
    if (!settings.page.empty()) require_writable(settings.page);
    std::vector<const PublishedTest*> tests = settings.tests;
    if (tests.empty())
        for (const PublishedTest& t : published_tests()) tests.push_back(&t);
    GpuRenderer gpu(settings.device, false);
    Replication result{.device = gpu.device_name(), .driver = gpu.driver(), .width = settings.width, .height = settings.height, .runs = settings.runs, .tests = {}, .ranking = {}, .with_others = {}};
    Reliefs reliefs;
    for (std::size_t i = 0; i < tests.size(); ++i) {
        // One line over all tests; the steps inside one only say that it goes on.
        const double begin = static_cast<double>(i) / static_cast<double>(tests.size());
        const Progress inside = [&](std::string_view, double share) {
            report(progress, "replicating " + std::string(tests[i]->id), begin + share * 0.3 / static_cast<double>(tests.size()));
        };
        result.tests.push_back(run_test(*tests[i], gpu, reliefs, settings, inside));
        report(progress, "replicating " + std::string(tests[i]->id), begin + 1.0 / static_cast<double>(tests.size()));
    }
    std::vector<Ranked> published, all;
    for (const ReplicatedRun& run : result.tests.front().runs) {
        all.push_back(over_all(*run.technique, result.tests));
        if (all.back().published_place) published.push_back(all.back());
    }
    result.ranking = ranked(std::move(published));
    result.with_others = ranked(std::move(all));
    if (!settings.page.empty()) write_file_atomically(settings.page, replication_page(result, settings.command));
    return result;
}

}  // namespace relievo
