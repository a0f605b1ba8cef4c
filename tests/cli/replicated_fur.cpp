// replicate fur: one of its units for real, going on from what was kept, and wrong words.
#include "cli/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace relievo::test {
namespace {

using Json = nlohmann::json;

TEST(ReplicatedFur, MeasuresAUnitOnceAndGoesOnFromIt) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const std::string state = folder / "state.json", page = folder / "fur.md", csv = folder / "fur.csv";
    std::vector<std::string> words{"replicate", "fur",     "--mesh",     "torus", "--height", "5",         "--density", "10",      "--size",  "120x75", "--passes", "1", "--rounds", "1",
                                   "--samples", "2",       "--quiet",    "--json", "--state", state,      "--pictures", folder / "pictures", "--page", page, "--csv", csv};
    const Ended first = run(words);
    ASSERT_EQ(first.code, 0) << first.err;
    const Json json = Json::parse(first.out, nullptr, false);
    ASSERT_EQ(json["units"].size(), 1u);
    const Json& unit = json["units"][0];
    EXPECT_EQ(unit["faces"], 384);
    EXPECT_NEAR(unit["strands"].get<double>(), 6 * 256 * 256 * 0.1, 6 * 256 * 256 * 0.1 * 0.05);
    EXPECT_GE(unit["trials"].size(), 6u);
    for (const Json& t : unit["trials"]) {
        EXPECT_GT(t["ms"].get<double>(), 0);
        EXPECT_GT(t["frame_flip"].get<double>(), 0);
        EXPECT_LT(t["frame_flip"].get<double>(), 0.4);
        EXPECT_LT(t["coverage_error"].get<double>(), 0.3);
    }
    EXPECT_EQ(unit["trials"][1]["published_fps"], 110);
    EXPECT_TRUE(std::filesystem::exists(folder / "pictures/torus_5_10.png"));
    EXPECT_NE(read_text(page).find("torus"), std::string::npos);
    EXPECT_NE(read_text(csv).find("torus,made,384"), std::string::npos);
    // Again: the same numbers, times included, as nothing is measured twice.
    const Ended again = run(words);
    EXPECT_EQ(again.out, first.out);
    // And what was kept under other settings is not mixed with these.
    for (std::string& w : words)
        if (w == "120x75") w = "130x75";
    const Ended other = run(words);
    EXPECT_EQ(other.code, 1);
    EXPECT_NE(other.err.find("other settings"), std::string::npos) << other.err;
}

TEST(ReplicatedFur, RefusesWrongWordsWithAWayOn) {
    const Folder folder;
    const std::string broken = folder / "broken.json";
    std::ofstream(broken) << "{";
    std::filesystem::create_directories(folder / "empty");
    const struct {
        std::vector<std::string> words;
        int code;
        const char* said;
    } cases[] = {{{"--mesh", "bunnny"}, 2, "bunny"},
                 {{"--height", "3"}, 2, "--height"},
                 {{"--page", "fur.html"}, 2, ".md"},
                 {{"--state", "fur.txt"}, 2, ".json"},
                 {{"--seconds", "5"}, 2, "--state"},
                 {{"--state", broken}, 1, "remove it"},
                 {{"--mesh", "bunny", "--meshes", folder / "nowhere"}, 1, "nowhere"},
                 {{"--mesh", "bunny", "--meshes", folder / "empty"}, 1, "bunny"}};
    for (const auto& c : cases) {
        if (c.code == 1 && !has_device()) continue;
        std::vector<std::string> all{"replicate", "fur", "--quiet"};
        all.insert(all.end(), c.words.begin(), c.words.end());
        const Ended ended = run(all);
        EXPECT_EQ(ended.code, c.code) << ended.err;
        EXPECT_NE(ended.err.find(c.said), std::string::npos) << ended.err;
    }
}

}  // namespace
}  // namespace relievo::test
