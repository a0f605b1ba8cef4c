// relievo mesh as a user meets it: what the JSON promises, what lands in the files, and what is said of wrong words.
#include "cli/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace relievo::test {
namespace {

using Json = nlohmann::ordered_json;

// A cube away from the origin, six squares, one of them facing inwards, with a vertex that nobody uses.
std::string cube_in(const Folder& folder, const std::string& name = "cube.obj") {
    std::ofstream out(folder / name);
    for (int i = 0; i < 8; ++i) out << "v " << 4 + (i & 1) * 2 << ' ' << (i & 2) << ' ' << (i & 4) / 2 << '\n';
    out << "v 5 1 1\n"
           "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 6 8 4\n";
    return folder / name;
}

Json json_of(const Ended& ended) {
    EXPECT_EQ(ended.code, 0) << ended.err;
    return Json::parse(ended.out, nullptr, false);
}

TEST(Mesh, JsonKeepsItsPromise) {
    const Folder folder;
    const std::string out = folder / "small.ply";
    const Json json = json_of(run({"mesh", cube_in(folder), "--repair", "--centre", "--normals", "distinct", "--index", "--order", "lin-yu", "--out", out, "--json"}));
    std::vector<std::string> keys;
    for (const auto& item : json.items()) keys.push_back(item.key());
    EXPECT_EQ(keys, (std::vector<std::string>{"faces", "vertices_before", "vertices_after", "bytes_before", "bytes_after", "acmr", "atvr", "ms", "report"}));
    EXPECT_EQ(json["faces"], 12);
    EXPECT_EQ(json["vertices_before"], 36);
    EXPECT_EQ(json["vertices_after"], 8);
    EXPECT_EQ(json["bytes_before"], 864);  // the thesis's cube
    EXPECT_EQ(json["bytes_after"], 264);
    EXPECT_DOUBLE_EQ(json["acmr"]["fifo16"], 8.0 / 12);
    EXPECT_DOUBLE_EQ(json["atvr"]["fifo32"], 1.0);
    for (const char* step : {"load", "centre", "normals", "index", "order", "save", "total"}) EXPECT_GE(json["ms"][step].get<double>(), 0) << step;
    const Json& report = json["report"];
    EXPECT_EQ(report["repair"]["faces_turned"], 2);
    EXPECT_EQ(report["topology"]["closed"], true);
    EXPECT_EQ(report["topology"]["oriented"], true);
    EXPECT_EQ(report["topology"]["genus"], 0);
    EXPECT_NEAR(report["sphere"]["radius"].get<double>(), 1.7320508, 1e-6);
    EXPECT_EQ(report["box"]["low"], Json::parse("[-1.0,-1.0,-1.0]"));

    // What was saved says the same.
    const Json again = json_of(run({"mesh", out, "--json"}));
    EXPECT_EQ(again["faces"], 12);
    EXPECT_EQ(again["vertices_after"], 8);
    EXPECT_EQ(again["acmr"], json["acmr"]);
    EXPECT_EQ(again["report"]["topology"], report["topology"]);
}

TEST(Mesh, AnalysesWithoutWriting) {
    const Folder folder;
    const Json json = json_of(run({"mesh", cube_in(folder), "--json"}));
    EXPECT_EQ(json["report"]["topology"]["flipped_edges"], 4);
    EXPECT_EQ(json["report"]["topology"]["unreferenced_vertices"].get<int>() + 8, json["vertices_after"].get<int>());
    EXPECT_EQ(json["bytes_before"], 36 * 12);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(Mesh, BareOptionsTakeTheDefaults) {
    const Folder folder;
    const Json json = json_of(run({"mesh", cube_in(folder), "--order", "--normals", "--json"}));
    EXPECT_EQ(json["report"]["steps"]["normals"], "angle");
    EXPECT_EQ(json["report"]["steps"]["order"], "meshopt");
}

TEST(Mesh, SeveralTargetsMakeSeveralFiles) {
    const Folder folder;
    std::ofstream obj(folder / "sheet.obj");
    for (int y = 0; y <= 20; ++y)
        for (int x = 0; x <= 20; ++x) obj << "v " << x << ' ' << y << ' ' << (x * x + y * y) * 0.01 << '\n';
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x) obj << "f " << y * 21 + x + 1 << ' ' << y * 21 + x + 2 << ' ' << y * 21 + x + 23 << ' ' << y * 21 + x + 22 << '\n';
    obj.close();
    const Json json = json_of(run({"mesh", folder / "sheet.obj", "--simplify", "200", "0.05", "--json", "--out", folder / "coarse.ply"}));
    ASSERT_EQ(json.size(), 2u);
    EXPECT_NEAR(json[0]["faces"].get<double>(), 200, 2);
    EXPECT_LT(json[1]["faces"], 200);
    EXPECT_GT(json[1]["report"]["simplify"]["hausdorff"]["largest"], 0);
    EXPECT_TRUE(std::filesystem::exists(folder / "coarse_200.ply"));
    EXPECT_TRUE(std::filesystem::exists(folder / "coarse_0.05.ply"));
}

// Two squares of one sheet, the second with its texture mirrored: the two vertices between them get a tangent for each side.
TEST(Mesh, TangentsComeWithTheFilesThatHoldThem) {
    const Folder folder;
    std::ofstream(folder / "sheet.obj") << "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nvt 1 1\n"
                                           "f 1/1 2/2 5/4 4/3\nf 2/2 3/1 6/3 5/4\n";
    const std::string glb = folder / "sheet.glb";
    const Json json = json_of(run({"mesh", folder / "sheet.obj", "--normals", "--index", "--tangents", "--json", "--out", glb}));
    EXPECT_EQ(json["vertices_after"], 8);
    EXPECT_EQ(json["report"]["tangents"]["vertices_doubled"], 2);
    const std::string bytes = read_text(glb);
    const Json document = Json::parse(bytes.substr(20, bytes.find("BIN", 20) - 24));
    const std::size_t accessor = document["meshes"][0]["primitives"][0]["attributes"]["TANGENT"];
    EXPECT_EQ(document["accessors"][accessor]["type"], "VEC4");
    EXPECT_EQ(document["accessors"][accessor]["count"], 8);
    EXPECT_EQ(run({"mesh", folder / "sheet.obj", "--normals", "--tangents", "--out", folder / "sheet.ply"}).code, 1);
    EXPECT_EQ(run({"mesh", cube_in(folder), "--normals", "--tangents", "--out", folder / "cube.glb"}).code, 1) << "no texture coordinates";
}

TEST(Mesh, WrongWordsAreExplained) {
    const Folder folder;
    const std::string cube = cube_in(folder);
    const auto refused = [&](const std::vector<std::string>& arguments, const std::string& says) {
        const Ended e = run(arguments);
        EXPECT_EQ(e.code, 2) << e.err;
        EXPECT_NE(e.err.find(says), std::string::npos) << e.err;
    };
    refused({"mesh"}, "needs a mesh");
    refused({"mesh", cube}, "--out");
    refused({"mesh", cube, "--json", "--order", "linyu"}, "lin-yu");
    refused({"mesh", cube, "--json", "--normals", "angel"}, "angle");
    for (const char* target : {"0", "-5", "1.5", "many", "nan"}) refused({"mesh", cube, "--json", "--simplify", target}, "--simplify");
    refused({"mesh", cube, "--json", "--cache", "2"}, "--cache");
    refused({"mesh", cube, "--batch", folder.path().string()}, "--batch");
    EXPECT_EQ(run({"mesh", folder / "none.obj", "--json"}).code, 1);
    EXPECT_EQ(run({"mesh", cube, "--out", folder / "no" + "/such/folder.ply"}).code, 1);
}

TEST(Mesh, BatchGoesOnWhereItWas) {
    const Folder folder;
    const Folder out;
    cube_in(folder, "a.obj");
    cube_in(folder, "b.obj");
    std::ofstream(folder / "broken.obj") << "v 1 2 3\n";
    std::ofstream(folder / "notes.txt") << "no mesh\n";
    const Json json = json_of(run({"mesh", "--batch", folder.path().string(), "--out", out / "table", "--json"}));
    // Four modes of normals, each as a list, and through indices in four orders.
    EXPECT_EQ(json["rows"].size(), 2u * 4 * 5);
    ASSERT_EQ(json["skipped"].size(), 1u);
    EXPECT_NE(json["skipped"][0].get<std::string>().find("broken.obj"), std::string::npos);
    for (const Json& row : json["rows"]) {
        EXPECT_EQ(row["faces"], 12);
        EXPECT_EQ(row["vertices_after"], row["index"] == true ? 8 : 36);
        EXPECT_NEAR(row["half_diagonal"].get<double>(), 1.7320508, 1e-6);
    }
    const std::string page = read_text(out / "table/meshes.html");
    EXPECT_NE(page.find("Cubo 0"), std::string::npos);
    EXPECT_NE(page.find("69.4 %"), std::string::npos);
    const std::string csv = read_text(out / "table/meshes.csv");
    EXPECT_EQ(std::ranges::count(csv, '\n'), 41);

    // A file that changed is done again, the other one taken over with its times.
    std::ofstream(folder / "b.obj", std::ios::app) << "v 0 0 0\n";
    const Ended second = run({"mesh", "--batch", folder.path().string(), "--out", out / "table", "--json"});
    const Json again = json_of(second);
    EXPECT_NE(second.err.find("1 meshes were taken over"), std::string::npos) << second.err;
    EXPECT_EQ(again["rows"].size(), 40u);
    EXPECT_EQ(again["rows"][3], json["rows"][3]);
    EXPECT_NE(again["rows"][23]["input"], json["rows"][23]["input"]);
}

}  // namespace
}  // namespace relievo::test
