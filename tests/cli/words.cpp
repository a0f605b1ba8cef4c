// What is said to whom: exit codes, which stream, suggestions, help.
#include "cli/materials.h"
#include "cli/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdlib>

namespace relievo::test {

namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

std::string text_of(const Words& words) {
    std::string text = "relievo";
    for (const std::string& w : words) text += " '" + w + "'";
    return text;
}

// A command that is wrong: exit code 2, nothing on standard output, and a message that holds each of `said`.
void expect_wrong(const Words& words, const Words& said) {
    SCOPED_TRACE(text_of(words));
    const Ended ended = run(words);
    EXPECT_EQ(ended.code, 2) << "signal " << ended.signal << "\n" << ended.err;
    EXPECT_EQ(ended.out, "");
    for (const std::string& s : said) EXPECT_NE(ended.err.find(s), std::string::npos) << "not said: " << s << "\n" << ended.err;
}

}  // namespace

TEST(Words, MisspeltIdsGetASuggestion) {
    const Folder folder;
    const std::string png = folder / "a.png";
    expect_wrong({"compar"}, {"compar", "'compare'"});
    expect_wrong({"compare", "--materal", "x", "--out", png}, {"--materal", "'--material'"});
    expect_wrong({"list", "--jsn"}, {"--jsn", "'--json'"});
    expect_wrong({"replicate", "fur", "--meshes", "scans", "--samplse", "3"}, {"--samplse", "'--samples'"});
    expect_wrong({"compare", "fur", "bunny.obj", "--mode", "strands", "--presets", "fox", "--out", png}, {"--presets", "'--preset'"});
    expect_wrong({"--versoin"}, {"'--version'"});
    expect_wrong({"list", "technique"}, {"'techniques'"});
    expect_wrong({"compare", "--technique", "relief_mapping,cone_step_maping", "--out", png}, {"cone_step_maping", "'cone_step_mapping'"});
    expect_wrong({"compare", "--view", "grazin", "--out", png}, {"grazin", "'grazing'", "1 to 90"});
    expect_wrong({"render", "--material", "cobbles", "--technique", "relief", "--out", png}, {"'relief_mapping'"});
    expect_wrong({"render", "--material", "cobbles", "--technique", "refrence", "--out", png}, {"'reference'"});
    expect_wrong({"render", "--material", "cobbles", "--technique", "relief_mapping", "--set", "max_step=3", "--out", png}, {"'max_steps'", "relief_mapping"});
    expect_wrong({"bake", "--material", "cobbles", "--map", "cones", "--out", png}, {"'cone'"});
    EXPECT_TRUE(files_below(folder.path()).empty());
}

TEST(Words, WrongValuesSayWhatIsRight) {
    const Folder folder;
    const std::string png = folder / "a.png";
    const auto set = [&](const std::string& setting) { return Words{"render", "--material", "cobbles", "--technique", "relief_mapping", "--set", setting, "--out", png}; };
    expect_wrong(set("max_steps=99999"), {"from 1 to 4096"});
    expect_wrong(set("max_steps=0"), {"from 1 to 4096"});
    expect_wrong(set("max_steps=3.5"), {"whole number", "from 1 to 4096"});
    expect_wrong(set("max_steps=nan"), {"from 1 to 4096"});
    expect_wrong(set("max_steps=3x"), {"from 1 to 4096"});
    expect_wrong(set("max_steps="), {"from 1 to 4096"});
    expect_wrong(set("max_steps"), {"knob=value"});
    expect_wrong({"render", "--material", "cobbles", "--technique", "normal_mapping", "--set", "max_steps=3", "--out", png}, {"no knobs"});
    expect_wrong({"render", "--material", "cobbles", "--technique", "reference", "--set", "max_steps=3", "--out", png}, {"exact"});
    expect_wrong({"render", "--material", "cobbles", "--technique", "relief_mapping", "--view", "0", "--out", png}, {"1 to 90"});
    expect_wrong({"render", "--material", "cobbles", "--technique", "relief_mapping", "--view", "grazing,steep", "--out", png}, {"one view"});
    for (const char* size : {"64", "64x", "x64", "0x64", "64x-1", "64x36x2", "99999x4", "64 x 36"})
        expect_wrong({"render", "--material", "cobbles", "--technique", "relief_mapping", "--size", size, "--out", png}, {"WIDTHxHEIGHT", "640x360"});
    expect_wrong({"render", "--material", "cobbles", "--technique", "relief_mapping", "--out", folder / "a.jpg"}, {".png or .exr"});
    expect_wrong({"bake", "--material", "cobbles", "--map", "cone", "--out", folder / "cone"}, {".png or .exr"});
    expect_wrong({"bake", "--material", "cobbles", "--map", "colour", "--out", folder / "colour.exr"}, {".png"});
    expect_wrong({"compare", "--runs", "0", "--out", png}, {"--runs", "1 to 10000"});
    expect_wrong({"compare", "--samples", "4", "--out", png}, {"--samples", "1,5,9,25"});
    expect_wrong({"compare", "--shadow", "horizons", "--out", png}, {"shadow", "horizon"});
    expect_wrong({"compare", "--light-radius", "90", "--out", png}, {"--light-radius", "0 to 20"});
    expect_wrong({"render", "--material", "cobbles", "--technique", "reference", "--shadow-samples", "2.5", "--out", png}, {"whole number"});
    expect_wrong({"vary", "shadw"}, {"modifier", "shadow"});
    expect_wrong({"compare", "--threads", "-1", "--out", png}, {"--threads"});
    expect_wrong({"compare", "--texels", "0", "--out", png}, {"--texels"});
    expect_wrong({"compare", "--technique", ",", "--out", png}, {"--technique"});
    expect_wrong({"compare", "--view", "", "--out", png}, {"--view"});
    EXPECT_TRUE(files_below(folder.path()).empty());
}

