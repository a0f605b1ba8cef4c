// The eight tests of a published comparison (scenes/published_tests.h), run again with its step counts and judged by measurement.
#pragma once

#include "core/progress.h"
#include "scenes/published_tests.h"

#include <optional>
#include <string>
#include <vector>

namespace relievo {

struct ReplicateSettings {
    std::vector<const PublishedTest*> tests;     // empty: all
    std::vector<const Technique*> techniques;    // beside the published ones, which always run; at their default knobs
    std::string device;                          // as GpuRenderer takes it
    int width = 448;                             // the published size is not known
    int height = 252;
    int runs = 11;                               // timed runs of each technique, interleaved
    std::string page;                            // .md: replication_page is written there; empty: nowhere
    std::string command;                         // for the page
    bool use_cache = true;
    int threads = 0;
};

struct ReplicatedRun {
    const Technique* technique = nullptr;
    MarchParams params{};
    const PublishedRun* published = nullptr;  // null: not in the published test, so at its default knobs
    double ms = 0;                            // median of the colour pass, one sample a pixel, no shadow
    double time_ratio = 0;                    // over the test's first published technique, same run
    std::optional<double> published_ratio;    // the same from the published frame rates
    double wrong = 0;                         // share of pixels whose hit is off by more than half a texel either way, or missing
    double missed = 0;                        // those that are late or missing
    double uv_p99_texels = 0;
    double fetches = 0;                       // mean

    double frames_per_second() const { return 1000 / ms; }
};

struct ReplicatedTest {
    const PublishedTest* test = nullptr;
    std::vector<ReplicatedRun> runs;  // the published ones in their order, then the others in the catalogue's
};

// Error first: techniques are sorted by `wrong`, and those within a quarter or a thousandth of the pixels of a place's best share its
// error class; inside a class the faster comes first.
struct Ranked {
    const Technique* technique = nullptr;
    int place = 0;
    int error_class = 0;
    double wrong = 0;          // mean over the tests
    double time_ratio = 0;     // geometric mean over the tests, of normal mapping's time
    std::optional<int> published_place;
};

struct Replication {
    std::string device, driver;
    int width = 0, height = 0, runs = 0;
    std::vector<ReplicatedTest> tests;
    std::vector<Ranked> ranking;            // of the techniques of the published ranking
    std::vector<Ranked> with_others;        // of all that ran; the same as `ranking` when nothing else did
};

Replication replicate(const ReplicateSettings& settings, const Progress& progress);

// Sorts by error class and time, and numbers the places. Exposed for its test.
std::vector<Ranked> ranked(std::vector<Ranked> list);

// The tables as columns for a terminal, or as a page that says where and why the rankings differ.
std::string replication_text(const Replication& replication);
std::string replication_page(const Replication& replication, const std::string& command);

}  // namespace relievo
