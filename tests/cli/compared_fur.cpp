// compare fur: a small mesh in two modes for real, what lands in the folder, and wrong words and meshes.
#include "assets/image_file.h"
#include "cli/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>

namespace relievo::test {
namespace {

using Json = nlohmann::json;

std::string tetrahedron(const Folder& folder) {
    const std::string file = folder / "tetrahedron.obj";
    std::ofstream(file) << "v 1 1 1\nv 1 -1 -1\nv -1 1 -1\nv -1 -1 1\nf 1 2 3\nf 1 4 2\nf 1 3 4\nf 2 4 3\n";
    return file;
}

TEST(ComparedFur, ScoresModesOnTheSameTruthAndNamesWhatGrowsNothing) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const std::string mesh = tetrahedron(folder), points = folder / "points.obj", out = folder / "report";
    std::ofstream(points) << "v 0 0 0\nv 1 0 0\n";
    const Ended ended = run({"compare", "fur", mesh, points, "--mode", "strands,classic", "--preset", "velvet", "--size", "120x80", "--passes", "4", "--samples", "4", "--quiet", "--json", "--out", out});
    ASSERT_EQ(ended.code, 0) << ended.err;
    const Json json = Json::parse(ended.out, nullptr, false);
    ASSERT_EQ(json["rows"].size(), 2u) << ended.out;
    EXPECT_EQ(json["refused"].size(), 1u);
    const Json &classic = json["rows"][0], &strands = json["rows"][1];
    EXPECT_EQ(classic["mode"], "classic");
    EXPECT_EQ(strands["mode"], "strands");
    EXPECT_EQ(classic["reference"], strands["reference"]);
    // The same strands, even and unshared, are nearer to themselves than a map's.
    EXPECT_GT(strands["flip"].get<double>(), 0);
    EXPECT_LT(strands["flip"].get<double>(), classic["flip"].get<double>());
    EXPECT_LT(strands["density_p95_over_p5"].get<double>(), 1.5);
    EXPECT_EQ(strands["shared_texel_area"], 0);
    for (const Json& row : json["rows"]) {
        EXPECT_GT(row["frame_ms"].get<double>(), 0);
        EXPECT_EQ(row["inside_budget"].get<bool>(), row["outside"].empty());
        EXPECT_TRUE(std::filesystem::exists(folder.path() / "report" / row["picture"].get<std::string>()));
        EXPECT_TRUE(std::filesystem::exists(folder.path() / "report" / row["reference"].get<std::string>()));
    }
    EXPECT_EQ(read_text(folder / "report/results.json"), ended.out);
    EXPECT_NE(read_text(folder / "report/index.html").find("tetrahedron.obj"), std::string::npos);
    EXPECT_NE(read_text(folder / "report/results.csv").find("tetrahedron.obj,velvet,strands"), std::string::npos);
}

// A square of two faces, unwrapped, with colours at its vertices that point along -z.
std::string painted_square(const Folder& folder) {
    const std::string file = folder / "square.obj";
    std::ofstream(file) << "v 0 0 0 0.50196 0.50196 0\nv 1 0 0 0.50196 0.50196 0\nv 1 0 -1 0.50196 0.50196 0\nv 0 0 -1 0.50196 0.50196 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";
    return file;
}

std::string paint(const Folder& folder, const std::string& name, const std::vector<std::uint8_t>& texel) {
    Image8 picture(4, 4, static_cast<int>(texel.size()));
    for (std::size_t t = 0; t < picture.texels.size(); ++t) picture.texels[t] = texel[t % texel.size()];
    write_png(folder / name, picture, FirstRow::top);
    return folder / name;
}

// The traced strands and every mode lie otherwise under paint, and as without where it has no weight.
TEST(ComparedFur, CombsTheTruthAndEveryModeAsPainted) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const std::string mesh = painted_square(folder);
    const auto compared = [&](const std::string& name, const std::vector<std::string>& comb) {
        std::vector<std::string> words{"compare", "fur", mesh, "--preset", "porcupine", "--size", "120x80", "--passes", "2", "--samples", "2", "--quiet", "--json", "--out", folder / name};
        words.insert(words.end(), comb.begin(), comb.end());
        const Ended ended = run(words);
        EXPECT_EQ(ended.code, 0) << ended.err;
        const Json json = Json::parse(ended.out, nullptr, false);
        std::vector<std::string> pictures;
        for (const Json& row : json["rows"]) pictures.push_back(read_text(folder.path() / name / row["picture"].get<std::string>()));
        if (!json["rows"].empty()) pictures.push_back(read_text(folder.path() / name / json["rows"][0]["reference"].get<std::string>()));
        return pictures;
    };
    const auto plain = compared("plain", {}), none = compared("none", {"--comb", paint(folder, "none.png", {255, 128, 0, 0})}), up = compared("up", {"--comb", paint(folder, "up.png", {128, 255, 255})}),
               coloured = compared("coloured", {"--comb", "colours"});
    ASSERT_EQ(plain.size(), 5u);
    ASSERT_EQ(none.size(), 5u);
    ASSERT_EQ(up.size(), 5u);
    ASSERT_EQ(coloured.size(), 5u);
    for (std::size_t i = 0; i < plain.size(); ++i) {
        // Not EXPECT_EQ, which prints how files differ.
        EXPECT_TRUE(plain[i] == none[i]) << i;
        EXPECT_FALSE(plain[i] == up[i]) << i;
        EXPECT_FALSE(plain[i] == coloured[i]) << i;
    }
}

