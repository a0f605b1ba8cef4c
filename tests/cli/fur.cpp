// relievo fur as a user meets it: what the JSON promises, what lands in the file, and what is said of wrong words and meshes.
#include "cli/program.h"

#include "assets/image_file.h"
#include "assets/mesh_file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace relievo::test {
namespace {

using Json = nlohmann::ordered_json;

std::string written(const Folder& folder, const std::string& name, const std::string& text) {
    std::ofstream(folder / name) << text;
    return folder / name;
}

// A tetrahedron far from the origin, with a vertex that nobody uses still farther.
std::string tetrahedron_in(const Folder& folder) {
    return written(folder, "small.obj", "v 101 1 1\nv 101 -1 -1\nv 99 1 -1\nv 99 -1 1\nv 9000 0 0\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n");
}

// Everything but the time it takes is small.
std::vector<std::string> quick(const std::string& mesh, const std::vector<std::string>& more) {
    std::vector<std::string> all{"fur", mesh, "--quiet", "--size", "96", "64", "--passes", "1", "--density", "2"};
    all.insert(all.end(), more.begin(), more.end());
    return all;
}

TEST(Fur, JsonKeepsItsPromiseAndThePictureIsThere) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const std::string out = folder / "fur.png";
    const Ended ended = run(quick(tetrahedron_in(folder), {"--json", "--out", out}));
    ASSERT_EQ(ended.code, 0) << ended.err;
    const Json json = Json::parse(ended.out, nullptr, false);
    std::vector<std::string> keys;
    for (const auto& item : json.items()) keys.push_back(item.key());
    EXPECT_EQ(keys, (std::vector<std::string>{"mode", "preset", "faces", "strands", "density_p95_over_p5", "shared_texel_area", "layers", "ms", "image", "report"}));
    EXPECT_EQ(json["mode"], "strands");
    EXPECT_EQ(json["preset"], "rabbit");
    EXPECT_EQ(json["faces"], 4);
    EXPECT_NEAR(json["strands"].get<double>(), 4000, 400);
    EXPECT_LT(json["density_p95_over_p5"].get<double>(), 1.5);
    EXPECT_EQ(json["shared_texel_area"], 0.0);
    EXPECT_GE(json["layers"].get<int>(), 1);
    for (const char* step : {"load", "roots", "first_frame", "frame_median"}) EXPECT_GT(json["ms"][step].get<double>(), 0) << step;
    EXPECT_EQ(json["image"], out);
    const Image8 picture = read_image_8(out, FirstRow::top);
    EXPECT_EQ(picture.width, 96);
    EXPECT_EQ(picture.height, 64);
    EXPECT_NE(picture(48, 32, 0), picture(0, 0, 0));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 2);  // nothing temporary is left
}

TEST(Fur, PresetsAndSettingsChangeThePicture) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const std::string mesh = tetrahedron_in(folder);
    std::vector<std::string> pictures;
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--preset", "sheep"}, {"--height", "3"}, {"--set", "tilt=0"}, {"--layers", "4"}}) {
        std::vector<std::string> all = quick(mesh, more);
        all.insert(all.end(), {"--out", folder / "fur.png"});
        const Ended ended = run(all);
        ASSERT_EQ(ended.code, 0) << ended.err;
        pictures.push_back(read_text(folder / "fur.png"));
        for (std::size_t i = 0; i + 1 < pictures.size(); ++i) EXPECT_NE(pictures[i], pictures.back()) << i;
    }
}

