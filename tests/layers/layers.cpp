// The table of layers in docs/architecture.md holds: for every #include under src and for every link in CMakeLists.txt.
#include "layers/layer_rules.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

namespace relievo::layers {
namespace {

const std::filesystem::path root = RELIEVO_SOURCE_DIR;

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    EXPECT_TRUE(in.good()) << file;
    return {std::istreambuf_iterator<char>(in), {}};
}

std::string listed(const std::vector<std::string>& sentences) {
    std::string all;
    for (const std::string& s : sentences) all += s + "\n";
    return all;
}

Rules project_rules() { return read_table(text_of(root / "docs/architecture.md")); }

TEST(Layers, every_include_keeps_to_the_table) {
    const auto broken = broken_includes(project_rules(), root / "src");
    EXPECT_TRUE(broken.empty()) << listed(broken);
}

TEST(Layers, every_link_is_in_the_table_and_the_other_way_round) {
    const auto stages = read_stages(text_of(root / "CMakeLists.txt"));
    EXPECT_GE(stages.size(), 14u);
    const auto broken = broken_links(project_rules(), stages);
    EXPECT_TRUE(broken.empty()) << listed(broken);
}

// What the table has to say whatever else changes.
TEST(Layers, the_table_itself_keeps_the_promises_of_the_design) {
    const Rules rules = project_rules();
    ASSERT_TRUE(rules.contains("core"));
    EXPECT_TRUE(rules.at("core").may_include.empty());
    for (const auto& [folder, rule] : rules)
        if (rule.libraries.contains("vulkan")) {
            EXPECT_TRUE(folder == "gpu" || folder == "render" || folder == "viewer") << folder;
        }
    for (const char* alone : {"reference", "measure", "maps", "textures", "assets"})
        EXPECT_EQ(rules.at(alone).may_include, std::set<std::string>{"core"}) << alone;
    // No circles: going up from any folder never comes back to it.
    for (const auto& [folder, rule] : rules) {
        std::set<std::string> reached;
        std::vector<std::string> open(rule.may_include.begin(), rule.may_include.end());
        while (!open.empty()) {
            const std::string next = open.back();
            open.pop_back();
            if (!reached.insert(next).second || !rules.contains(next)) continue;
            open.insert(open.end(), rules.at(next).may_include.begin(), rules.at(next).may_include.end());
        }
        EXPECT_FALSE(reached.contains(folder)) << folder << " reaches itself";
    }
}

// A made-up tree with one fault of each kind, and the same without: the checker must tell them apart.
class MadeUpTree : public testing::Test {
protected:
    void SetUp() override {
        src_ = std::filesystem::path(testing::TempDir()) / ("relievo_layers_" + std::to_string(::testing::UnitTest::GetInstance()->random_seed()) +
                                                            testing::UnitTest::GetInstance()->current_test_info()->name());
        std::filesystem::remove_all(src_);
        write("base/a.h", "#include <vector>\n#include \"base/b.h\"\n");
        write("top/t.cpp", "#include \"base/a.h\"\n  #  include <shiny/shiny.hpp>\n// #include \"side/s.h\" in a comment line is no include\n");
        write("side/s.h", "#include \"base/a.h\"\n#include <unistd.h>\n");
    }
    void TearDown() override { std::filesystem::remove_all(src_); }

    void write(const std::string& place, const std::string& text) {
        std::filesystem::create_directories((src_ / place).parent_path());
        std::ofstream(src_ / place) << text;
    }

    std::filesystem::path src_;
    const Rules rules_ = read_table(
        "words\n\n| folder | may include | libraries it may see |\n|---|---|---|\n| base | | |\n| top, side | base, `shaders/` | shiny |\n\n| folder | x |\n| no | y |\n");
};

TEST_F(MadeUpTree, without_a_fault_passes) {
    EXPECT_EQ(rules_.size(), 3u);
    EXPECT_EQ(listed(broken_includes(rules_, src_)), "");
}

TEST_F(MadeUpTree, each_fault_is_named) {
    write("base/up.h", "#include \"top/t.h\"\n");
    EXPECT_EQ(broken_includes(rules_, src_), std::vector<std::string>{"base/up.h includes top/t.h, but base may not see top"});
    write("base/up.h", "#include \"shared/heightfield.h\"\n");
    EXPECT_EQ(broken_includes(rules_, src_), std::vector<std::string>{"base/up.h includes shared/heightfield.h, but base may not see shaders/"});
    write("base/up.h", "#include <vulkan/vulkan.h>\n");
    EXPECT_EQ(broken_includes(rules_, src_), std::vector<std::string>{"base/up.h includes vulkan/vulkan.h, but base may not see vulkan"});
    write("base/up.h", "#include <zlib.h>\n");
    EXPECT_EQ(broken_includes(rules_, src_).size(), 1u);
    write("base/up.h", "#include \"heightfield_functions.h\"\n");
    EXPECT_EQ(broken_includes(rules_, src_).size(), 1u);
    write("base/up.h", "");
    write("side/inner/deep.cpp", "#include \"top/t.h\"\n");
    EXPECT_EQ(broken_includes(rules_, src_).size(), 1u);
    write("side/inner/deep.cpp", "");
    write("new/n.h", "");
    EXPECT_EQ(broken_includes(rules_, src_), std::vector<std::string>{"new/n.h: the folder new has no row in the table of layers"});
}

TEST_F(MadeUpTree, links_and_table_must_agree) {
    EXPECT_EQ(broken_links(rules_, read_stages("relievo_stage(base THIRD_PARTY x)\nrelievo_stage(top USES base)\nrelievo_stage(side USES base\n  THIRD_PARTY y)")),
              std::vector<std::string>{});
    EXPECT_EQ(broken_links(rules_, read_stages("relievo_stage(base)\nrelievo_stage(top USES base side)\nrelievo_stage(side USES base)")).size(), 1u);
    EXPECT_EQ(broken_links(rules_, read_stages("relievo_stage(base)\nrelievo_stage(top)\nrelievo_stage(side USES base)")).size(), 1u);
    EXPECT_EQ(broken_links(rules_, read_stages("relievo_stage(base)\nrelievo_stage(top USES base)")).size(), 1u);
    EXPECT_EQ(broken_links(rules_, read_stages("relievo_stage(base)\nrelievo_stage(top USES base)\nrelievo_stage(side USES base)\nrelievo_stage(more)")).size(), 1u);
}

}  // namespace
}  // namespace relievo::layers
