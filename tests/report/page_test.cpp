// The page as text, and the folder that browser_test.py opens.
#include "report/page.h"
#include "report/budget_table.h"
#include "report/measurement_fields.h"
#include "report/technique_text.h"
#include "sample_results.h"

#include "core/error.h"
#include "techniques/catalogue.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cstdlib>

namespace relievo {
namespace {

using nlohmann::json;

std::filesystem::path page_folder() {
    const char* chosen = std::getenv("RELIEVO_SAMPLE_REPORT");
    return chosen ? std::filesystem::path(chosen) : std::filesystem::path(RELIEVO_BINARY_DIR) / "tests" / "sample_report";
}

json data_of(const std::string& html) {
    const std::string start = "<script type=\"application/json\" id=\"data\">";
    const std::size_t from = html.find(start) + start.size();
    return json::parse(html.substr(from, html.find("</script>", from) - from));
}

TEST(Page, WritesTheSampleReport) {
    test::SampleSettings settings;
    if (const char* width = std::getenv("RELIEVO_SAMPLE_WIDTH")) settings.width = std::atoi(width), settings.height = settings.width * 9 / 16;
    const Results results = test::sample_results(page_folder(), settings);
    const std::string html = page_html(results);
    test::write_text(page_folder() / "index.html", html);
    test::write_text(page_folder() / "results.json", results_json(results));
    test::write_text(page_folder() / "results.csv", results_csv(results));
    for (const Row& row : results.rows)
        for (const std::string& path : {row.image, row.error_image, row.fetches_image, row.reference_image, row.pixels, row.reference_pixels})
            EXPECT_TRUE(std::filesystem::exists(page_folder() / path)) << path;
}

TEST(Page, WritesALargeReport) {
    const Results results = test::many_rows(30, 5);
    ASSERT_EQ(results.rows.size(), 30 * 3 * techniques().size());
    const auto begin = std::chrono::steady_clock::now();
    const std::string html = page_html(results);
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    EXPECT_LT(html.size(), 2'100'000u);
    EXPECT_LT(seconds, 10.0);  // some 0.1 s in release; slow machines and sanitizers get the rest
    test::write_text(page_folder().parent_path() / "large_report" / "index.html", html);
}

TEST(Page, IsSmallAndNeedsNothingFromOutside) {
    const std::string html = page_html(test::many_rows(5, 5));
    EXPECT_LT(html.size(), 1'000'000u);
    for (std::size_t at = 0; (at = html.find("http", at)) != std::string::npos; at += 4)
        EXPECT_EQ(html.substr(at, 26), "http://www.w3.org/2000/svg") << html.substr(at, 60);  // the name of SVG, never fetched
    for (const char* mark : {"<link rel=\"stylesheet", "@import", "fetch(", "XMLHttpRequest", "@{"}) EXPECT_EQ(html.find(mark), std::string::npos) << mark;
}

TEST(Page, HoldsEveryNumberUnderItsColumn) {
    Results results = test::many_rows(1, 1);
    Measurement& m = results.rows[4].m;
    m.missed_first_hit = 0.5, m.early_hit = 0.25, m.astray = 0.02, m.astray_budget = 0.03;
    m.uv_error_texels = Percentiles{1, 2, 3}, m.height_error = Percentiles{4, 5, 6}, m.normal_error_deg = Percentiles{7, 8, 9};
    m.shadow_mismatch = 10, m.flip = 11, m.ssim = 12, m.psnr_db = 13, m.fetches = FetchCount{14, 15, 16}, m.gpu_ms = TimeSpread{17, 18, 19, 11};
    const json data = data_of(page_html(results));
    const json& row = data["rows"][4];
    ASSERT_EQ(row["n"].size(), data["columns"].size());
    const json expected{{"wrong", 0.75}, {"missed_first_hit", 0.5}, {"early_hit", 0.25}, {"astray", 0.02}, {"astray_budget", 0.03}, {"uv_error_texels.p50", 1}, {"uv_error_texels.p99", 2}, {"uv_error_texels.max", 3},
                        {"height_error.p99", 5}, {"normal_error_deg.p99", 8}, {"shadow_mismatch", 10}, {"flip", 11}, {"ssim", 12}, {"psnr_db", 13},
                        {"fetches.mean", 14}, {"fetches.p95", 15}, {"fetches.max", 16}, {"gpu_ms.min", 17}, {"gpu_ms.median", 18}, {"gpu_ms.max", 19}};
    for (std::size_t i = 0; i < row["n"].size(); ++i) EXPECT_EQ(row["n"][i], expected[data["columns"][i]["id"].get<std::string>()]) << data["columns"][i]["id"];
}

TEST(Page, TellsWhatTheCatalogueTells) {
    const json data = data_of(page_html(test::many_rows(1, 1)));
    ASSERT_EQ(data["techniques"].size(), techniques().size());
    for (std::size_t i = 0; i < techniques().size(); ++i) {
        const Technique& t = techniques()[i];
        EXPECT_EQ(data["techniques"][i]["id"], t.id);
        EXPECT_EQ(data["techniques"][i]["limits"], t.limits);
        EXPECT_EQ(data["techniques"][i]["promise"], promise_text(t));
        EXPECT_EQ(data["techniques"][i]["year"], t.source.year);
        EXPECT_EQ(data["techniques"][i]["knobs"].size(), static_cast<std::size_t>(t.knobs.count));
    }
}

TEST(Page, SurvivesTechniquesAndNamesItDoesNotKnow) {
    Results results = test::many_rows(1, 1);
    results.rows[0].technique = "cell_cone_tracing_of_tomorrow";
    results.rows[1].material = "</script><script>alert(1)</script><!--";
    results.rows[1].m.flip = Measured<double>::missing("<b>");
    results.manifest.command = "relievo compare --material '<img src=x>'";
    const std::string html = page_html(results);
    EXPECT_EQ(html.find("alert(1)</script>"), std::string::npos);
    EXPECT_EQ(html.find("<img src=x>"), std::string::npos);
    const json data = data_of(html);
    EXPECT_EQ(data["techniques"].back()["id"], "cell_cone_tracing_of_tomorrow");
    EXPECT_EQ(data["materials"].back()["id"], "</script><script>alert(1)</script><!--");
}

TEST(Page, RefusesToSayNothing) { EXPECT_THROW(page_html({}), Error); }

// --- the answer ------------------------------------------------------------------------------------------------------------

Row row_of(const char* technique, const char* material, double elevation, double missed, double ms) {
    Row row;
    row.technique = technique, row.material = material, row.view = std::to_string(elevation), row.elevation_deg = elevation;
    row.m.missed_first_hit = missed, row.m.early_hit = 0.0;
    if (ms > 0) row.m.gpu_ms = TimeSpread{ms, ms, ms, 11};
    return row;
}

TEST(Answer, IsToldOnTheHardestCase) {
    Results results;
    results.rows = {row_of("max_mip_tracing", "river_cobbles", 27.5, 0, 3), row_of("parallax_occlusion_mapping", "river_cobbles", 27.5, 0.04, 2),
                    row_of("relief_mapping", "river_cobbles", 27.5, 0.05, 2), row_of("texture_mapping", "river_cobbles", 27.5, 1, 1),
                    row_of("max_mip_tracing", "dunes", 65, 0.0001, 3), row_of("parallax_occlusion_mapping", "dunes", 65, 0.02, 2)};
    results.rows[1].knobs = {{"max_steps", 64}, {"min_steps", 1}};
    const auto said = answer(results);
    ASSERT_EQ(said.size(), 3u);
    EXPECT_EQ(said[0], "On river cobbles seen at 27.5 degrees, maximum mipmap tracing shows no wrong pixel, at 1.5 times the time of parallax occlusion mapping "
                       "with 64 steps, 1 step seen from above, which puts 4.0\u202f% of the pixels in the wrong place.");
    EXPECT_EQ(said[1], "Relief mapping gets 5.0\u202f% wrong there.");
    EXPECT_EQ(said[2], "Over all 2 pictures of 2 materials, the exact search shows at most 0.010\u202f% wrong pixels; the best of the others, parallax occlusion mapping, "
                       "is wrong on 3.0\u202f% on average.");
}

TEST(Answer, DoesWithoutTimesExactTechniquesAndContrast) {
    Results results;
    results.rows = {row_of("max_mip_tracing", "a", 30, 0, 0), row_of("relief_mapping", "a", 30, 0.01, 0)};
    EXPECT_EQ(answer(results).at(0), "On a seen at 30 degrees, maximum mipmap tracing shows no wrong pixel; relief mapping puts 1.0\u202f% of the pixels in the wrong place.");
    results.rows[0].m.fetches = FetchCount{10, 20, 30}, results.rows[1].m.fetches = FetchCount{40, 50, 60};
    EXPECT_NE(answer(results).at(0).find("0.25 times the fetches of relief mapping"), std::string::npos);
    results.rows.erase(results.rows.begin());
    EXPECT_NE(answer(results).at(0).find("relief mapping comes closest"), std::string::npos);
    results.rows = {row_of("texture_mapping", "a", 30, 1, 1)};
    EXPECT_NE(answer(results).at(0).find("nothing to weigh"), std::string::npos);
    results.rows = {row_of("max_mip_tracing", "a", 30, 0, 2), row_of("relief_mapping", "a", 30, 0, 2)};
    EXPECT_NE(answer(results).at(0).find("which does as well."), std::string::npos);
}

TEST(Answer, SaysWhetherPromisesAreKept) {
    Results results;
    results.rows = {row_of("max_mip_tracing", "a", 30, 0, 2), row_of("relief_mapping", "a", 30, 0, 2)};
    for (Row& row : results.rows) row.m.astray = 0.001, row.m.astray_budget = 0.001;
    EXPECT_EQ(answer(results).back(), "Every technique keeps its promise in every picture.");
    results.rows[1].m.astray = 0.03;
    EXPECT_EQ(answer(results).back(), "1 of 2 pictures break what their technique promises; worst is relief mapping on a seen at 30 degrees, with 3.0\u202f% of its hits "
                                      "astray where 0.10\u202f% are allowed.");
    EXPECT_NE(budget_table(results).find("| relief_mapping | 0 of 1 | 3.0\u202f% / 3.0\u202f% |"), std::string::npos) << budget_table(results);
    results.rows.push_back(row_of("relief_mapping", "b", 30, 0, 2)), results.rows.back().m.astray = 0.00025, results.rows.back().m.astray_budget = 0.001;
    EXPECT_NE(budget_table(results).find("of 0.10\u202f% | 30 | b: 0.25 |"), std::string::npos) << budget_table(results);
    results.rows.pop_back();
    results.rows[1].m.astray = Measured<double>::missing("the relief was scaled");
    EXPECT_EQ(answer(results).back(), "Every technique keeps its promise in every picture.");
    EXPECT_EQ(budget_table(results).find("relief_mapping"), std::string::npos);
    results.rows[0].m.astray = Measured<double>::missing("the relief was scaled");
    EXPECT_EQ(answer(results).back().find("promise"), std::string::npos);
    EXPECT_EQ(budget_table(results), "");
}

TEST(Words, AreShort) {
    EXPECT_EQ(short_number(0), "0");
    EXPECT_EQ(short_number(73.4), "73");
    EXPECT_EQ(short_number(1234), "1234");
    EXPECT_EQ(short_number(0.00041), "0.00041");
    EXPECT_EQ(inside_sentence("Relief mapping"), "relief mapping");
    EXPECT_EQ(inside_sentence("POM of old"), "POM of old");
    EXPECT_EQ(setting_text({{"iterations", 1}}), "1 iteration");
    EXPECT_EQ(setting_text({{"unheard_of", 2.5}}), "2.5 unheard of");
    EXPECT_EQ(setting_text({}), "");
}

}  // namespace
}  // namespace relievo