TEST(Fur, ComparesItselfWithTracedStrands) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const std::string beside = folder / "beside.png";
    const Ended ended = run({"fur", tetrahedron_in(folder), "--quiet", "--size", "160", "120", "--passes", "8", "--density", "4", "--samples", "8", "--reference", beside, "--json"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const Json score = Json::parse(ended.out, nullptr, false)["report"]["reference"];
    // What a coat of the same look but other strands, or of another length, would not reach (measured: 0.088, 0.029 and 0.003).
    EXPECT_LT(score["flip"].get<double>(), 0.15);
    EXPECT_LT(score["coverage_error"].get<double>(), 0.06);
    EXPECT_LT(score["gaps"].get<double>(), 0.02);
    EXPECT_GT(score["flip"].get<double>(), 0);
    EXPECT_EQ(score["samples"], 8);
    EXPECT_EQ(read_image_8(beside, FirstRow::top).width, 320);
}

TEST(Fur, ClassicKeepsTheSamePromise) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const std::string mesh = written(folder, "crooked.obj", "v 1 1 1\nv 2 -1 -1\nv -1 1 -1\nv -1 -1 3\nf 1 2 3\nf 1 3 4\nf 1 4 2\nf 2 4 3\n"), tint = folder / "tint.png";
    Image8 red(3, 2, 3);
    for (std::size_t t = 0; t < red.texels.size(); t += 3) red.texels[t] = 200;
    write_png(tint, red, FirstRow::top);
    std::vector<std::string> pictures;
    for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--addressing", "normal"}, {"--map", "sphere"}, {"--neighbourhood", "8"}, {"--seed", "2"}, {"--mips"},
                                                 {"--map-size", "32"}, {"--set", "ambient=0.5"}, {"--layers", "4"}, {"--colour-map", tint}}) {
        std::vector<std::string> all = {"fur", mesh, "--mode", "classic", "--quiet", "--size", "96", "64", "--passes", "1", "--density", "10", "--json", "--out", folder / "fur.png"};
        all.insert(all.end(), more.begin(), more.end());
        const Ended ended = run(all);
        ASSERT_EQ(ended.code, 0) << ended.err;
        const Json json = Json::parse(ended.out, nullptr, false);
        std::vector<std::string> keys;
        for (const auto& item : json.items()) keys.push_back(item.key());
        EXPECT_EQ(keys, (std::vector<std::string>{"mode", "preset", "faces", "strands", "density_p95_over_p5", "shared_texel_area", "layers", "ms", "image", "report"}));
        EXPECT_EQ(json["mode"], "classic");
        EXPECT_EQ(json["faces"], 4);
        EXPECT_GT(json["strands"].get<int>(), 100);
        EXPECT_EQ(json["layers"], more.size() > 1 && more[0] == "--layers" ? 4 : 16);
        for (const char* step : {"load", "roots", "first_frame", "frame_median"}) EXPECT_GT(json["ms"][step].get<double>(), 0) << step;
        pictures.push_back(read_text(folder / "fur.png"));
        for (std::size_t i = 0; i + 1 < pictures.size(); ++i) EXPECT_NE(pictures[i], pictures.back()) << i << ' ' << (more.empty() ? "" : more[0]);
    }
    // Lapped patches print the same.
    const Ended pasted = run({"fur", mesh, "--mode", "lapped", "--quiet", "--size", "96", "64", "--passes", "2", "--density", "2", "--samples", "2", "--reference", folder / "beside.png", "--json"});
    ASSERT_EQ(pasted.code, 0) << pasted.err;
    const Json patches = Json::parse(pasted.out, nullptr, false);
    EXPECT_EQ(patches["mode"], "lapped");
    EXPECT_NEAR(patches["strands"].get<double>(), 6000, 2500);  // 4000 and what laps
    EXPECT_LT(patches["density_p95_over_p5"].get<double>(), 8);
    EXPECT_LT(patches["report"]["reference"]["flip"].get<double>(), 0.3);

    const std::string strands = folder / "strands.png", tinted = folder / "tinted.dds";
    const Ended mapped = run({"fur", mesh, "--mode", "classic", "--quiet", "--size", "96", "64", "--passes", "1", "--map", "sphere", "--map-size", "64", "--density", "25", "--neighbourhood", "4", "--colour-map", tint,
                              "--fur-map", strands, "--tinted-map", tinted, "--out", folder / "fur.png"});
    ASSERT_EQ(mapped.code, 0) << mapped.err;
    const Image8 white = read_image_8(strands, FirstRow::top), coloured = read_image_8(tinted, FirstRow::top);
    ASSERT_EQ(white.width, 64);
    ASSERT_EQ(coloured.channels, 4);
    int count = 0;
    for (std::size_t t = 0; t < white.texels.size(); t += 4) {
        ASSERT_EQ(white.texels[t], 255);
        ASSERT_EQ(coloured.texels[t + 3], white.texels[t + 3]);
        ASSERT_NEAR(coloured.texels[t], 200, 2);
        ASSERT_EQ(coloured.texels[t + 1], 0);
        count += white.texels[t + 3] == 255;
    }
    EXPECT_NEAR(count, 0.25 * 3.14159 / 4 * 64 * 64, 60);  // the disc's share of them
    const Ended scored = run({"fur", mesh, "--mode", "classic", "--quiet", "--size", "96", "64", "--passes", "4", "--map-size", "16", "--samples", "4", "--reference", folder / "beside.png", "--json"});
    ASSERT_EQ(scored.code, 0) << scored.err;
    const Json report = Json::parse(scored.out, nullptr, false)["report"];
    EXPECT_GT(report["reference"]["flip"].get<double>(), 0);
    EXPECT_LT(report["reference"]["flip"].get<double>(), 0.4);
    EXPECT_NE(report["light"]["diffuse"], 1.0);  // fitted
}

