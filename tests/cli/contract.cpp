// What is promised to those who read relievo's files: names, types and ranges.
#include "cli/materials.h"
#include "cli/program.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>

namespace relievo::test {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

// Small enough for seconds, large enough to hold surface, shadow and horizon.
const std::vector<std::string> small{"--size", "64x36", "--runs", "1", "--no-sweep", "--texels", "64", "--device", "software"};

std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

Json json_of(const fs::path& file) { return Json::parse(read_text(file), nullptr, false); }

// A finite number in [low, high], or null with a reason under that name.
void expect_number(const Json& row, const Json& holder, const std::string& key, const std::string& field, double low, double high) {
    ASSERT_TRUE(holder.contains(key)) << field;
    const Json& value = holder[key];
    if (value.is_null()) {
        const std::string reason = row.value("reasons", Json::object()).value(field, "");
        EXPECT_FALSE(reason.empty()) << field << " is null without a reason";
        return;
    }
    ASSERT_TRUE(value.is_number()) << field << " is " << value;
    const double number = value;
    EXPECT_TRUE(std::isfinite(number)) << field;
    EXPECT_GE(number, low) << field;
    EXPECT_LE(number, high) << field;
}

void expect_row(const Json& row, const fs::path& folder) {
    constexpr double any = 1e30;
    SCOPED_TRACE(row.value("technique", "?") + " " + row.value("material", "?") + " " + row.value("view", "?"));
    for (const char* key : {"technique", "material", "view"}) ASSERT_TRUE(row.contains(key) && row[key].is_string()) << key;
    expect_number(row, row, "elevation_deg", "elevation_deg", 0, 90);
    ASSERT_TRUE(row.contains("knobs") && row["knobs"].is_object());
    for (const auto& knob : row["knobs"].items()) EXPECT_TRUE(knob.value().is_number()) << knob.key();
    for (const char* share : {"missed_first_hit", "early_hit", "shadow_mismatch", "flip", "astray", "astray_budget"}) expect_number(row, row, share, share, 0, 1);
    ASSERT_TRUE(row.contains("inside_budget") && row["inside_budget"].is_boolean());
    EXPECT_TRUE(row["inside_budget"]) << row["astray"] << " of " << row["astray_budget"];
    expect_number(row, row, "ssim", "ssim", -1, 1);
    expect_number(row, row, "psnr_db", "psnr_db", 0, any);
    const auto group = [&](const std::string& field, const std::vector<std::string>& parts) {
        ASSERT_TRUE(row.contains(field)) << field;
        if (row[field].is_null()) {
            expect_number(row, row, field, field, 0, 0);
            return;
        }
        double before = 0;
        for (const std::string& part : parts) {
            expect_number(row, row[field], part, field, 0, any);
            // p50 <= p99 <= max, min <= median <= max; a mean may exceed the 95th percentile.
            if (part != "p95" && row[field][part].is_number()) {
                EXPECT_GE(row[field][part].get<double>(), before) << field << "." << part;
                before = row[field][part];
            }
        }
    };
    for (const char* field : {"uv_error_texels", "height_error", "normal_error_deg"}) group(field, {"p50", "p99", "max"});
    group("fetches", {"mean", "p95", "max"});
    group("gpu_ms", {"min", "median", "max"});
    for (const char* picture : {"image", "error_image", "reference_image"}) {
        ASSERT_TRUE(row.contains(picture) && row[picture].is_string()) << picture;
        const fs::path file = folder / row[picture].get<std::string>();
        ASSERT_TRUE(fs::exists(file)) << file;
        const ImageFileInfo info = read_image_info(file);
        EXPECT_EQ(info.width, 64);
        EXPECT_EQ(info.height, 36);
    }
}

int lines_of(const std::string& text) { return static_cast<int>(std::ranges::count(text, '\n')); }

}  // namespace

