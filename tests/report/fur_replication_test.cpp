// The published figures as the thesis prints them, the verdicts on made-up trials, and the texts.
#include "report/fur_replication.h"

#include "core/error.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace relievo {
namespace {

FurTrial trial(const std::string& mode, int layers, double ms, double flip, bool chosen = false) {
    FurTrial t;
    t.mode = mode;
    t.layers = layers;
    t.ms = ms;
    t.frame_flip = t.flip = flip;
    t.coverage_error = 0.1 * flip;
    t.chosen = chosen;
    return t;
}

FurReplication sample() {
    FurReplication r;
    r.device = "a device";
    r.width = 1280;
    r.height = 800;
    r.passes = 8;
    r.samples = 4;
    FurUnit u;
    u.mesh = "dragon";
    u.from = "dragon, as it is.ply";
    u.faces = 202520;
    u.published_faces = 202520;
    u.height_percent = 5;
    u.density_percent = 20;
    u.strands = 78643;
    u.trials = {trial("classic", 8, 100, 0.13), trial("classic", 16, 200, 0.12), trial("classic", 32, 400, 0.11), trial("strands", 4, 90, 0.125), trial("strands", 8, 150, 0.08), trial("strands", 20, 420, 0.07, true)};
    r.units.push_back(u);
    return r;
}

TEST(FurReplication, KnowsThePublishedFrameRates) {
    EXPECT_EQ(published_fur().size(), 6u);
    EXPECT_EQ(published_fur_fps("dragon", 16, 5), 23);
    EXPECT_EQ(published_fur_fps("cube", 8, 2), 205);
    EXPECT_EQ(published_fur_fps("buddha", 16, 2), 20);
    EXPECT_EQ(published_fur_fps("armadillo", 8, 5), 76);
    EXPECT_EQ(published_fur_fps("armadillo", 32, 5), std::nullopt);
    EXPECT_EQ(published_fur_fps("teapot", 8, 5), std::nullopt);
    for (const PublishedFur& p : published_fur()) {
        EXPECT_GE(p.fps_8_layers_2_percent, p.fps_8_layers_5_percent);
        EXPECT_GT(p.fps_8_layers_5_percent, p.fps_16_layers_5_percent);
    }
}

TEST(FurReplication, JudgesByEqualErrorAndByEqualTime) {
    const FurReplication r = sample();
    const FurVerdict beside16 = fur_verdict(r.units[0], "classic", 16);
    ASSERT_NE(beside16.as_good, nullptr);
    EXPECT_EQ(beside16.as_good->layers, 8);  // 4 layers are quicker and not as good
    EXPECT_NEAR(beside16.speedup(), 200.0 / 150, 1e-12);
    EXPECT_TRUE(beside16.faster());
    EXPECT_EQ(beside16.as_quick->layers, 8);
    EXPECT_TRUE(beside16.better());
    const FurVerdict beside8 = fur_verdict(r.units[0], "classic", 8);
    EXPECT_EQ(beside8.as_good->layers, 4);
    EXPECT_EQ(beside8.as_quick->layers, 4);
    // Strands that are too slow and too coarse at once.
    FurUnit lost = r.units[0];
    for (FurTrial& t : lost.trials)
        if (t.mode == "strands") {
            t.ms += 1000;
            t.frame_flip += 1;
        }
    const FurVerdict none = fur_verdict(lost, "classic", 16);
    EXPECT_EQ(none.as_good, nullptr);
    EXPECT_EQ(none.as_quick, nullptr);
    EXPECT_FALSE(none.faster() || none.better());
    EXPECT_EQ(fur_verdict(lost, "lapped", 16).layers, nullptr);
}

TEST(FurReplication, ComesBackFromItsJson) {
    const FurReplication r = sample();
    const std::string text = fur_replication_json(r);
    EXPECT_EQ(fur_replication_json(fur_replication_from(text, "state.json")), text);
    EXPECT_NE(text.find("\"published_fps\": 23"), std::string::npos);
    for (const char* bad : {"", "{}", "[1]", "{\"device\": 3}"}) EXPECT_THROW(fur_replication_from(bad, "state.json"), Error) << bad;
}

TEST(FurReplication, WritesTables) {
    const FurReplication r = sample();
    const std::string text = fur_replication_text(r), page = fur_replication_page(r, "relievo replicate fur"), csv = fur_replication_csv(r);
    EXPECT_NE(text.find("Beside 16 uniform layers (classic): at no higher FLIP strands are faster in 1 of 1, by 1.33 times"), std::string::npos) << text;
    EXPECT_NE(text.find("lower in 1 of 1"), std::string::npos);
    EXPECT_NE(page.find("202520"), std::string::npos);
    EXPECT_NE(page.find("`relievo replicate fur`"), std::string::npos);
    EXPECT_EQ(std::ranges::count(csv, '\n'), 7);
    EXPECT_NE(csv.find("\"dragon, as it is.ply\""), std::string::npos);  // a comma would be a column
    EXPECT_NE(fur_replication_text({}).find("nothing"), std::string::npos);
}

}  // namespace
}  // namespace relievo