TEST(Words, MissingWordsAreNamed) {
    expect_wrong({}, {"compare", "render", "bake", "Examples"});
    expect_wrong({"compare"}, {"--out"});
    expect_wrong({"compare", "--out"}, {"--out"});
    expect_wrong({"render", "--material", "cobbles", "--out", "a.png"}, {"--technique"});
    expect_wrong({"bake", "--material", "cobbles", "--out", "a.png"}, {"--map"});
    expect_wrong({"report"}, {"results"});
    const Folder folder;
    expect_wrong({"bake", "--map", "cone", "--out", folder / "a.png"}, {"--material", "--height"});
    expect_wrong({"render", "--technique", "reference", "--out", folder / "a.png"}, {"--material", "--height"});
}

TEST(Words, HelpOfEveryVerbHasAnExampleAndEveryOptionAText) {
    const Ended help = run({"--help"});
    EXPECT_EQ(help.code, 0);
    EXPECT_EQ(help.err, "");
    EXPECT_NE(help.out.find("Example"), std::string::npos);
    for (const char* verb : {"compare", "render", "view", "explain", "effects", "replicate", "bake", "report", "list", "docs"}) {
        SCOPED_TRACE(verb);
        EXPECT_NE(help.out.find(verb), std::string::npos);
        const Ended of_verb = run({verb, "--help"});
        EXPECT_EQ(of_verb.code, 0);
        EXPECT_EQ(of_verb.err, "");
        const auto example = of_verb.out.find("Example");
        ASSERT_NE(example, std::string::npos) << of_verb.out;
        EXPECT_NE(of_verb.out.find(std::string("relievo ") + verb, example), std::string::npos) << of_verb.out;
    }
    const Ended version = run({"--version"});
    EXPECT_EQ(version.code, 0);
    EXPECT_TRUE(version.out.starts_with("relievo ")) << version.out;
}

TEST(Words, ListsAreTablesOrJson) {
    const std::vector<std::pair<std::string, std::string>> lists{{"techniques", "id"}, {"maps", "id"},     {"scenes", "id"},
                                                                 {"views", "id"},      {"knobs", "id"},    {"tests", "id"},
                                                                 {"devices", "name"},  {"modifiers", "value"}, {"fur", "id"}};
    for (const auto& [list, key] : lists) {
        SCOPED_TRACE(list);
        const Ended table = run({"list", list});
        const Ended json = run({"list", list, "--json"});
        EXPECT_EQ(table.code, 0);
        EXPECT_EQ(json.code, 0);
        EXPECT_EQ(table.err, "");
        EXPECT_EQ(json.err, "");
        const Json rows = Json::parse(json.out, nullptr, false);
        ASSERT_TRUE(rows.is_array()) << json.out;
        if (list != "devices") {
            EXPECT_FALSE(rows.empty());
        }
        for (const Json& row : rows) {
            ASSERT_TRUE(row.contains(key));
            EXPECT_NE(table.out.find(row[key].get<std::string>()), std::string::npos) << row[key] << " is missing in the table";
        }
    }
    // Without a word: the techniques, every promised one among them.
    const Json techniques = Json::parse(run({"list", "--json"}).out, nullptr, false);
    ASSERT_TRUE(techniques.is_array());
    std::vector<std::string> ids;
    for (const Json& t : techniques) ids.push_back(t.at("id"));
    for (const char* id : {"texture_mapping", "normal_mapping", "parallax_mapping", "parallax_offset_limiting", "parallax_slope", "parallax_iterative",
                           "linear_search", "binary_search", "relief_mapping", "parallax_occlusion_mapping", "cone_step_mapping", "max_mip_tracing"})
        EXPECT_NE(std::ranges::find(ids, id), ids.end()) << id;
}

TEST(Words, OutputThatCannotBePrintedIsAFailure) {
    if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
    const std::string command = std::string(RELIEVO_BINARY_DIR) + "/bin/relievo list --json > /dev/full 2> /dev/null";
    EXPECT_EQ(WEXITSTATUS(std::system(command.c_str())), 1);
}

}  // namespace relievo::test
