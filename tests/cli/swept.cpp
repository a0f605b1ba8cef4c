// compare --sweep: every technique over its budget knob, in every view, each setting once.
#include "cli/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <map>
#include <set>

namespace relievo::test {

namespace {

using Json = nlohmann::json;

Json sweep(const std::string& flag, const std::string& out) {
    const Ended ended = run({"compare", "--material", "cobbles", "--texels", "32", "--view", "grazing", "--view", "steep", "--size", "32x18", "--runs", "1", "--technique",
                             "linear_search,parallax_iterative,cone_step_mapping,max_mip_tracing,normal_mapping", "--device", "software", flag, "--out", out});
    EXPECT_EQ(ended.code, 0) << ended.err;
    return Json::parse(read_text(std::filesystem::path(out) / "results.json"), nullptr, false);
}

}  // namespace

TEST(Swept, EveryViewOverTheWholeBudget) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const Json full = sweep("--sweep", folder / "full");
    ASSERT_TRUE(full.is_object());
    EXPECT_EQ(full["rows"].size(), 10u);
    std::map<std::string, std::set<double>> budgets;  // technique and view -> values of the budget knob
    for (const char* list : {"rows", "sweep"})
        for (const Json& row : full[list]) {
            const std::string technique = row["technique"];
            const std::string knob = technique == "parallax_iterative" ? "iterations" : "max_steps";
            if (!row["knobs"].contains(knob)) continue;
            EXPECT_TRUE(budgets[technique + " " + row["view"].get<std::string>()].insert(row["knobs"][knob].get<double>()).second) << "a setting came twice: " << row["knobs"];
            EXPECT_FALSE(row["missed_first_hit"].is_null());
            EXPECT_FALSE(row["gpu_ms"].is_null());
        }
    for (const char* view : {"grazing", "steep"}) {
        EXPECT_EQ(budgets[std::string("linear_search ") + view], (std::set<double>{8, 16, 32, 64, 128, 256, 512}));
        EXPECT_EQ(budgets[std::string("cone_step_mapping ") + view], (std::set<double>{8, 16, 32, 64, 128, 256, 512}));
        EXPECT_EQ(budgets[std::string("max_mip_tracing ") + view].size(), 1u) << "an exact technique is a point";
        const std::set<double>& iterations = budgets[std::string("parallax_iterative ") + view];
        EXPECT_GE(iterations.size(), 5u);
        EXPECT_EQ(*iterations.begin(), 1) << "whole numbers end at their range";
    }
    // Without the flag: half and twice, in the first view.
    const Json small = sweep("--shadow=none", folder / "small");
    for (const Json& row : small["sweep"]) EXPECT_EQ(row["view"], "grazing");
    EXPECT_EQ(small["sweep"].size(), 6u);
    EXPECT_EQ(sweep("--no-sweep", folder / "none")["sweep"].size(), 0u);
    EXPECT_EQ(run({"compare", "--sweep", "--no-sweep", "--out", folder / "x"}).code, 2);
}

}  // namespace relievo::test