TEST(Contract, CompareWritesTheReport) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const std::string wave = wave_folder(folder.path() / "wave");
    const fs::path out = folder.path() / "deep" / "report";  // neither is there yet
    const Ended ended = run(std::vector<std::string>{"compare", "--material", wave, "--material", "cobbles", "--technique",
                                                     "parallax_mapping,relief_mapping", "--technique", "max_mip_tracing,relief_mapping", "--view",
                                                     "grazing", "--view", "27.5", "--json", "--out", out.string()} +
                            small);
    ASSERT_EQ(ended.code, 0) << ended.err;

    const Json results = json_of(out / "results.json");
    ASSERT_TRUE(results.is_object());
    ASSERT_TRUE(results.contains("manifest") && results["manifest"].is_object());
    for (const char* key : {"command", "version", "device", "driver", "width", "height", "runs", "threads", "materials"})
        EXPECT_TRUE(results["manifest"].contains(key)) << key;
    EXPECT_EQ(Json::parse(ended.out, nullptr, false), results) << "standard output holds the same JSON and nothing else";

    ASSERT_TRUE(results.contains("rows"));
    const Json& rows = results["rows"];
    ASSERT_TRUE(rows.is_array());
    ASSERT_EQ(rows.size(), 2u * 3u * 2u) << "a technique named twice counts once";
    std::set<std::string> seen;
    for (const Json& row : rows) {
        expect_row(row, out);
        seen.insert(row["technique"].get<std::string>() + "|" + row["material"].get<std::string>() + "|" + row["view"].get<std::string>());
        if (row["view"] == "27.5") {
            EXPECT_EQ(row["elevation_deg"], 27.5);
        }
    }
    EXPECT_EQ(seen.size(), rows.size());
    EXPECT_TRUE(seen.contains("max_mip_tracing|wave|27.5"));
    EXPECT_TRUE(seen.contains("parallax_mapping|cobbles|grazing"));

    EXPECT_EQ(lines_of(read_text(out / "results.csv")), 1 + static_cast<int>(rows.size()));
    const std::string page = read_text(out / "index.html");
    EXPECT_NE(page.find("max_mip_tracing"), std::string::npos);
    EXPECT_EQ(page.find("src=\"http"), std::string::npos);
    for (const std::string& file : files_below(out)) EXPECT_EQ(file.find(".tmp"), std::string::npos) << file;

    // report: the page and the table again, the same but for nothing; from the file and from the folder.
    const std::string csv = read_text(out / "results.csv");
    const std::string budgets = read_text(out / "budgets.md");
    EXPECT_NE(budgets.find("max_mip_tracing"), std::string::npos) << budgets;
    for (const fs::path& named : {out / "results.json", out}) {
        fs::remove(out / "index.html");
        fs::remove(out / "results.csv");
        fs::remove(out / "budgets.md");
        const Ended again = run({"report", named.string()});
        EXPECT_EQ(again.code, 0) << again.err;
        EXPECT_EQ(again.out, "");
        EXPECT_EQ(read_text(out / "index.html"), page);
        EXPECT_EQ(read_text(out / "results.csv"), csv);
        EXPECT_EQ(read_text(out / "budgets.md"), budgets);
    }
    // Numbers of which none was judged leave no verdict of older ones behind.
    Json unjudged = json_of(out / "results.json");
    for (const char* of : {"rows", "sweep"})
        for (Json& row : unjudged[of]) row.erase("astray");
    write_text(out / "results.json", unjudged.dump());
    EXPECT_EQ(run({"report", out.string()}).code, 0);
    EXPECT_FALSE(fs::exists(out / "budgets.md"));
    const std::string last_page = read_text(out / "index.html");
    // A results.json that is none says so and spoils nothing.
    write_text(out / "results.json", "{\"manifest\": {");
    const Ended broken = run({"report", out.string()});
    EXPECT_EQ(broken.code, 1);
    EXPECT_NE(broken.err.find("results.json"), std::string::npos) << broken.err;
    EXPECT_EQ(read_text(out / "index.html"), last_page);
}