TEST(Fur, ExportsItsStrandsWhereTheMeshIs) {
    const Folder folder;
    const std::string out = folder / "strands.obj";
    const Ended ended = run({"fur", tetrahedron_in(folder), "--quiet", "--density", "0.5", "--set", "length=0.1", "--pieces", "3", "--export", out, "--export", folder / "strands.hair"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    std::istringstream text(read_text(out));
    std::vector<std::array<double, 3>> points;
    std::size_t strands = 0;
    for (std::string line; std::getline(text, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        strands += kind == "l";
        if (kind != "v") continue;
        points.emplace_back();
        for (double& v : points.back()) words >> v;
    }
    EXPECT_NEAR(static_cast<double>(strands), 1000, 100);
    ASSERT_EQ(points.size(), strands * 4);
    for (std::size_t i = 0; i < points.size(); i += 4) {
        // On one of the planes x + y + z + 1 = 0, ... of the tetrahedron with corners (+-1, +-1, +-1) around (100, 0, 0).
        const double x = points[i][0] - 100, y = points[i][1], z = points[i][2];
        const double off = std::max({-x - y - z, -x + y + z, x - y + z, x + y - z});
        EXPECT_NEAR(off, 1, 1e-3);
        // No longer than a tenth of the radius, which is the square root of 3, and what the lock adds.
        const double way = std::hypot(points[i + 3][0] - points[i][0], points[i + 3][1] - points[i][1], points[i + 3][2] - points[i][2]);
        EXPECT_GT(way, 0.02);
        EXPECT_LT(way, 0.25);
    }
    EXPECT_EQ(std::filesystem::file_size(std::filesystem::path(folder / "strands.hair")), 128 + strands * 2 + points.size() * 28);
}

TEST(Fur, ExportsLayersThatComeBack) {
    const Folder folder;
    const std::string out = folder / "layers.glb";
    const Ended ended = run({"fur", tetrahedron_in(folder), "--quiet", "--density", "0.5", "--layers", "5", "--atlas", "256", "--export", out});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const Mesh mesh = load_mesh(out);
    EXPECT_EQ(mesh.faces(), 4u * 6);
    double farthest = 0;
    for (const Vec3f& p : mesh.positions) farthest = std::max(farthest, length(Vec3d(p) - Vec3d(100, 0, 0)));
    // Beyond the corners, which are at the square root of 3, by less than the fur is long.
    EXPECT_GT(farthest, std::sqrt(3.0) * 1.02);
    EXPECT_LT(farthest, std::sqrt(3.0) * 1.15);
    EXPECT_EQ(run({"fur", tetrahedron_in(folder), "--export", folder / "a.abc"}).code, 1);
}

TEST(Fur, GrowsWhereRulesSay) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const std::string mesh = tetrahedron_in(folder), mask = folder / "mask.png";
    Image8 halves(2, 1, 1);
    halves(1, 0) = 255;
    write_png(mask, halves, FirstRow::top);
    const Ended all = run(quick(mesh, {"--json"})), half = run(quick(mesh, {"--json", "--grow-where", "mask=0.49..0.51@" + mask}));
    ASSERT_EQ(half.code, 0) << half.err;
    const Json a = Json::parse(all.out, nullptr, false), b = Json::parse(half.out, nullptr, false);
    EXPECT_EQ(a["report"]["bare"], 0.0);
    // The corners of the tetrahedron are all it is asked about, two on either side; the share falls off linearly over its faces.
    EXPECT_GT(b["report"]["bare"].get<double>(), 0.0001);
    EXPECT_LT(b["strands"].get<int>(), a["strands"].get<int>());
    EXPECT_EQ(b["density_p95_over_p5"], a["density_p95_over_p5"]);
    EXPECT_NE(b["report"]["notes"].dump().find("thrown on"), std::string::npos);
    const Ended bald = run(quick(mesh, {"--json", "--grow-where", "height=2..3"}));
    EXPECT_EQ(bald.code, 1);
    EXPECT_NE(bald.err.find("small"), std::string::npos) << bald.err;
    EXPECT_NE(bald.err.find("bare"), std::string::npos) << bald.err;
    const Ended missing = run(quick(mesh, {"--json", "--grow-where", "mask@" + (folder / "none.png")}));
    EXPECT_EQ(missing.code, 1);
    EXPECT_NE(missing.err.find("none.png"), std::string::npos) << missing.err;
}

TEST(Fur, TurnsOnATableAndGoesOnWhereItStopped) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const std::string mesh = tetrahedron_in(folder), out = folder / "turn.png", second = folder / "turn_0001.png";
    const std::vector<std::string> words = {"--turntable", "3", "--out", out};
    ASSERT_EQ(run(quick(mesh, words)).code, 0);
    const std::string first = read_text(folder / "turn_0000.png"), other = read_text(second), third = read_text(folder / "turn_0002.png");
    EXPECT_EQ(first, read_text(out));
    EXPECT_NE(first, other);
    EXPECT_NE(other, third);
    EXPECT_FALSE(std::filesystem::exists(std::filesystem::path(folder / "turn_0003.png")));
    // Begun again it draws what is missing and leaves the rest alone, even where that is not what it would draw.
    std::filesystem::remove(second);
    written(folder, "turn_0002.png", "kept");
    ASSERT_EQ(run(quick(mesh, words)).code, 0);
    EXPECT_EQ(read_text(second), other);
    EXPECT_EQ(read_text(folder / "turn_0002.png"), "kept");
    // Of another coat all is drawn anew.
    ASSERT_EQ(run(quick(mesh, {"--turntable", "3", "--set", "tilt=0", "--out", out})).code, 0);
    EXPECT_NE(read_text(second), other);
    EXPECT_NE(read_text(folder / "turn_0002.png"), "kept");
    // Compared, a hundredth of a turn changes less than a third of one, and the traced strands change alike.
    const auto steadiness = [&](const char* degrees) {
        const Ended ended = run(quick(mesh, {"--turntable", "3", "--turn", degrees, "--samples", "4", "--reference", folder / "beside.png", "--json"}));
        EXPECT_EQ(ended.code, 0) << ended.err;
        return Json::parse(ended.out, nullptr, false)["report"]["steadiness"]["passes"][0];
    };
    const Json slow = steadiness("10.8"), quickly = steadiness("360");
    EXPECT_GT(slow["change"].get<double>(), 0);
    EXPECT_LT(slow["reference_change"].get<double>(), quickly["reference_change"].get<double>());
    EXPECT_LT(slow["change"].get<double>(), quickly["change"].get<double>());
    EXPECT_LE(quickly["error_change"].get<double>(), quickly["change"].get<double>() + quickly["reference_change"].get<double>() + 1e-3);
    EXPECT_GT(quickly["error_change"].get<double>(), 0);
    EXPECT_GE(slow["worst_over_median"].get<double>(), 1);
    EXPECT_EQ(run(quick(mesh, {"--turntable", "3", "--json"})).code, 2);
    EXPECT_EQ(run(quick(mesh, {"--turntable", "3", "--animate", "3", "--out", out})).code, 2);
}

TEST(Fur, SaysHowSteadyItIsForEachNumberOfPasses) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const std::string mesh = tetrahedron_in(folder), beside = folder / "beside.png";
    const std::vector<std::string> small = {"fur", mesh, "--quiet", "--size", "96", "64", "--density", "2", "--samples", "3", "--reference", beside};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), small.begin(), small.end());
        return run(more);
    };
    const Ended ended = with({"--passes", "1,4", "--turntable", "3", "--turn", "6", "--json"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const Json report = Json::parse(ended.out, nullptr, false)["report"], steadiness = report["steadiness"];
    EXPECT_EQ(report["passes"], 4);
    EXPECT_EQ(steadiness["samples"], 3);
    ASSERT_EQ(steadiness["passes"].size(), 2u);
    EXPECT_EQ(steadiness["passes"][0]["passes"], 1);
    // More passes are steadier; the traced strands are the same ones.
    EXPECT_GT(steadiness["passes"][0]["change"].get<double>(), steadiness["passes"][1]["change"].get<double>());
    EXPECT_EQ(steadiness["steps"].size(), 2u);
    EXPECT_EQ(steadiness["steps"][0]["layers"], steadiness["steps"][1]["layers"]);
    const Ended table = with({"--passes", "1,4", "--turntable", "2", "--dolly", "0.5:2"});
    ASSERT_EQ(table.code, 0) << table.err;
    EXPECT_NE(table.out.find("3 rays a pixel"), std::string::npos) << table.out;
    EXPECT_EQ(std::ranges::count(table.out, '\n'), 4);
    // In the wind the traced strands move as the pictures do.
    const Ended windy = with({"--passes", "2", "--animate", "3", "--wind", "3", "0", "0", "--json"});
    ASSERT_EQ(windy.code, 0) << windy.err;
    EXPECT_GT(Json::parse(windy.out, nullptr, false)["report"]["steadiness"]["passes"][0]["reference_change"].get<double>(), 0);
}

TEST(Fur, WindMovesIt) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const std::string mesh = tetrahedron_in(folder), still = folder / "still.png", film = folder / "film.png";
    ASSERT_EQ(run(quick(mesh, {"--out", still})).code, 0);
    const std::vector<std::string> windy = {"--set", "softness=1", "--wind", "2", "0", "0", "--animate", "3", "--spin", "1", "--out", film};
    ASSERT_EQ(run(quick(mesh, windy)).code, 0);
    const std::string first = read_text(folder / "film_0000.png"), third = read_text(folder / "film_0002.png");
    EXPECT_EQ(first, read_text(still));  // the wind sets in with the first frame
    EXPECT_NE(first, third);
    EXPECT_NE(read_text(film), read_text(still));  // the picture itself is in balance with it
    ASSERT_EQ(run(quick(mesh, windy)).code, 0);
    EXPECT_EQ(third, read_text(folder / "film_0002.png"));  // and the same again
    EXPECT_FALSE(std::filesystem::exists(std::filesystem::path(folder / "film_0003.png")));
}

