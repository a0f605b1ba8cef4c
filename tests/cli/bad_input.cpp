// What people really hand over: missing, empty, cut, mistaken and unwritable. Every case ends with exit code 1, a message that names
// the file, and nothing written; none ends with a signal.
#include "cli/materials.h"
#include "cli/program.h"

#include <gtest/gtest.h>

#include <limits>

namespace relievo::test {

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

// Bakes the cone map, which needs the whole way from file to heights, and no device.
Ended bake(const Words& material, const std::string& out) {
    Words words{"bake", "--map", "cone", "--out", out};
    words.insert(words.end(), material.begin(), material.end());
    return run(words);
}

void expect_failure(const Ended& ended, const Words& said) {
    EXPECT_EQ(ended.code, 1) << "signal " << ended.signal << "\n" << ended.err;
    EXPECT_EQ(ended.out, "");
    EXPECT_NE(ended.err.find("relievo: cannot "), std::string::npos) << ended.err;
    for (const std::string& s : said) EXPECT_NE(ended.err.find(s), std::string::npos) << "not said: " << s << "\n" << ended.err;
}

class BadInput : public testing::Test {
protected:
    // A material folder of which the test writes the files.
    std::string make(const std::string& name) {
        fs::create_directories(folder.path() / "in" / name);
        return (folder.path() / "in" / name).string();
    }
    void refuses(const std::string& material, const Words& said) {
        SCOPED_TRACE(material);
        fs::create_directories(out);
        expect_failure(bake({"--material", material}, (out / "cone.exr").string()), said);
        EXPECT_TRUE(files_below(out).empty());
    }
    void accepts(const std::string& material) {
        SCOPED_TRACE(material);
        fs::create_directories(out);
        const Ended ended = bake({"--material", material}, (out / "cone.exr").string());
        EXPECT_EQ(ended.code, 0) << "signal " << ended.signal << "\n" << ended.err;
        EXPECT_EQ(files_below(out), Words{"cone.exr"});
        fs::remove_all(out);
    }

    Folder folder;
    fs::path out = folder.path() / "out";
};

}  // namespace

TEST_F(BadInput, FoldersWithoutAMaterial) {
    refuses(folder / "nowhere", {"nowhere", "no such folder"});
    refuses("cobles", {"cobles", "'cobbles'"});
    refuses(make("empty"), {"empty", "height"});
    const std::string texts = make("texts");
    write_text(texts + "/readme.txt", "no pictures here");
    refuses(texts, {"texts", "height"});
    const std::string colour = make("only_colour");
    write_png(colour + "/wall_colour.png", colour_stripes(8, 8), FirstRow::bottom);
    refuses(colour, {"wall_colour.png", "height"});
    refuses(colour + "/wall_colour.png", {"wall_colour.png", "folder"});
}

TEST_F(BadInput, FilesThatAreNoPictures) {
    const std::string nothing = make("nothing");
    write_text(nothing + "/a_height.png", "");
    refuses(nothing, {"a_height.png", "empty"});

    const std::string text = make("text");
    write_text(text + "/a_height.png", "These are words.\n");
    refuses(text, {"a_height.png"});

    const std::string whole = make("whole");
    write_png_16(fs::path(whole) / "a_height.png", wave_heights(64, 64), FirstRow::bottom);
    const std::string bytes = read_text(whole + "/a_height.png");
    const std::string cut = make("cut");
    for (const std::size_t length : {std::size_t{4}, std::size_t{8}, std::size_t{20}, std::size_t{40}, bytes.size() / 2, bytes.size() - 16, bytes.size() - 1}) {
        SCOPED_TRACE(length);
        write_text(cut + "/a_height.png", bytes.substr(0, length));
        refuses(cut, {"a_height.png"});
    }
    std::string flipped = bytes;
    flipped[flipped.size() / 2] = static_cast<char>(flipped[flipped.size() / 2] ^ 0x55);
    write_text(cut + "/a_height.png", flipped);
    refuses(cut, {"a_height.png"});

    const std::string folder_as_file = make("folder_as_file");
    fs::create_directories(folder_as_file + "/a_height.png");
    refuses(folder_as_file, {"folder_as_file"});

    fs::create_directories(out);
    expect_failure(bake({"--height", folder / "no_height.png"}, (out / "cone.exr").string()), {"no_height.png"});
    expect_failure(bake({"--height", folder.path().string()}, (out / "cone.exr").string()), {folder.path().string()});
    EXPECT_TRUE(files_below(out).empty());
}

TEST_F(BadInput, HeightsThatAreNone) {
    for (const float value : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(), -std::numeric_limits<float>::infinity()}) {
        SCOPED_TRACE(value);
        const std::string spoiled = make("spoiled");
        ImageF heights = wave_heights(16, 16);
        heights(3, 7) = value;
        write_float_heights(fs::path(spoiled) / "a_height.exr", heights);
        refuses(spoiled, {"a_height.exr"});
    }
    const std::string colour = make("colour");
    write_png(fs::path(colour) / "a_height.png", colour_stripes(16, 16), FirstRow::bottom);
    refuses(colour, {"a_height.png", "colour"});
}

