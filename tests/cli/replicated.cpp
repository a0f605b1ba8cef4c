// replicate: the published tests run with their settings, ranked by what was measured; and the page that is kept of it.
#include "cli/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace relievo::test {

namespace {

using Json = nlohmann::json;

// What a page says apart from one machine's numbers.
std::string without_measured(std::string text) {
    const std::string open = "<!-- measured -->", close = "<!-- /measured -->";
    for (std::size_t from = 0; (from = text.find(open, from)) != std::string::npos; from += open.size()) {
        const std::size_t end = text.find(close, from);
        if (end == std::string::npos) break;
        text.erase(from + open.size(), end - from - open.size());
    }
    return text;
}

Json replicate(const std::vector<std::string>& more) {
    std::vector<std::string> words{"replicate", "--size", "48x27", "--runs", "1", "--device", "software", "--quiet", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    const Ended ended = run(words);
    EXPECT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.err, "");
    return Json::parse(ended.out, nullptr, false);
}

}  // namespace

TEST(Replicated, RunsThePublishedSettings) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Json json = replicate({"--test", "test_2,test_8", "--only-published"});
    ASSERT_TRUE(json.is_object());
    ASSERT_EQ(json["tests"].size(), 2u);
    const Json& test = json["tests"][0];
    EXPECT_EQ(test["test"], "test_2");
    EXPECT_EQ(test["height_texels"], 256);
    ASSERT_EQ(test["runs"].size(), 8u);
    EXPECT_EQ(test["runs"][4]["technique"], "linear_search");
    EXPECT_EQ(test["runs"][4]["knobs"]["max_steps"], 90);
    EXPECT_EQ(test["runs"][4]["published_frames_per_second"], 700);
    EXPECT_NEAR(test["runs"][4]["published_time_ratio"].get<double>(), 2893.0 / 700, 1e-9);
    for (const Json& run : test["runs"]) {
        EXPECT_NEAR(run["time_ratio"].get<double>(), run["gpu_ms"].get<double>() / test["runs"][0]["gpu_ms"].get<double>(), 1e-9);
        EXPECT_NEAR(run["frames_per_second"].get<double>() * run["gpu_ms"].get<double>(), 1000, 1e-6);
        EXPECT_GE(run["wrong"].get<double>(), run["missed_first_hit"].get<double>());
        EXPECT_LE(run["wrong"].get<double>(), 1);
    }
    // Test 8 had four techniques; the ranking needs all eight, so the others run at their defaults.
    const Json& last = json["tests"][1];
    ASSERT_EQ(last["runs"].size(), 8u);
    int published = 0;
    for (const Json& run : last["runs"]) published += run["published_frames_per_second"].is_null() ? 0 : 1;
    EXPECT_EQ(published, 4);
    EXPECT_EQ(last["runs"][1]["knobs"]["max_steps"], 40);
    EXPECT_EQ(last["runs"][1]["knobs"]["refine_steps"], 6);

    // Places go by error class and then by time; a higher class is never better.
    const Json& ranking = json["ranking"];
    ASSERT_EQ(ranking.size(), 8u);
    for (std::size_t i = 0; i < ranking.size(); ++i) {
        EXPECT_EQ(ranking[i]["place"], i + 1);
        if (i == 0) continue;
        EXPECT_GE(ranking[i]["error_class"], ranking[i - 1]["error_class"]);
        if (ranking[i]["error_class"] == ranking[i - 1]["error_class"]) {
            EXPECT_GE(ranking[i]["time_ratio"], ranking[i - 1]["time_ratio"]);
        } else {
            EXPECT_GT(ranking[i]["wrong"].get<double>(), ranking[i - 1]["wrong"].get<double>());
        }
    }
    EXPECT_EQ(json["ranking"], json["ranking_with_others"]);
}

TEST(Replicated, KeepsItsPage) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const Json json = replicate({"--page", folder / "page.md"});
    // What was not compared then runs beside it without being asked for.
    const Json list = Json::parse(run({"list", "--json"}).out, nullptr, false);
    EXPECT_EQ(json["ranking_with_others"].size(), list.size());
    const std::string page = read_text(folder / "page.md");
    const std::string kept = read_text(std::filesystem::path(RELIEVO_SOURCE_DIR) / "docs" / "replication.md");
    EXPECT_TRUE(without_measured(page) == without_measured(kept)) << "docs/replication.md is not what the program writes; run: relievo replicate --page docs/replication.md";
    EXPECT_EQ(page.find("not explained yet"), std::string::npos);
    EXPECT_NE(page.find("Maximum mipmap tracing"), std::string::npos);
}

TEST(Replicated, MistakesAreNamed) {
    const Folder folder;
    const auto wrong = [&](int code, std::vector<std::string> words, const std::string& said) {
        words.insert(words.begin(), "replicate");
        const Ended ended = run(words);
        EXPECT_EQ(ended.code, code) << ended.err;
        EXPECT_EQ(ended.out, "");
        EXPECT_NE(ended.err.find(said), std::string::npos) << "not said: " << said << "\n" << ended.err;
    };
    wrong(2, {"--test", "test_9"}, "'test_");
    wrong(2, {"--technique", "relief"}, "'relief_mapping'");
    wrong(2, {"--technique", "relief_mapping", "--only-published"}, "--only-published");
    wrong(2, {"--size", "64"}, "WIDTHxHEIGHT");
    wrong(2, {"--runs", "0"}, "--runs");
    wrong(2, {"--page", folder / "page.html"}, ".md");
    wrong(1, {"--page", folder / "none/page.md"}, "none/page.md");
    EXPECT_TRUE(files_below(folder.path()).empty());
}

}  // namespace relievo::test