TEST(ComparedFur, RefusesPaintThatDoesNotFit) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const std::string square = painted_square(folder), scan = tetrahedron(folder), colour = paint(folder, "paint.png", {255, 128, 255}), grey = paint(folder, "grey.png", {255});
    std::ofstream(folder / "text.png") << "not a picture";
    const struct {
        std::string mesh, comb;
        const char* said;
    } cases[] = {{scan, colour, "no texture coordinates"}, {scan, "colours", "no vertex colours"}, {square, grey, "red, green and blue"}, {square, folder / "missing.png", "missing.png"}, {square, folder / "text.png", "text.png"}};
    for (const auto& c : cases) {
        const Ended ended = run({"compare", "fur", c.mesh, "--comb", c.comb, "--mode", "strands", "--size", "96x64", "--passes", "1", "--samples", "1", "--quiet", "--out", folder / "report"});
        EXPECT_EQ(ended.code, 1) << ended.out;
        EXPECT_NE(ended.err.find(c.said), std::string::npos) << ended.err;
    }
    // Of several meshes the others are compared all the same.
    const Ended ended = run({"compare", "fur", scan, square, "--comb", colour, "--mode", "strands", "--size", "96x64", "--passes", "1", "--samples", "1", "--quiet", "--json", "--out", folder / "report"});
    EXPECT_EQ(ended.code, 0) << ended.err;
    const Json json = Json::parse(ended.out, nullptr, false);
    EXPECT_EQ(json["rows"].size(), 1u);
    EXPECT_EQ(json["refused"].size(), 1u);
}

TEST(ComparedFur, RefusesWrongWordsAndMeshesWithAWayOn) {
    const Folder folder;
    const std::string out = folder / "report";
    const auto refused = [&](std::vector<std::string> words, int code) {
        words.insert(words.begin(), {"compare", "fur"});
        const Ended ended = run(words);
        EXPECT_EQ(ended.code, code) << ended.err;
        return ended.err;
    };
    const std::string mesh = tetrahedron(folder);
    EXPECT_NE(refused({mesh}, 2).find("--out"), std::string::npos);
    EXPECT_NE(refused({mesh, "--mode", "stands", "--out", out}, 2).find("strands"), std::string::npos);
    EXPECT_NE(refused({mesh, "--preset", "wolf", "--out", out}, 2).find("fox"), std::string::npos);
    EXPECT_NE(refused({folder / "none.obj", "--out", out}, 1).find("No such file"), std::string::npos);
    std::ofstream(folder / "file") << "x";
    EXPECT_NE(refused({mesh, "--out", folder / "file/report"}, 1).find("file/report"), std::string::npos);
    EXPECT_EQ(run({"compare"}).code, 2);  // the other comparison still asks for its folder
}

}  // namespace
}  // namespace relievo::test