TEST_F(BadInput, UnusualIsNotBad) {
    const std::string one = make("one");
    write_png_16(fs::path(one) / "a_height.png", wave_heights(1, 1), FirstRow::bottom);
    accepts(one);
    const std::string row = make("row");
    write_png_16(fs::path(row) / "a_height.png", wave_heights(37, 1), FirstRow::bottom);
    accepts(row);
    const std::string odd = make("odd");
    write_png_16(fs::path(odd) / "a_height.png", wave_heights(37, 19), FirstRow::bottom);
    accepts(odd);
    const std::string flat = make("flat");
    write_png_16(fs::path(flat) / "a_height.png", ImageF(16, 16, 1, 0.5f), FirstRow::bottom);
    accepts(flat);
    const std::string mixed = make("mixed");
    write_png_16(fs::path(mixed) / "a_height.png", wave_heights(32, 32), FirstRow::bottom);
    write_png_16(fs::path(mixed) / "a_normal.png", wave_normals(64, 16, 0.05), FirstRow::bottom);
    write_png(fs::path(mixed) / "a_colour.png", colour_stripes(5, 7), FirstRow::bottom);
    accepts(mixed);
    const std::string normals = make("normals");
    write_png_16(fs::path(normals) / "a_normal.png", wave_normals(32, 32, 0.05), FirstRow::bottom);
    accepts(normals);
    if (!has_device()) return;
    for (const std::string& material : {one, row, odd, flat, mixed, normals}) {
        SCOPED_TRACE(material);
        const Ended ended = run({"compare", "--material", material, "--technique", "relief_mapping,cone_step_mapping,max_mip_tracing", "--view", "grazing", "--size",
                                 "33x17", "--runs", "1", "--device", "software", "--quiet", "--out", folder / "report"});
        EXPECT_EQ(ended.code, 0) << "signal " << ended.signal << "\n" << ended.err;
    }
}

TEST_F(BadInput, PlacesThatCannotBeWritten) {
    const std::string wave = wave_folder(folder.path() / "wave");
    write_text(folder / "file", "in the way");
    for (const std::string& place : {folder / "file/cone.exr", folder / "missing/cone.exr", std::string("/proc/cone.exr"), std::string("/dev/null/cone.exr")}) {
        SCOPED_TRACE(place);
        expect_failure(bake({"--material", wave}, place), {"cone.exr"});
        expect_failure(run({"render", "--material", wave, "--technique", "reference", "--size", "8x8", "--out", place}), {"cone.exr"});
    }
    fs::create_directories(folder.path() / "folder.exr");
    expect_failure(bake({"--material", wave}, folder / "folder.exr"), {"folder.exr"});
    EXPECT_EQ(read_text(folder / "file"), "in the way");

    expect_failure(run({"docs", "--no-figures", "--quiet", "--out", folder / "file"}), {"file"});
    if (!has_device()) return;
    for (const std::string& place : {folder / "file", folder / "file/report", std::string("/proc/report")}) {
        SCOPED_TRACE(place);
        expect_failure(run({"compare", "--material", wave, "--technique", "texture_mapping", "--size", "8x8", "--runs", "1", "--out", place}), {place});
    }
    EXPECT_EQ(read_text(folder / "file"), "in the way");
    // A file where the pictures' folder must be; a folder where the page must be.
    fs::create_directories(folder.path() / "report");
    write_text(folder / "report/pictures", "in the way");
    expect_failure(run({"compare", "--material", wave, "--technique", "texture_mapping", "--size", "8x8", "--runs", "1", "--out", folder / "report"}), {"pictures"});
    EXPECT_EQ(files_below(folder.path() / "report"), Words{"pictures"});
    fs::create_directories(folder.path() / "page/index.html");
    expect_failure(run({"compare", "--material", wave, "--technique", "texture_mapping", "--size", "8x8", "--runs", "1", "--out", folder / "page"}), {"index.html"});
    EXPECT_TRUE(files_below(folder.path() / "page").empty());
}

TEST_F(BadInput, TheLastOfSeveralMaterialsIsCheckedFirst) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Ended ended = run({"compare", "--material", "cobbles", "--material", folder / "nowhere", "--out", folder / "report"});
    expect_failure(ended, {"nowhere"});
    EXPECT_EQ(ended.err.find("comparing"), std::string::npos) << "work began before the slip was seen:\n" << ended.err;
    EXPECT_FALSE(fs::exists(folder / "report"));
}

TEST_F(BadInput, AnUnknownDeviceIsAnsweredWithTheList) {
    const Ended ended = run({"render", "--material", "cobbles", "--texels", "16", "--technique", "relief_mapping", "--size", "8x8", "--device", "quantum", "--out",
                             folder / "a.png"});
    expect_failure(ended, {"quantum"});
    EXPECT_TRUE(files_below(folder.path()).empty());
}

}  // namespace relievo::test
