#include "report/results.h"
#include "sample_results.h"

#include "core/error.h"
#include "techniques/catalogue.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace relievo {
namespace {

using nlohmann::json;

Row full_row() {
    const Results results = test::many_rows(1, 1);
    Row row = *std::ranges::find(results.rows, "relief_mapping", &Row::technique);  // two knobs
    row.pixels = "pictures/a.js", row.reference_pixels = "pictures/r.js", row.where = "Worst in the far third.";
    return row;
}

Results results_of(const Row& row) {
    Results results = test::many_rows(1, 1);
    results.rows = {row};
    return results;
}

json first_row(const Row& row) { return json::parse(results_json(results_of(row)))["rows"][0]; }

TEST(ResultsJson, HasTheRowsThatWerePromised) {
    const json row = first_row(full_row());
    for (const char* key : {"technique", "material", "view", "elevation_deg", "knobs", "missed_first_hit", "early_hit", "uv_error_texels", "height_error",
                            "normal_error_deg", "shadow_mismatch", "flip", "ssim", "psnr_db", "fetches", "gpu_ms", "image", "error_image", "reference_image"})
        EXPECT_TRUE(row.contains(key)) << key;
    EXPECT_EQ(row["technique"], "relief_mapping");
    EXPECT_EQ(row["view"], "grazing");
    EXPECT_EQ(row["elevation_deg"], 15);
    EXPECT_EQ(row["knobs"], (json{{"max_steps", 30}, {"refine_steps", 6}}));
    for (const char* part : {"p50", "p99", "max"}) {
        EXPECT_TRUE(row["uv_error_texels"][part].is_number());
        EXPECT_TRUE(row["height_error"][part].is_number());
        EXPECT_TRUE(row["normal_error_deg"][part].is_number());
    }
    for (const char* part : {"mean", "p95", "max"}) EXPECT_TRUE(row["fetches"][part].is_number());
    for (const char* part : {"min", "median", "max"}) EXPECT_TRUE(row["gpu_ms"][part].is_number());
    EXPECT_FALSE(row.contains("reasons"));
}

TEST(ResultsJson, SaysWhyANumberIsMissing) {
    Row row = full_row();
    row.m.flip = Measured<double>::missing("the pictures differ in size");
    row.m.psnr_db = std::numeric_limits<double>::infinity();
    row.m.uv_error_texels = Percentiles{1, std::nan(""), 3};
    row.m.gpu_ms = {};
    row.error_image.clear();
    row.no_picture = "pictures were switched off";
    const json out = first_row(row);
    for (const char* key : {"flip", "psnr_db", "uv_error_texels", "gpu_ms", "error_image"}) {
        EXPECT_TRUE(out[key].is_null()) << key;
        EXPECT_FALSE(out["reasons"][key].get<std::string>().empty()) << key;
    }
    EXPECT_EQ(out["reasons"]["flip"], "the pictures differ in size");
    EXPECT_EQ(out["reasons"]["gpu_ms"], "not measured");
    EXPECT_EQ(out["reasons"]["error_image"], "pictures were switched off");
    EXPECT_EQ(out["reasons"].size(), 5u) << out["reasons"];
}

TEST(ResultsJson, ComesBackAsItWas) {
    Results results = test::many_rows(2, 3);
    results.rows[3].m.flip = Measured<double>::missing("too small for the filter");
    results.rows[4].fetches_image.clear();
    results.rows[4].no_picture = "no fetches on this device";
    results.rows[5] = full_row();
    results.rows[6].knobs = {{"refine_steps", 6}, {"max_steps", 30}};  // the order is the owner's
    results.error_legend = {.title = "UV error", .unit = "texels", .low_end = "early", .high_end = "late",
                            .stops = {{0, 0, {255, 255, 255}, "0"}, {1, 16, {170, 0, 0}, "16"}}, .keys = {{{128, 128, 128}, "background"}}};
    results.maps = {{Map::cone, "cone", "Cone map", "widest empty cone"}};
    results.manifest.materials[1].physical_size_m = 0.25;
    const std::string text = results_json(results);
    const Results back = parse_results(text, "test");
    EXPECT_EQ(results_json(back), text);
    EXPECT_EQ(back.rows.size(), results.rows.size());
    EXPECT_EQ(back.sweep.size(), results.sweep.size());
    EXPECT_EQ(back.rows[3].m.flip.reason, "too small for the filter");
    EXPECT_EQ(back.rows[6].knobs, results.rows[6].knobs);
    EXPECT_EQ(back.rows[0].m.gpu_ms->runs, 11);
    EXPECT_DOUBLE_EQ(back.rows[7].m.uv_error_texels->p99, results.rows[7].m.uv_error_texels->p99);
}

TEST(ResultsJson, KeepsNamesThatAreNoText) {
    Results results = results_of(full_row());
    results.rows[0].material = "caf\xe9 \"</script>";
    const json out = json::parse(results_json(results));
    EXPECT_NE(out["rows"][0]["material"].get<std::string>().find("</script>"), std::string::npos);
}

std::string error_of(const std::string& text) {
    try {
        parse_results(text, "some/results.json");
    } catch (const Error& e) {
        return e.what();
    }
    return "no error";
}

TEST(ResultsJson, NamesWhatIsWrong) {
    const std::string good = results_json(results_of(full_row()));
    EXPECT_EQ(error_of(good), "no error");
    const auto damaged = [&](auto change) {
        json data = json::parse(good);
        change(data);
        return error_of(data.dump());
    };
    EXPECT_NE(error_of("").find("not JSON"), std::string::npos);
    EXPECT_NE(error_of(good.substr(0, good.size() / 2)).find("written to the end"), std::string::npos);
    EXPECT_NE(error_of("[1, 2]").find("some/results.json"), std::string::npos);
    EXPECT_NE(error_of("[1, 2]").find("expected an object, found array"), std::string::npos);
    EXPECT_NE(damaged([](json& d) { d.erase("manifest"); }).find("\"manifest\" is missing"), std::string::npos);
    EXPECT_NE(damaged([](json& d) { d["rows"] = 3; }).find("rows: expected a list, found number"), std::string::npos);
    EXPECT_NE(damaged([](json& d) { d["rows"][0].erase("flip"); }).find("rows[0]: \"flip\" is missing"), std::string::npos);
    EXPECT_NE(damaged([](json& d) { d["rows"][0]["fetches"]["mean"] = "many"; }).find("rows[0].fetches.mean: expected a number, found string"), std::string::npos);
    EXPECT_NE(damaged([](json& d) { d["rows"][0]["knobs"] = json::array(); }).find("rows[0].knobs"), std::string::npos);
    EXPECT_NE(damaged([](json& d) { d["manifest"]["width"] = 1.5; }).find("manifest.width: expected a whole number"), std::string::npos);
    EXPECT_NE(damaged([](json& d) { d["maps"] = {{{"index", 99}, {"id", "x"}, {"title", "x"}, {"summary", ""}}}; }).find("no map has index 99"), std::string::npos);
}

TEST(ResultsJson, IsReadFromItsFolder) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "relievo_results";
    const Results results = test::many_rows(1, 2);
    test::write_text(folder / "results.json", results_json(results));
    EXPECT_EQ(results_json(read_results(folder)), results_json(results));
    EXPECT_EQ(results_json(read_results(folder / "results.json")), results_json(results));
    std::filesystem::remove_all(folder);
    EXPECT_THROW(read_results(folder), Error);
}