TEST(Contract, CompareTakesNamesAsTheyCome) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const std::string odd = "50% <b>\"a'b\"&\u00e4";
    const std::vector<std::string> materials{wave_folder(folder.path() / "a" / "wall"), wave_folder(folder.path() / "b" / "wall") + "/",
                                             wave_folder(folder.path() / odd), wave_folder(folder.path() / "s p"), wave_folder(folder.path() / "s_p"), "."};
    std::vector<std::string> words{"compare", "--technique", "relief_mapping", "--view", "middle", "--out", folder / "out"};
    for (const std::string& m : materials) words = words + std::vector<std::string>{"--material", m};
    const Ended ended = run(words + small, folder.path() / "a" / "wall");
    ASSERT_EQ(ended.code, 0) << ended.err;
    const fs::path out = folder.path() / "out";
    const Json results = json_of(out / "results.json");
    ASSERT_EQ(results["rows"].size(), materials.size());
    std::set<std::string> names, pictures;
    for (const Json& row : results["rows"]) {
        expect_row(row, out);
        names.insert(row["material"].get<std::string>());
        pictures.insert(row["image"].get<std::string>());
        // Paths that need no escaping in a page, an address or a shell.
        EXPECT_EQ(row["image"].get<std::string>().find_first_not_of("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-./"), std::string::npos)
            << row["image"];
    }
    EXPECT_EQ(names.size(), materials.size());
    EXPECT_EQ(pictures.size(), materials.size());
    EXPECT_TRUE(names.contains(odd)) << results["manifest"]["materials"];
    EXPECT_TRUE(names.contains("wall") && names.contains("wall-2") && names.contains("wall-3")) << results["manifest"]["materials"];
    EXPECT_EQ(read_text(out / "index.html").find("<b>\"a'b"), std::string::npos) << "a name became markup";
}

TEST(Contract, CompareTakesTheSmallestOfEverything) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    for (const char* size : {"1x1", "1x7", "13x1", "33x17"}) {
        SCOPED_TRACE(size);
        const Ended ended = run({"compare", "--material", "bricks", "--texels", "1", "--technique", "linear_search", "--view", "1", "--view", "90", "--size", size,
                                 "--runs", "1", "--samples", "1", "--shadow", "none", "--device", "software", "--out", folder / size});
        EXPECT_EQ(ended.code, 0) << ended.err;
        const Json results = json_of(fs::path(folder / size) / "results.json");
        ASSERT_TRUE(results.is_object());
        EXPECT_EQ(results["rows"].size(), 2u);
    }
}

TEST(Contract, RenderWritesPicturesAndPlanes) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    for (const char* technique : {"relief_mapping", "reference"}) {
        SCOPED_TRACE(technique);
        const std::string png = folder / (std::string(technique) + ".png");
        const std::string exr = folder / (std::string(technique) + ".exr");
        const std::vector<std::string> words{"render", "--material", "cobbles", "--texels", "64",        "--technique", technique,
                                             "--view", "grazing",    "--size",  "48x30", "--device", "software"};
        const Ended drawn = run(words + std::vector<std::string>{"--json", "--out", png});
        ASSERT_EQ(drawn.code, 0) << drawn.err;
        const Json said = Json::parse(drawn.out, nullptr, false);
        ASSERT_TRUE(said.is_object()) << drawn.out;
        EXPECT_EQ(said["technique"], technique);
        EXPECT_EQ(said["size"], Json({48, 30}));
        const ImageFileInfo info = read_image_info(png);
        EXPECT_EQ(info.width, 48);
        EXPECT_EQ(info.height, 30);

        const Ended planes = run(words + std::vector<std::string>{"--out", exr});
        ASSERT_EQ(planes.code, 0) << planes.err;
        EXPECT_EQ(planes.out, "");
        // The channel list is in the head of the file, each name followed by a zero.
        const std::string head = read_text(exr).substr(0, 2000);
        for (const std::string name : {"R", "G", "B", "hit.U", "hit.V", "height", "normal.X", "normal.Y", "normal.Z", "fetches", "mask", "shadow"})
            EXPECT_NE(head.find('\0' + name + '\0'), std::string::npos) << name;
        EXPECT_EQ(read_image_info(exr).channels, 12);
    }
    // A knob and the shadow change the picture.
    const auto picture = [&](const std::vector<std::string>& more) {
        const std::string file = folder / "again.png";
        const Ended ended = run(std::vector<std::string>{"render", "--material", "cobbles", "--texels", "64", "--technique", "relief_mapping", "--view",
                                                         "grazing", "--size", "48x30", "--device", "software", "--quiet", "--out", file} +
                                more);
        EXPECT_EQ(ended.code, 0) << ended.err;
        EXPECT_EQ(ended.err, "");
        return read_text(file);
    };
    const std::string plain = picture({});
    EXPECT_EQ(plain, read_text(folder / "relief_mapping.png"));
    EXPECT_NE(plain, picture({"--set", "max_steps=2", "--set", "refine_steps=0"}));
    EXPECT_NE(plain, picture({"--shadow", "none"}));
}