TEST(Fur, RefusesWrongWordsWithAWayOn) {
    const Folder folder;
    const std::string mesh = tetrahedron_in(folder);
    const struct {
        std::vector<std::string> words;
        const char* said;
    } cases[] = {{{}, "--out FILE.png"},
                 {{"--json", "--preset", "rabit"}, "rabbit"},
                 {{"--json", "--set", "tillt=1"}, "tilt"},
                 {{"--json", "--set", "tilt=9"}, "0 to 1.3"},
                 {{"--json", "--set", "tilt"}, "NAME=VALUE"},
                 {{"--json", "--layers", "many"}, "auto"},
                 {{"--json", "--layers", "65"}, "1 to 64"},
                 {{"--json", "--mode", "feathers"}, "strands"},
                 {{"--json", "--mode", "classic", "--map", "cub"}, "cube"},
                 {{"--json", "--mode", "classic", "--map-size", "100"}, "power of two"},
                 {{"--json", "--mode", "classic", "--addressing", "normals"}, "normal"},
                 {{"--json", "--mode", "classic", "--neighbourhood", "-1"}, "0 to 64"},
                 {{"--json", "--mode", "classic", "--neighbourhood", "six"}, "none"},
                 {{"--json", "--mode", "classic", "--density", "150"}, "100 %"},
                 {{"--json", "--mode", "classic", "--set", "tilt=1"}, "ambient"},
                 {{"--mode", "lapped", "--export", "fur.hair"}, "strands"},
                 {{"--json", "--mode", "lapped", "--set", "ambient=1"}, "tilt"},
                 {{"--mode", "classic", "--fur-map", "map.jpg"}, "FILE.dds"},
                 {{"--mode", "classic", "--fur-map", "map.dds", "--dds-code", "bc9"}, "bc1"},
                 {{"--json", "--mode", "classic", "--set", "power=0"}, "1 to 1000"},
                 {{"--json", "--grow-where", "hight=0..1"}, "height"},
                 {{"--json", "--mode", "classic", "--grow-where", "up"}, "strands"},
                 {{"--json", "--animate", "3"}, "--out"},
                 {{"--json", "--spin", "1"}, "--animate"},
                 {{"--json", "--dolly", "1:2"}, "--turntable"},
                 {{"--out", "x.png", "--turntable", "2", "--dolly", "0.1:2"}, "0.4"},
                 {{"--out", "x.png", "--turntable", "2", "--dolly", "1-2"}, "NEAR:FAR"},
                 {{"--out", "x.png", "--turntable", "2", "--spin", "1"}, "--animate"},
                 {{"--json", "--passes", "1,,2"}, "1,2,4"},
                 {{"--json", "--passes", "0"}, "1 to 1024"},
                 {{"--json", "--passes", "1,2"}, "--turntable"},
                 {{"--json", "--wind", "1", "2"}, "wind"},
                 {{"--json", "--height", "80"}, "50"}};
    for (const auto& c : cases) {
        std::vector<std::string> all{"fur", mesh};
        all.insert(all.end(), c.words.begin(), c.words.end());
        const Ended ended = run(all);
        EXPECT_EQ(ended.code, 2) << ended.err;
        EXPECT_NE(ended.err.find(c.said), std::string::npos) << ended.err;
    }
}