std::vector<std::vector<std::string>> table_of(const std::string& csv) {
    std::vector<std::vector<std::string>> lines(1);
    std::string field;
    bool quoted = false;
    for (std::size_t i = 0; i < csv.size(); ++i) {
        const char c = csv[i];
        if (quoted && c == '"' && i + 1 < csv.size() && csv[i + 1] == '"') field += '"', ++i;
        else if (c == '"') quoted = !quoted;
        else if (!quoted && (c == ',' || c == '\n')) {
            lines.back().push_back(field), field.clear();
            if (c == '\n') lines.emplace_back();
        } else if (quoted || c != '\r') field += c;
    }
    lines.pop_back();
    return lines;
}

TEST(ResultsCsv, HasARowPerRowAndAColumnPerNumber) {
    Results results = test::many_rows(2, 3);
    results.rows[2].m.ssim = Measured<double>::missing("none");
    results.rows[2].material = "one, \"two\"\nthree";
    const auto table = table_of(results_csv(results));
    ASSERT_EQ(table.size(), results.rows.size() + 1);
    for (const auto& line : table) EXPECT_EQ(line.size(), table[0].size());
    const auto column = [&](const std::string& name) {
        return static_cast<std::size_t>(std::ranges::find(table[0], name) - table[0].begin());
    };
    EXPECT_EQ(table[3][column("material")], "one, \"two\"\nthree");
    EXPECT_EQ(table[3][column("ssim")], "");
    EXPECT_EQ(table[1][column("max_steps")], "");  // texture mapping has no knobs
    const auto relief = static_cast<std::size_t>(std::ranges::find(results.rows, "relief_mapping", &Row::technique) - results.rows.begin());
    EXPECT_EQ(table[relief + 1][column("max_steps")], "30");
    for (std::size_t i = 0; i < results.rows.size(); ++i) {
        EXPECT_EQ(table[i + 1][column("technique")], results.rows[i].technique);
        EXPECT_NEAR(std::stod(table[i + 1][column("uv_error_texels_p99")]), results.rows[i].m.uv_error_texels->p99, 1e-7);
        EXPECT_NEAR(std::stod(table[i + 1][column("gpu_ms_median")]), results.rows[i].m.gpu_ms->median, 1e-7);
    }
}

}  // namespace
}  // namespace relievo
