// compare fur: a small mesh in two modes for real, what lands in the folder, and wrong words and meshes.
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
