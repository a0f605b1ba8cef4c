// Maps baked by a device are those of the CPU, to the bit, whatever the heights and the size.
#include "render/device_bake.h"

#include "core/error.h"
#include "maps/fields.h"
#include "render/gpu_renderer.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <string>

namespace relievo {
namespace {

struct Case {
    std::string name;
    HeightField field;
};

// Spikes on the seams: a window that forgets to wrap misses them.
HeightField seam_field(int width, int height) {
    HeightField field(width, height, 0.25f);
    field.texels(0, 0) = 1.0f;
    field.texels(width - 1, height / 2) = 0.75f;
    field.texels(width / 2, height - 1) = 0.5f;
    return field;
}

// The 256 levels and the floats beside them, zeros of both signs, and the least floats there are.
HeightField level_field(int width, int height) {
    HeightField field(width, height);
    for (std::size_t n = 0; n < field.texels.texels.size(); ++n) {
        const auto level = static_cast<float>(static_cast<double>(n / 3 % 256) / 255.0);
        const float beside[] = {level, std::nextafter(level, 0.0f), std::nextafter(level, 1.0f)};
        field.texels.texels[n] = std::min(beside[n % 3], 1.0f);
    }
    const float least[] = {-0.0f, std::numeric_limits<float>::denorm_min(), 1e-40f, std::numeric_limits<float>::min()};
    for (int n = 0; n < width && n < 16; ++n) field.texels(n, height / 2) = least[n % 4];
    return field;
}

std::vector<Case> cases() {
    std::vector<Case> all;
    constexpr int sizes[][2] = {{1, 1},  {2, 1},  {1, 3},   {3, 2},   {7, 5},    {16, 16}, {33, 34},
                                {1, 40}, {40, 1}, {65, 31}, {64, 64}, {100, 37}, {37, 130}};
    for (const auto& [w, h] : sizes) {
        const std::string size = std::to_string(w) + "x" + std::to_string(h);
        all.push_back({"random " + size, test::random_field(w, h, 3)});
        all.push_back({"terraced " + size, test::terraced_field(w, h, 4)});
        all.push_back({"smooth " + size, test::smooth_field(w, h, 5)});
        all.push_back({"spike " + size, test::spike_field(w, h, w / 2, h / 3)});
        all.push_back({"seams " + size, seam_field(w, h)});
        all.push_back({"levels " + size, level_field(w, h)});
        all.push_back({"flat " + size, HeightField(w, h, 0.3f)});
        all.push_back({"top " + size, HeightField(w, h, 1.0f)});
    }
    return all;
}

class DeviceBake : public testing::TestWithParam<Map> {
protected:
    static void SetUpTestSuite() {
        for (const GpuDevice& d : gpu_devices())
            if (d.lacks.empty() && !baker) baker = std::make_unique<DeviceBaker>("", true);
    }
    static void TearDownTestSuite() { baker.reset(); }
    void SetUp() override {
        if (!baker) GTEST_SKIP() << "no Vulkan device: install a driver (mesa-vulkan-drivers is a software one)";
    }
    void TearDown() override {
        if (!baker) return;
        const auto messages = baker->validation_messages();
        for (; messages_seen < messages.size(); ++messages_seen) ADD_FAILURE() << messages[messages_seen];
    }

    static ImageF on_cpu(const HeightField& field, float height_scale) {
        MapSet maps;
        maps.height = field;
        map_kind(GetParam()).bake(maps, {.height_scale = height_scale, .threads = 0, .progress = {}});
        return maps.*map_kind(GetParam()).image;
    }
    static ImageF on_device(const HeightField& field, float height_scale, int threads = 0, const Progress& progress = {}) {
        return baker->bake(GetParam(), field, {.height_scale = height_scale, .threads = threads, .progress = progress});
    }

    static void expect_equal(const ImageF& device, const ImageF& cpu, const std::string& name) {
        ASSERT_EQ(device.width, cpu.width) << name;
        ASSERT_EQ(device.height, cpu.height) << name;
        ASSERT_EQ(device.channels, cpu.channels) << name;
        for (std::size_t n = 0; n < cpu.texels.size(); ++n)
            ASSERT_EQ(std::bit_cast<std::uint32_t>(device.texels[n]), std::bit_cast<std::uint32_t>(cpu.texels[n]))
                << name << ": value " << n << " is " << device.texels[n] << " on the device and " << cpu.texels[n] << " on the CPU";
    }

