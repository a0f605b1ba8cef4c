// The page as text, and the folder that browser_test.py opens.
#include "sample_results.h"

#include "core/error.h"
#include "report/page.h"

#include <gtest/gtest.h>

#include <cstdlib>

namespace relievo {
namespace {

std::filesystem::path page_folder() {
    const char* chosen = std::getenv("RELIEVO_SAMPLE_REPORT");
    return chosen ? std::filesystem::path(chosen) : std::filesystem::path(RELIEVO_BINARY_DIR) / "tests" / "sample_report";
}

TEST(Page, WritesTheSampleReport) {
    test::SampleSettings settings;
    if (const char* width = std::getenv("RELIEVO_SAMPLE_WIDTH")) settings.width = std::atoi(width), settings.height = settings.width * 9 / 16;
    const Results results = test::sample_results(page_folder(), settings);
    const std::string html = page_html(results);
    test::write_text(page_folder() / "index.html", html);
    test::write_text(page_folder() / "results.json", results_json(results));
    test::write_text(page_folder() / "results.csv", results_csv(results));
    EXPECT_LT(html.size(), 400'000u);
}

}  // namespace
}  // namespace relievo