TEST(Fur, RefusesMeshesWithoutASurface) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    for (const char* text : {"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n", "v 0 0 0\n", ""}) {
        const Ended ended = run(quick(written(folder, "bad.obj", text), {"--json", "--out", folder / "fur.png"}));
        EXPECT_EQ(ended.code, 1) << text << ended.out;
        EXPECT_NE(ended.err.find("bad"), std::string::npos) << ended.err;
        EXPECT_FALSE(std::filesystem::exists(folder / "fur.png"));
    }
}

// A square of 8 x 8 cells in x and z, unwrapped by its own places, v toward -z.
std::string unwrapped_square_in(const Folder& folder) {
    std::string text;
    for (int j = 0; j <= 8; ++j)
        for (int i = 0; i <= 8; ++i) text += "v " + std::to_string(i) + " 0 " + std::to_string(-j) + "\nvt " + std::to_string(i / 8.0) + " " + std::to_string(j / 8.0) + "\n";
    for (int j = 0; j < 8; ++j)
        for (int i = 0; i < 8; ++i) {
            text += "f";
            for (const int v : {j * 9 + i + 1, j * 9 + i + 2, j * 9 + i + 11, j * 9 + i + 10}) {
                const std::string n = std::to_string(v);
                text += " ";
                text += n;
                text += "/";
                text += n;
            }
            text += "\n";
        }
    return written(folder, "square.obj", text);
}