TEST(Contract, MaterialsMayBeNamedFileByFile) {
    const Folder folder;
    const fs::path height = folder.path() / "some.png", normal = folder.path() / "other.png", colour = folder.path() / "third.png";
    write_png_16(height, wave_heights(32, 32), FirstRow::bottom);
    write_png_16(normal, wave_normals(32, 32, 0.05), FirstRow::bottom);
    write_png(colour, colour_stripes(16, 16), FirstRow::bottom);
    const Ended baked = run({"bake", "--height", height.string(), "--normal", normal.string(), "--colour", colour.string(), "--map", "height", "--out",
                             folder / "height.exr"});
    ASSERT_EQ(baked.code, 0) << baked.err;
    const ImageF written = read_image(folder / "height.exr");
    const ImageF expected = wave_heights(32, 32);
    ASSERT_EQ(written.texels.size(), expected.texels.size());
    for (std::size_t i = 0; i < expected.texels.size(); ++i) ASSERT_NEAR(written.texels[i], expected.texels[i], 1.0 / 65535);

    const Ended coloured = run({"bake", "--height", height.string(), "--colour", colour.string(), "--map", "colour", "--out", folder / "colour.png"});
    ASSERT_EQ(coloured.code, 0) << coloured.err;
    EXPECT_EQ(read_image_8(folder / "colour.png")(3, 5, 0), colour_stripes(16, 16)(3, 5, 0));
    if (!has_device()) return;
    const Ended drawn = run({"render", "--height", height.string(), "--normal", normal.string(), "--colour", colour.string(), "--technique", "relief_mapping",
                             "--size", "32x18", "--device", "software", "--out", folder / "drawn.png"});
    EXPECT_EQ(drawn.code, 0) << drawn.err;
}

TEST(Contract, BakeWritesEveryMap) {
    const Folder folder;
    const std::string wave = wave_folder(folder.path() / "wave", 32, 16);
    const Json maps = Json::parse(run({"list", "maps", "--json"}).out, nullptr, false);
    ASSERT_TRUE(maps.is_array());
    for (const Json& map : maps) {
        const std::string id = map["id"];
        for (const std::string ending : {".png", ".exr"}) {
            if (id == "colour" && ending == ".exr") continue;  // 8-bit sRGB: words.cpp sees it refused
            SCOPED_TRACE(id + ending);
            const std::string file = folder / (id + ending);
            const Ended ended = run({"bake", "--material", wave, "--map", id, "--no-cache", "--json", "--threads", "2", "--out", file});
            ASSERT_EQ(ended.code, 0) << ended.err;
            const Json said = Json::parse(ended.out, nullptr, false);
            ASSERT_TRUE(said.is_object()) << ended.out;
            EXPECT_EQ(said["map"], id);
            EXPECT_EQ(said["threads"], 2);
            ASSERT_TRUE(said["ms"].is_number());
            EXPECT_GE(said["ms"].get<double>(), 0);
            const ImageFileInfo info = read_image_info(file);
            EXPECT_EQ(said["size"], Json({info.width, info.height}));
        }
    }
    // The pyramid's bound and the cone's ratio stay safe in 16 bits: never below, never above the float.
    const ImageF cone = read_image(folder / "cone.exr"), cone_png = read_image(folder / "cone.png");
    const ImageF top = read_image(folder / "max_pyramid.exr"), top_png = read_image(folder / "max_pyramid.png");
    for (int y = 0; y < cone.height; ++y)
        for (int x = 0; x < cone.width; ++x) EXPECT_LE(cone_png(x, y, 1), cone(x, y, 1));
    for (std::size_t i = 0; i < top.texels.size(); ++i) EXPECT_GE(top_png.texels[i], top.texels[i]);
}

