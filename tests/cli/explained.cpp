// explain and effects from outside: figures, numbers, words; the same again; what people get wrong.
#include "cli/materials.h"
#include "cli/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>

namespace relievo::test {

namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

Words explain(const Words& more) {
    Words words{"explain", "--material", "cobbles", "--texels", "64", "--quiet"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

}  // namespace

TEST(Explained, NumbersAndFigureOfOneRay) {
    const Folder folder;
    const std::string svg = folder / "ray.svg";
    const Words words = explain({"--technique", "linear_search,max_mip_tracing", "--technique", "parallax_mapping", "--set", "max_steps=400", "--uv", "0.3,0.6", "--elevation", "30",
                                 "--azimuth", "200", "--json", "--out", svg});
    const Ended ended = run(words);
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.err, "");
    const Json json = Json::parse(ended.out, nullptr, false);
    ASSERT_TRUE(json.is_object()) << ended.out;
    ASSERT_EQ(json["searches"].size(), 3u);
    for (const Json& search : json["searches"]) EXPECT_EQ(search["steps"].size(), search["fetches"].get<std::size_t>());
    EXPECT_EQ(json["searches"][0]["knobs"]["max_steps"], 400);
    EXPECT_EQ(json["searches"][1]["knobs"]["max_steps"], 400);
    // The exact search stands on the truth; 400 equal steps are late by at most one.
    EXPECT_NEAR(json["searches"][1]["error_texels"].get<double>(), 0, 1e-2);
    EXPECT_NEAR(json["searches"][1]["height"].get<double>(), json["truth"]["height"].get<double>(), 1e-4);
    const double step = json["searches"][0]["steps"][1]["texels"].get<double>() - json["searches"][0]["steps"][0]["texels"].get<double>();
    EXPECT_GE(json["searches"][0]["error_texels"].get<double>(), -1e-2);
    EXPECT_LE(json["searches"][0]["error_texels"].get<double>(), step + 1e-2);

    const std::string figure = read_text(svg);
    EXPECT_TRUE(figure.starts_with("<svg ")) << figure.substr(0, 80);
    for (const char* title : {"Linear search", "Maximum mipmap tracing", "Parallax mapping"}) EXPECT_NE(figure.find(title), std::string::npos) << title;
    EXPECT_EQ(run(words).out, ended.out);
    EXPECT_EQ(read_text(svg), figure);

    // As text, one line for each.
    const Ended text = run(explain({"--technique", "linear_search,max_mip_tracing", "--view", "grazing", "--size", "64x36", "--pixel", "32,20"}));
    EXPECT_EQ(text.code, 0) << text.err;
    EXPECT_NE(text.out.find("Pixel 32,20 of 64 x 36, view grazing"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("linear_search "), std::string::npos);
    EXPECT_NE(text.out.find("on the first hit"), std::string::npos) << text.out;
}

TEST(Explained, PicturesOfEverySizeAndPaper) {
    const Folder folder;
    int height = 0;
    for (const char* scale : {"1", "0.5"}) {
        const std::string png = folder / (std::string(scale) + ".png");
        const Ended ended = run(explain({"--technique", "relief_mapping", "--scale", scale, "--out", png}));
        ASSERT_EQ(ended.code, 0) << ended.err;
        const ImageFileInfo info = read_image_info(png);
        EXPECT_EQ(info.width, 1000 * std::stod(scale));
        if (height > 0) {
            EXPECT_NEAR(info.height, height * 0.5, 1);
        }
        height = info.height;
    }
    const Image8 light = read_image_8(folder / "1.png", FirstRow::top);
    ASSERT_EQ(run(explain({"--technique", "relief_mapping", "--scale", "1", "--paper", "dark", "--out", folder / "dark.png"})).code, 0);
    const Image8 dark = read_image_8(folder / "dark.png", FirstRow::top);
    EXPECT_GT(light(1, 1, 0), 240);
    EXPECT_LT(dark(1, 1, 0), 50);
}

TEST(Explained, MistakesAreNamed) {
    const Folder folder;
    const auto wrong = [&](int code, const Words& more, const std::string& said) {
        const Ended ended = run(explain(more));
        EXPECT_EQ(ended.code, code) << ended.err;
        EXPECT_EQ(ended.out, "");
        EXPECT_NE(ended.err.find(said), std::string::npos) << "not said: " << said << "\n" << ended.err;
    };
    wrong(2, {}, "--technique");
    wrong(2, {"--technique", "relief"}, "'relief_mapping'");
    wrong(2, {"--technique", "relief_mapping,linear_search", "--set", "max_step=3"}, "'max_steps'");
    wrong(2, {"--technique", "relief_mapping", "--pixel", "12"}, "640,360");
    wrong(2, {"--technique", "relief_mapping", "--pixel", "12,13x"}, "640,360");
    wrong(2, {"--technique", "relief_mapping", "--pixel", "1280,3"}, "outside of the picture of 1280 x 720");
    wrong(2, {"--technique", "relief_mapping", "--uv", "0.1;0.2"}, "0.25,0.5");
    wrong(2, {"--technique", "relief_mapping", "--uv", "nan,0.2"}, "between -1000 and 1000");
    wrong(2, {"--technique", "relief_mapping", "--uv", "0.1,0.2", "--pixel", "3,4"}, "--uv");
    wrong(2, {"--technique", "relief_mapping", "--elevation", "20"}, "--uv");
    wrong(2, {"--technique", "relief_mapping", "--uv", "0.1,0.2", "--elevation", "0"}, "--elevation");
    wrong(2, {"--technique", "relief_mapping", "--out", folder / "a.pdf"}, ".svg or .png");
    wrong(2, {"--technique", "relief_mapping", "--paper", "either", "--out", folder / "a.png"}, "light or dark");
    wrong(1, {"--technique", "relief_mapping", "--uv", "0.1,0.2", "--elevation", "90"}, "straight down");
    wrong(1, {"--technique", "relief_mapping", "--view", "grazing", "--pixel", "0,0"}, "does not meet the polygon");
    wrong(1, {"--technique", "relief_mapping", "--out", folder / "none/a.svg"}, "none/a.svg");
    EXPECT_TRUE(files_below(folder.path()).empty());
}

TEST(Explained, EffectsAsTableAndJson) {
    const Ended table = run({"effects", "--technique", "binary_search,relief_mapping", "--quiet"});
    EXPECT_EQ(table.code, 0);
    EXPECT_EQ(table.err, "");
    EXPECT_NE(table.out.find("# yes"), std::string::npos) << table.out;
    EXPECT_NE(table.out.find("Not as published"), std::string::npos);
    const Json json = Json::parse(run({"effects", "--json", "--quiet"}).out, nullptr, false);
    ASSERT_TRUE(json.is_object());
    EXPECT_EQ(json["effects"].size(), 4u);
    const Json list = Json::parse(run({"list", "--json"}).out, nullptr, false);
    EXPECT_EQ(json["techniques"].size(), list.size());
    for (const Json& row : json["techniques"])
        for (const Json& effect : json["effects"]) {
            const Json& cell = row[effect["id"].get<std::string>()];
            EXPECT_EQ(cell["present"], cell["share"].get<double>() >= effect["present_from"].get<double>()) << row;
            if (cell["published"].is_boolean() && cell["published"] != cell["present"]) {
                EXPECT_GT(cell["reason"].get<std::string>().size(), 20u) << row;
            }
        }
    const Ended slip = run({"effects", "--technique", "relief"});
    EXPECT_EQ(slip.code, 2);
    EXPECT_NE(slip.err.find("'relief_mapping'"), std::string::npos);
}

TEST(Explained, EffectsOfFur) {
    EXPECT_EQ(run({"effects", "--fur", "--technique", "relief_mapping"}).code, 2);
    EXPECT_EQ(run({"effects", "--device", "software"}).code, 2);
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Ended ended = run({"effects", "--fur", "--json", "--quiet"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const Json json = Json::parse(ended.out, nullptr, false);
    EXPECT_EQ(json["modes"].size(), Json::parse(run({"list", "fur", "--json"}).out, nullptr, false).size());
    for (const Json& row : json["modes"])
        for (const Json& effect : json["effects"]) {
            const Json& cell = row[effect["id"].get<std::string>()];
            EXPECT_EQ(cell["present"], cell["share"].get<double>() >= effect["present_from"].get<double>()) << row;
            EXPECT_EQ(cell["present"], cell["claimed"]) << row;
        }
}

}  // namespace relievo::test