std::string paint_in(const Folder& folder, const std::string& name, const std::vector<std::uint8_t>& texel) {
    Image8 picture(4, 4, static_cast<int>(texel.size()));
    for (std::size_t t = 0; t < picture.texels.size(); ++t) picture.texels[t] = texel[t % texel.size()];
    write_png(folder / name, picture, FirstRow::top);
    return folder / name;
}

TEST(Fur, CombsAsPainted) {
    const Folder folder;
    const std::string mesh = unwrapped_square_in(folder), out = folder / "strands.obj";
    const std::string to_v = paint_in(folder, "to_v.png", {128, 255, 255}), none = paint_in(folder, "none.png", {255, 128, 0, 0});
    const auto exported = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all{"fur", mesh, "--quiet", "--density", "0.2", "--set", "lock=0", "--set", "spread=0", "--set", "guard_hairs=0", "--set", "length_variation=0", "--set", "length=0.1", "--pieces", "2", "--export", out};
        all.insert(all.end(), more.begin(), more.end());
        const Ended ended = run(all);
        EXPECT_EQ(ended.code, 0) << ended.err;
        return read_text(out);
    };
    // Each strand goes from its root up and toward -z, as far as tilt 0.7 and bend 0.6 say, and nowhere else.
    std::istringstream text(exported({"--comb", to_v}));
    std::vector<std::array<double, 3>> points;
    for (std::string line; std::getline(text, line);) {
        std::istringstream words(line);
        std::string kind;
        words >> kind;
        if (kind != "v") continue;
        points.emplace_back();
        for (double& v : points.back()) words >> v;
    }
    ASSERT_GT(points.size(), 300u);
    const double length = 0.1 * std::sqrt(32.0), up = (std::sin(1.3) - std::sin(0.7)) / 0.6 * length, along = (std::cos(0.7) - std::cos(1.3)) / 0.6 * length;
    for (std::size_t i = 0; i < points.size(); i += 3) {
        EXPECT_NEAR(points[i + 2][0] - points[i][0], 0, 1e-4);
        EXPECT_NEAR(points[i + 2][1] - points[i][1], up, 1e-4);
        EXPECT_NEAR(points[i + 2][2] - points[i][2], -along, 1e-4);
    }
    // Without weight the fur is what it is without paint, to the byte.
    const std::string plain = exported({});
    EXPECT_TRUE(exported({"--comb", none}) == plain);
    std::string coloured = read_text(mesh);
    const std::string colour = " 0.50196078431 0.50196078431 0";  // of the line above
    for (std::size_t at = 0; (at = coloured.find("\nvt", at)) != std::string::npos; at += colour.size() + 3) coloured.insert(at, colour);
    const std::string dyed = written(folder, "dyed.obj", coloured);
    const Ended by_colours = run({"fur", dyed, "--quiet", "--density", "0.2", "--comb", "colours", "--export", folder / "layers.glb", "--layers", "4", "--atlas", "256"});
    EXPECT_EQ(by_colours.code, 0) << by_colours.err;
}