    static inline std::size_t messages_seen = 0;
    static inline std::unique_ptr<DeviceBaker> baker;
};

TEST_P(DeviceBake, IsTheCpusToTheBit) {
    for (const Case& c : cases())
        for (const float height_scale : {0.1f, 0.013f, 1.7f})
            expect_equal(on_device(c.field, height_scale), on_cpu(c.field, height_scale), c.name);
}

// More than one dispatch of every step, and no power of two. A software device takes a minute for cones of that size, which come in more
// dispatches sooner.
TEST_P(DeviceBake, IsTheCpusInBandsToo) {
    const int width = GetParam() == Map::cone ? 301 : 1999;
    const int height = GetParam() == Map::cone ? 203 : 1201;
    for (const HeightField& field : {test::smooth_field(width, height, 6), test::terraced_field(width, height, 7)})
        expect_equal(on_device(field, 0.1f), on_cpu(field, 0.1f), "in bands");
}

TEST_P(DeviceBake, DoesNotDependOnThreads) {
    const HeightField field = test::smooth_field(150, 90, 8);
    const ImageF one = on_device(field, 0.1f, 1);
    expect_equal(on_device(field, 0.1f, 2), one, "two threads");
    expect_equal(on_device(field, 0.1f, 7), one, "seven threads");
}

TEST_P(DeviceBake, ReportsProgressAndStopsWhenCancelled) {
    const HeightField field = test::random_field(200, 150, 1);
    double last = 0;
    on_device(field, 0.1f, 2, [&](std::string_view stage, double share) {
        EXPECT_FALSE(stage.empty());
        EXPECT_GE(share, last);
        EXPECT_LE(share, 1.0);
        last = share;
    });
    EXPECT_EQ(last, 1.0);
    // Early, late and at the end, and the device goes on baking afterwards.
    for (const double at : {0.0, 0.3, 0.6, 1.0})
        EXPECT_THROW(on_device(field, 0.1f, 2,
                               [&](std::string_view, double share) {
                                   if (share >= at) throw Cancelled();
                               }),
                     Cancelled);
    expect_equal(on_device(field, 0.1f), on_cpu(field, 0.1f), "after stopping");
}

// Of a scale at which squares would be smaller than what devices keep apart from 0, a device says so instead of being nearly right.
TEST_P(DeviceBake, IsExactOrRefusedAtAbsurdScales) {
    const HeightField field = test::smooth_field(20, 12, 2);
    for (const float height_scale : {1e-30f, 1e4f, 1e8f, 1e12f, 1e20f, 1e38f}) {
        ImageF device;
        try {
            device = on_device(field, height_scale);
        } catch (const Error& e) {
            EXPECT_NE(std::string(e.what()).find("--device cpu"), std::string::npos) << e.what();
            EXPECT_GT(height_scale, 1e8f);
            continue;
        }
        expect_equal(device, on_cpu(field, height_scale), "height_scale " + std::to_string(height_scale));
    }
}

INSTANTIATE_TEST_SUITE_P(Maps, DeviceBake, testing::ValuesIn(device_baked_maps()),
                         [](const auto& map) { return std::string(map_kind(map.param).id); });

TEST(DeviceBakes, AreOfMapsThatAreOneImage) {
    for (const Map map : device_baked_maps()) {
        EXPECT_TRUE(bakes_on_device(map));
        EXPECT_NE(map_kind(map).image, nullptr);
        EXPECT_NE(map_kind(map).bake, nullptr);
    }
    EXPECT_FALSE(bakes_on_device(Map::height));
}

TEST(DeviceBakes, NeedADeviceThatIsThere) {
    EXPECT_THROW(DeviceBaker("voodoo2", false), Error);
    EXPECT_FALSE(is_real_gpu("voodoo2"));
    EXPECT_FALSE(is_real_gpu("software"));
}

}  // namespace
}  // namespace relievo
