// The same command gives the same pictures and numbers, times aside: again, on one thread, on two, with a warm cache, over an old report.
#include "cli/materials.h"
#include "cli/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace relievo::test {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

Ended compare(const fs::path& folder, const std::string& out, const std::vector<std::string>& more) {
    std::vector<std::string> words{"compare", "--material", (folder / "wave").string(), "--material", "cobbles", "--texels", "64",
                                   "--view",  "grazing",    "--view", "steep",          "--size",     "64x36",   "--runs",
                                   "1",       "--device",   "software", "--out",        (folder / out).string()};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
}

// What may differ: when, how long, how it was asked for.
Json without_times(const fs::path& file) {
    Json results = Json::parse(read_text(file), nullptr, false);
    for (const char* key : {"date", "seconds", "command", "threads"}) results["manifest"].erase(key);
    for (const char* list : {"rows", "sweep"})
        for (Json& row : results[list]) row.erase("gpu_ms");
    return results;
}

bool holds_times(const std::string& file) { return file == "results.json" || file == "results.csv" || file == "index.html"; }

}  // namespace

TEST(Repeated, PicturesAndNumbersAreTheSame) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    wave_folder(folder.path() / "wave");
    write_png_16(folder.path() / "wave" / "wave_normal.png", wave_normals(32, 32, 0.05), FirstRow::bottom);
    const std::vector<std::pair<std::string, std::vector<std::string>>> runs{
        {"first", {}}, {"one_thread", {"--threads", "1", "--no-cache"}}, {"two_threads", {"--threads", "2"}}};
    for (const auto& [out, more] : runs) {
        const Ended ended = compare(folder.path(), out, more);
        ASSERT_EQ(ended.code, 0) << ended.err;
    }
    const auto files = files_below(folder.path() / "first");
    EXPECT_GT(files.size(), 100u) << "twelve techniques, two views, two materials";
    const Json first = without_times(folder.path() / "first" / "results.json");
    for (const char* out : {"one_thread", "two_threads"}) {
        SCOPED_TRACE(out);
        EXPECT_EQ(files_below(folder.path() / out), files);
        for (const std::string& file : files)
            if (!holds_times(file)) {
                EXPECT_EQ(read_text(folder.path() / "first" / file), read_text(folder.path() / out / file)) << file;
            }
        EXPECT_EQ(Json::diff(first, without_times(folder.path() / out / "results.json")), Json::array());
    }

    // Over an old report, other people's files beside it.
    write_text(folder / "first/notes.txt", "mine");
    write_text(folder / "first/pictures/notes.txt", "mine too");
    const Ended again = compare(folder.path(), "first", {"--quiet"});
    ASSERT_EQ(again.code, 0) << again.err;
    EXPECT_EQ(again.err, "");
    EXPECT_EQ(without_times(folder.path() / "first" / "results.json"), first);
    EXPECT_EQ(files_below(folder.path() / "first").size(), files.size() + 2);
    EXPECT_EQ(read_text(folder / "first/notes.txt"), "mine");
    EXPECT_EQ(read_text(folder / "first/pictures/notes.txt"), "mine too");
}

}  // namespace relievo::test