TEST(Fur, DrawsAPaintedCombInEveryMode) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const std::string mesh = unwrapped_square_in(folder), picture = folder / "fur.png", beside = folder / "beside.png";
    const std::string left = paint_in(folder, "left.png", {1, 128, 255}), none = paint_in(folder, "none.png", {255, 128, 0, 0});
    for (const char* mode : {"strands", "shells", "lapped", "classic"}) {
        std::vector<std::string> pictures, references;
        for (const std::vector<std::string>& more : {std::vector<std::string>{}, {"--comb", none}, {"--comb", left}}) {
            std::vector<std::string> all = quick(mesh, {"--mode", mode, "--samples", "2", "--reference", beside, "--out", picture, "--json"});
            all.insert(all.end(), more.begin(), more.end());
            const Ended ended = run(all);
            ASSERT_EQ(ended.code, 0) << ended.err;
            pictures.push_back(read_text(picture));
            references.push_back(read_text(beside));
            const bool said = ended.out.find("no weight") != std::string::npos;
            EXPECT_EQ(said, more.size() == 2 && more[1] == none) << mode;
        }
        // Not EXPECT_EQ, which prints how files differ.
        EXPECT_TRUE(pictures[0] == pictures[1]) << mode;
        EXPECT_TRUE(references[0] == references[1]) << mode;
        EXPECT_FALSE(pictures[0] == pictures[2]) << mode;
        EXPECT_FALSE(references[0] == references[2]) << mode;
    }
}

TEST(Fur, RefusesPaintThatDoesNotFit) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const std::string square = unwrapped_square_in(folder), scan = tetrahedron_in(folder), paint = paint_in(folder, "paint.png", {255, 128, 255}), grey = paint_in(folder, "grey.png", {255});
    const struct {
        std::string mesh, paint;
        const char* said;
    } cases[] = {{scan, paint, "no texture coordinates"}, {scan, "colours", "no vertex colours"}, {square, grey, "red, green and blue"}, {square, folder / "missing.png", "missing.png"}, {square, written(folder, "text.png", "not a picture"), "text.png"}};
    for (const auto& c : cases)
        for (const char* mode : {"strands", "lapped", "classic"}) {
            const Ended ended = run(quick(c.mesh, {"--mode", mode, "--json", "--comb", c.paint}));
            EXPECT_EQ(ended.code, 1) << ended.out;
            EXPECT_NE(ended.err.find(c.said), std::string::npos) << ended.err;
        }
}

}  // namespace
}  // namespace relievo::test
