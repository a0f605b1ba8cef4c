#include "pipeline/map_cache.h"

#include "assets/temporary_folder.h"
#include "core/error.h"
#include "maps/cone_map.h"
#include "maps/fields.h"
#include "maps/normal_map.h"
#include "pipeline/map_set_bake.h"

#include <gtest/gtest.h>

#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>

namespace relievo {
namespace {

namespace fs = std::filesystem;

std::string sha256_hex(const std::string& text) {
    const Digest digest = sha256(std::as_bytes(std::span(text)));
    return hex(digest);
}

// The examples of FIPS 180-4 and its companion, and the lengths around which the padding grows by a block.
TEST(ContentHash, IsSha256) {
    EXPECT_EQ(sha256_hex(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    EXPECT_EQ(sha256_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
              "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
    EXPECT_EQ(sha256_hex(std::string(1000000, 'a')), "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST(ContentHash, PiecesDoNotDependOnThreadsAndEveryByteCounts) {
    std::vector<std::byte> bytes(3'000'000, std::byte{7});
    const Digest one = content_digest(bytes, 1);
    EXPECT_EQ(one, content_digest(bytes, 4));
    bytes[2'999'999] = std::byte{8};
    EXPECT_NE(one, content_digest(bytes, 2));
}

class MapCacheFiles : public test::InTemporaryFolder {
protected:
    static MapKey key_of(std::uint8_t content) {
        MapKey key{.map_id = "cone", .baker_version = 1, .width = 5, .height = 4};
        key.content[0] = content;
        return key;
    }
    static ImageF some_map() { return cone_map(test::random_field(5, 4, 1)); }
    void age(const MapCache& cache, std::uint8_t content, int hours) const {
        fs::last_write_time(cache.file_of(key_of(content)), fs::file_time_type::clock::now() - std::chrono::hours(hours));
    }
};

TEST_F(MapCacheFiles, GivesBackWhatWasStoredAndNothingElse) {
    const MapCache cache(folder / "new" / "deep");
    EXPECT_FALSE(cache.find(key_of(1)));
    ASSERT_TRUE(cache.store(key_of(1), some_map()));
    const auto found = cache.find(key_of(1));
    ASSERT_TRUE(found);
    EXPECT_EQ(found->texels, some_map().texels);
    EXPECT_EQ(found->width, 5);
    EXPECT_EQ(found->channels, 2);
    EXPECT_FALSE(cache.find(key_of(2)));
    MapKey other = key_of(1);
    other.baker_version = 2;
    EXPECT_FALSE(cache.find(other));
    other = key_of(1);
    std::swap(other.width, other.height);
    EXPECT_FALSE(cache.find(other));
    other = key_of(1);
    other.map_id = "relaxed_cone";
    EXPECT_FALSE(cache.find(other));
}

TEST_F(MapCacheFiles, EveryDamagedByteAndEveryLengthIsNoticed) {
    const MapCache cache(folder);
    ASSERT_TRUE(cache.store(key_of(1), some_map()));
    const fs::path file = cache.file_of(key_of(1));
    const std::string good = bytes_of(file);
    for (std::size_t at = 0; at < good.size(); ++at) {
        std::string bad = good;
        bad[at] = static_cast<char>(bad[at] ^ 0x40);
        put(file.filename().string(), bad);
        ASSERT_FALSE(cache.find(key_of(1))) << "byte " << at;
        put(file.filename().string(), good.substr(0, at));
        ASSERT_FALSE(cache.find(key_of(1))) << "length " << at;
    }
    put(file.filename().string(), good + "x");
    EXPECT_FALSE(cache.find(key_of(1)));
    put(file.filename().string(), good);
    EXPECT_TRUE(cache.find(key_of(1)));
}

TEST_F(MapCacheFiles, AnotherEntrysFileUnderThisNameIsNotBelieved) {
    const MapCache cache(folder);
    ASSERT_TRUE(cache.store(key_of(1), some_map()));
    fs::copy_file(cache.file_of(key_of(1)), cache.file_of(key_of(2)));
    EXPECT_FALSE(cache.find(key_of(2)));
}

TEST_F(MapCacheFiles, EntriesUnusedForLongestGoFirst) {
    const std::uintmax_t one = 80 + 5 * 4 * 2 * sizeof(float);
    const MapCache cache(folder, 3 * one);
    for (const std::uint8_t k : {1, 2, 3}) ASSERT_TRUE(cache.store(key_of(k), some_map()));
    age(cache, 1, 5);
    age(cache, 2, 9);
    age(cache, 3, 7);
    ASSERT_TRUE(cache.find(key_of(2)));  // used again: now the youngest
    ASSERT_TRUE(cache.store(key_of(4), some_map()));
    EXPECT_FALSE(cache.find(key_of(3)));
    for (const std::uint8_t k : {1, 2, 4}) EXPECT_TRUE(cache.find(key_of(k))) << int(k);
    EXPECT_FALSE(MapCache(folder, one - 1).store(key_of(5), some_map()));
}

TEST_F(MapCacheFiles, LeftoversOfKilledProcessesGoAndForeignFilesStay) {
    const MapCache cache(folder, 1000);
    fs::last_write_time(put(".relievo-1-1.tmp", "half"), fs::file_time_type::clock::now() - std::chrono::hours(2));
    put(".relievo-2-1.tmp", "being written");
    put("notes.txt", std::string(5000, 'x'));
    ASSERT_TRUE(cache.store(key_of(1), some_map()));
    EXPECT_EQ(names(), (std::vector<std::string>{".relievo-2-1.tmp", cache.file_of(key_of(1)).filename().string(), "notes.txt"}));
}

TEST_F(MapCacheFiles, AFolderThatCannotBeMadeIsNoError) {
    put("file", "in the way");
    const MapCache cache(folder / "file" / "sub");
    EXPECT_FALSE(cache.store(key_of(1), some_map()));
    EXPECT_FALSE(cache.find(key_of(1)));
    EXPECT_FALSE(MapCache("/proc/nowhere").store(key_of(1), some_map()));
}

TEST_F(MapCacheFiles, ProcessesMayShareAFolder) {
    const ImageF map = some_map();
    const MapCache cache(folder, 700);  // room for two, so that they also remove under each other's hands
    const auto work = [&] {
        for (int round = 0; round < 60; ++round)
            for (const std::uint8_t k : {1, 2, 3, 4}) {
                cache.store(key_of(k), map);
                if (const auto found = cache.find(key_of(k)); found && found->texels != map.texels) return false;
            }
        return true;
    };
    const pid_t child = ::fork();
    if (child == 0) ::_exit(work() ? 0 : 1);
    EXPECT_TRUE(work());
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    for (const std::string& name : names()) EXPECT_TRUE(name.ends_with(".map")) << name;
}

// Sets environment variables for one test and puts the old values back.
class BakeMaps : public test::InTemporaryFolder {
protected:
    BakeMaps() { set("RELIEVO_CACHE", (folder / "cache").c_str()); }
    ~BakeMaps() override {
        for (const auto& [name, value] : before_) value ? ::setenv(name, value->c_str(), 1) : ::unsetenv(name);
    }
    void set(const char* name, const char* value) {
        const char* old = std::getenv(name);
        before_.insert(before_.begin(), {name, old ? std::optional<std::string>(old) : std::nullopt});
        value ? ::setenv(name, value, 1) : ::unsetenv(name);
    }
    static Material material() {
        Material m;
        m.name = "test";
        m.height = test::smooth_field(40, 24, 3);
        return m;
    }
    static constexpr auto all = every_map;

private:
    std::vector<std::pair<const char*, std::optional<std::string>>> before_;
};

TEST_F(BakeMaps, FolderFollowsTheEnvironment) {
    EXPECT_EQ(MapCache::default_folder(), folder / "cache");
    set("RELIEVO_CACHE", nullptr);
    set("XDG_CACHE_HOME", "/x");
    EXPECT_EQ(MapCache::default_folder(), fs::path("/x/relievo"));
    set("XDG_CACHE_HOME", "relative");
    set("HOME", "/h");
    EXPECT_EQ(MapCache::default_folder(), fs::path("/h/.cache/relievo"));
    set("HOME", nullptr);
    EXPECT_FALSE(MapCache::default_folder());
    EXPECT_FALSE(bake_maps(material(), all, {}).maps.cone.empty());
}

TEST_F(BakeMaps, SecondTimeComesFromTheCacheWithTheSameBits) {
    const BakedMaps first = bake_maps(material(), all, {});
    const BakedMaps second = bake_maps(material(), all, {});
    EXPECT_FALSE(first.from_cache);
    EXPECT_TRUE(second.from_cache);
    EXPECT_EQ(first.maps.cone.texels, second.maps.cone.texels);
    EXPECT_EQ(first.maps.cone.texels, cone_map(material().height).texels);
    EXPECT_FALSE(bake_maps(material(), all, {.use_cache = false}).from_cache);
    Material other = material();
    other.height.texels(7, 7) += 0.01f;
    EXPECT_FALSE(bake_maps(other, all, {}).from_cache);
}

TEST_F(BakeMaps, WithoutTheCacheNothingIsWritten) {
    bake_maps(material(), all, {.use_cache = false});
    EXPECT_TRUE(names().empty());
}

TEST_F(BakeMaps, BakesOnlyWhatIsWanted) {
    const BakedMaps heights = bake_maps(material(), {}, {});
    EXPECT_EQ(heights.maps.height.texels.texels, material().height.texels.texels);
    EXPECT_TRUE(heights.maps.normal.empty() && heights.maps.colour.empty() && heights.maps.max_pyramid.levels.empty() && heights.maps.cone.empty());
    EXPECT_FALSE(heights.from_cache);
}

TEST_F(BakeMaps, WhatIsMissingIsComputedAndWhatIsGivenIsKept) {
    const BakedMaps bare = bake_maps(material(), all, {});
    EXPECT_EQ(bare.maps.normal[0].texels, normal_map(material().height, material().height_scale).texels);
    EXPECT_EQ(bare.maps.colour.size(), 1u);
    EXPECT_EQ(bare.maps.colour[0](0, 0, 0), 188);
    EXPECT_EQ(bare.maps.colour[0](0, 0, 3), 255);

    Material rich = material();
    rich.normal = normal_map(test::random_field(8, 8, 1), 0.3f);
    rich.colour = Image8(6, 2, 4, std::uint8_t{77});
    const BakedMaps kept = bake_maps(rich, all, {});
    EXPECT_EQ(kept.maps.normal[0].texels, rich.normal->texels);
    EXPECT_EQ(kept.maps.normal.size(), 4u);
    EXPECT_EQ(kept.maps.colour[0].texels, rich.colour->texels);
    EXPECT_NE(kept.input_hash, bare.input_hash);
    EXPECT_EQ(kept.input_hash, bake_maps(rich, {}, {}).input_hash);
}

TEST_F(BakeMaps, NormalsAloneBecomeHeightsWithTheirScaleAndANote) {
    Material m;
    m.name = "normals only";
    m.height_scale = 0.5f;
    m.normal = normal_map(test::smooth_field(64, 64, 2), 0.1f);
    const HeightField field = test::smooth_field(64, 64, 2);
    const float range = *std::ranges::max_element(field.texels.texels) - *std::ranges::min_element(field.texels.texels);
    const BakedMaps baked = bake_maps(m, all, {});
    EXPECT_NEAR(baked.height_scale, 0.1f * range, 0.003f);
    EXPECT_EQ(baked.maps.height.width(), 64);
    ASSERT_EQ(baked.notes.size(), 1u);
    EXPECT_TRUE(test::has(baked.notes[0], "integrated from the normals")) << baked.notes[0];
    EXPECT_FALSE(baked.maps.cone.empty());
}

TEST_F(BakeMaps, BadMaterialsAreRefusedWithAReason) {
    Material nothing;
    nothing.name = "void";
    EXPECT_TRUE(test::has(test::message_of<Error>([&] { bake_maps(nothing, all, {}); }), "neither heights nor normals"));
    for (const float bad : {std::nanf(""), INFINITY, -0.1f, 1.1f}) {
        Material m = material();
        m.height.texels(3, 3) = bad;
        EXPECT_TRUE(test::has(test::message_of<Error>([&] { bake_maps(m, all, {}); }), "not a number in [0,1]"));
    }
    for (const float bad : {0.0f, -1.0f, std::nanf("")}) {
        Material m = material();
        m.height_scale = bad;
        EXPECT_TRUE(test::has(test::message_of<Error>([&] { bake_maps(m, all, {}); }), "height_scale"));
    }
}

TEST_F(BakeMaps, CancellingLeavesNothingBehind) {
    EXPECT_THROW(bake_maps(material(), all, {.progress = [](std::string_view, double) { throw Cancelled(); }}), Cancelled);
    EXPECT_TRUE(names().empty());
}

}  // namespace
}  // namespace relievo
