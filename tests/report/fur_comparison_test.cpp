// The texts of a comparison of fur: everything in them, read back, and names that are no markup.
#include "report/fur_comparison.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace relievo {
namespace {

FurComparison two_modes() {
    FurComparison f{.version = "1", .command = "relievo compare fur <a>.obj", .device = "d", .width = 64, .height = 40, .passes = 2, .samples = 4, .rows = {}, .refused = {"cannot read b&.ply: byte 9"}};
    FurRow row{.mesh = "<a>,.obj", .preset = "fox", .mode = "classic", .faces = 12, .strands = 34, .layers = 16,
               .errors = {.flip = 0.25, .coverage_error = 0.125, .gaps = 0.01, .density_p95_over_p5 = std::numeric_limits<double>::infinity()},
               .budget = {.flip = 0.2, .coverage_error = 0.2, .gaps = 0.01, .density_p95_over_p5 = 2}, .shared_texel_area = 0.5, .first_frame_ms = 100, .frame_ms = 50, .picture = "a_classic.png", .reference = "a_traced.png"};
    f.rows.push_back(row);
    row.mode = "strands";
    row.errors.density_p95_over_p5 = 1.25;
    row.errors.flip = 0.0625;
    row.frame_ms = 75;
    row.picture = "a_strands.png";
    f.rows.push_back(row);
    return f;
}

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(FurComparison, JsonHoldsEveryNumberAndNoInfinity) {
    const nlohmann::json json = nlohmann::json::parse(fur_comparison_json(two_modes()));
    ASSERT_EQ(json["rows"].size(), 2u);
    EXPECT_EQ(json["samples"], 4);
    EXPECT_EQ(json["refused"][0], "cannot read b&.ply: byte 9");
    const nlohmann::json& classic = json["rows"][0];
    EXPECT_TRUE(classic["density_p95_over_p5"].is_null());
    EXPECT_EQ(classic["mesh"], "<a>,.obj");
    EXPECT_EQ(classic["flip"], 0.25);
    EXPECT_EQ(classic["coverage_error"], 0.125);
    EXPECT_EQ(classic["gaps"], 0.01);
    EXPECT_EQ(classic["shared_texel_area"], 0.5);
    EXPECT_EQ(classic["first_frame_ms"], 100);
    EXPECT_EQ(classic["frame_ms"], 50);
    EXPECT_EQ(classic["strands"], 34);
    EXPECT_EQ(json["rows"][1]["density_p95_over_p5"], 1.25);
    EXPECT_EQ(classic["inside_budget"], false);
    EXPECT_EQ(classic["outside"], nlohmann::json({"flip", "density_p95_over_p5"}));
    EXPECT_EQ(classic["budget"]["gaps"], 0.01);
    EXPECT_EQ(json["rows"][1]["inside_budget"], true);
    EXPECT_TRUE(json["rows"][1]["outside"].empty());
}

TEST(FurComparison, CsvQuotesNamesAndLeavesInfinityOut) {
    EXPECT_EQ(fur_comparison_csv(two_modes()),
              "mesh,preset,mode,faces,strands,layers,flip,coverage_error,gaps,density_p95_over_p5,shared_texel_area,first_frame_ms,frame_ms,inside_budget,outside\n"
              "\"<a>,.obj\",fox,classic,12,34,16,0.250000,0.125000,0.010000,,0.500000,100.000000,50.000000,false,\"flip, density_p95_over_p5\"\n"
              "\"<a>,.obj\",fox,strands,12,34,16,0.062500,0.125000,0.010000,1.250000,0.500000,100.000000,75.000000,true,\n");
}

TEST(FurComparison, PageMarksTheBestAndShowsNamesAsText) {
    const std::string page = fur_comparison_page(two_modes());
    EXPECT_TRUE(has(page, "<td>0.2500</td>"));
    EXPECT_TRUE(has(page, "<td class=best>0.0625</td>"));
    EXPECT_TRUE(has(page, "<td class=best>50.0</td>"));
    EXPECT_TRUE(has(page, "<td>-</td>"));  // no infinity
    EXPECT_TRUE(has(page, "&lt;a&gt;,.obj, fox"));
    EXPECT_FALSE(has(page, "<a>"));
    EXPECT_TRUE(has(page, "b&amp;.ply"));
    EXPECT_TRUE(has(page, "src=\"a_traced.png\""));
}

TEST(FurComparison, TextHasALineARowAndTheRefusals) {
    const std::string text = fur_comparison_text(two_modes());
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 5);
    EXPECT_TRUE(has(text, "strands"));
    EXPECT_TRUE(has(text, "byte 9"));
    EXPECT_TRUE(has(text, "outside: FLIP, density\n"));
    EXPECT_TRUE(has(text, "inside\n"));
    EXPECT_TRUE(has(text, "1 of 2 pictures are outside their mode's budget: <a>,.obj in fox by classic (FLIP, density)."));
}

TEST(FurComparison, ABudgetOfInfinityAllowsInfinity) {
    FurComparison f = two_modes();
    f.rows[0].budget = {.flip = 0.25, .coverage_error = 0.125, .gaps = 0.01, .density_p95_over_p5 = std::numeric_limits<double>::infinity()};
    EXPECT_TRUE(has(fur_comparison_text(f), "All 2 pictures are inside their mode's budget."));
    EXPECT_TRUE(nlohmann::json::parse(fur_comparison_json(f))["rows"][0]["budget"]["density_p95_over_p5"].is_null());
    f.rows[0].errors.gaps = std::nan("");
    EXPECT_TRUE(has(fur_comparison_text(f), "outside: gaps"));
}

}  // namespace
}  // namespace relievo