// The device of this machine, even a software one where it is asked for, makes the file that the CPU makes.
TEST(Contract, ADeviceBakesTheSameMaps) {
    if (!has_device()) GTEST_SKIP() << "no Vulkan device";
    const Folder folder;
    const std::string wave = wave_folder(folder.path() / "wave", 37, 20);
    const Json maps = Json::parse(run({"list", "maps", "--json"}).out, nullptr, false);
    int on_device = 0;
    for (const Json& map : maps) {
        const std::string id = map["id"];
        SCOPED_TRACE(id);
        const auto baked = [&](const std::string& device, const std::string& file) {
            return run({"bake", "--material", wave, "--map", id, "--device", device, "--no-cache", "--json", "--quiet", "--out", file});
        };
        if (!map["on_device"].get<bool>()) {
            const Ended refused = baked("gpu", folder / "refused.png");
            EXPECT_EQ(refused.code, 2);
            for (const char* said : {"CPU", "cell_cone", id.c_str()}) EXPECT_NE(refused.err.find(said), std::string::npos) << refused.err;
            continue;
        }
        ++on_device;
        const Ended by_cpu = baked("cpu", folder / "cpu.exr");
        const Ended by_device = baked("gpu", folder / "device.exr");
        ASSERT_EQ(by_cpu.code, 0) << by_cpu.err;
        ASSERT_EQ(by_device.code, 0) << by_device.err;
        EXPECT_TRUE(read_text(folder / "cpu.exr") == read_text(folder / "device.exr"));
        EXPECT_EQ(Json::parse(by_cpu.out)["machine"], "CPU");
        EXPECT_EQ(Json::parse(by_cpu.out)["start_ms"], 0);
        const Json said = Json::parse(by_device.out);
        EXPECT_NE(said["machine"], "CPU");
        EXPECT_GT(said["start_ms"].get<double>(), 0);
        EXPECT_EQ(baked("voodoo2", folder / "none.exr").code, 1);
        // By itself a device bakes only if it is no software one.
        const Json devices = Json::parse(run({"list", "devices", "--json"}).out);
        const bool real = std::ranges::any_of(devices, [](const Json& d) { return d["kind"] == "GPU" && d["lacks"] == ""; });
        const Ended by_either = baked("auto", folder / "either.exr");
        ASSERT_EQ(by_either.code, 0) << by_either.err;
        EXPECT_EQ(Json::parse(by_either.out)["machine"] != "CPU", real);
    }
    EXPECT_GT(on_device, 0);
}

// Without Vulkan the CPU bakes unless a device is insisted on.
TEST(Contract, BakingNeedsNoDevice) {
    const Folder folder;
    const std::string wave = wave_folder(folder.path() / "wave", 16, 16);
    for (const char* list : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) ::setenv(list, "/no/driver.json", 1);
    const auto baked = [&](const std::string& device) {
        return run({"bake", "--material", wave, "--map", "cell_cone", "--device", device, "--json", "--out", folder / (device + ".exr")});
    };
    const Ended by_cpu = baked("cpu");
    const Ended any = baked("auto");
    const Ended insisted = baked("gpu");
    for (const char* list : {"VK_DRIVER_FILES", "VK_ICD_FILENAMES"}) ::unsetenv(list);
    EXPECT_EQ(by_cpu.code, 0) << by_cpu.err;
    ASSERT_EQ(any.code, 0) << any.err;
    EXPECT_EQ(Json::parse(any.out)["machine"], "CPU");
    EXPECT_EQ(insisted.code, 1);
    EXPECT_NE(insisted.err.find("Vulkan"), std::string::npos) << insisted.err;
    EXPECT_TRUE(read_text(folder / "cpu.exr") == read_text(folder / "auto.exr"));
}

TEST(Contract, TheCacheChangesNothing) {
    const Folder folder;
    const std::string wave = wave_folder(folder.path() / "wave");
    const auto cone = [&](const std::string& name, const std::vector<std::string>& more) {
        const Ended ended = run(std::vector<std::string>{"bake", "--material", wave, "--map", "cone", "--json", "--out", folder / name} + more);
        EXPECT_EQ(ended.code, 0) << ended.err;
        return std::pair{read_text(folder / name), Json::parse(ended.out, nullptr, false).value("from_cache", false)};
    };
    const auto first = cone("1.exr", {});
    const auto second = cone("2.exr", {});
    const auto anew = cone("3.exr", {"--no-cache"});
    EXPECT_FALSE(first.second);
    EXPECT_FALSE(anew.second);
    EXPECT_TRUE(first.first == second.first) << "the cached map differs from the baked one";
    EXPECT_TRUE(first.first == anew.first) << "two bakings of one map differ";
    if (!has_device()) return;
    const auto for_device = cone("4.exr", {"--device", "gpu"});
    EXPECT_TRUE(for_device.second) << "what the CPU baked is not taken where a device was to bake";
    EXPECT_TRUE(first.first == for_device.first);
}

}  // namespace relievo::test
