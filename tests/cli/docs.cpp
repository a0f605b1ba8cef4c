// The generated part of the documentation is what the program writes today.
#include "cli/program.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace relievo::test {

namespace {

namespace fs = std::filesystem;

// Numbers of a machine stand between these marks; all else is the same everywhere.
std::string without_measured(std::string text) {
    const std::string open = "<!-- measured -->", close = "<!-- /measured -->";
    std::size_t from = 0;
    while ((from = text.find(open, from)) != std::string::npos) {
        const std::size_t end = text.find(close, from);
        if (end == std::string::npos) break;
        text.erase(from + open.size(), end - from - open.size());
        from += open.size();
    }
    return text;
}

}  // namespace

TEST(Docs, GeneratedTextsAreUpToDate) {
    const Folder folder;
    const Ended ended = run({"docs", "--no-figures", "--quiet", "--out", folder / "generated"});
    ASSERT_EQ(ended.code, 0) << ended.err;
    EXPECT_EQ(ended.out + ended.err, "");
    const fs::path kept = fs::path(RELIEVO_SOURCE_DIR) / "docs" / "generated";
    const auto written = files_below(folder / "generated");
    EXPECT_FALSE(written.empty());
    for (const std::string& file : written)
        EXPECT_TRUE(without_measured(read_text(folder.path() / "generated" / file)) == without_measured(read_text(kept / file)))
            << "docs/generated/" << file << " is not what the program writes; run: relievo docs --out docs/generated";
    // A technique that is gone leaves no chapter.
    for (const std::string& file : files_below(kept))
        if (file.ends_with(".md")) {
            EXPECT_NE(std::ranges::find(written, file), written.end()) << "docs/generated/" << file << " is no longer written; delete it";
        }
}

}  // namespace relievo::test
