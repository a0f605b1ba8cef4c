// The device itself: found, chosen, refused; memory, textures and validation.
#include "core/error.h"
#include "gpu/half.h"
#include "gpu/image.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstring>

namespace relievo::gpu {
namespace {

#define NEEDS_A_DEVICE() \
    if (list_devices().empty()) GTEST_SKIP() << "no Vulkan device: install a driver (mesa-vulkan-drivers is a software one)"

TEST(Half, roundsToNearestEven) {
    EXPECT_EQ(to_half(0.333251953125f), 0x3555);
    EXPECT_EQ(to_half(1.0f / 3.0f), 0x3555);
    EXPECT_EQ(to_half(-0.0f), 0x8000);
    EXPECT_EQ(to_half(6.103515625e-5f), 0x0400);     // smallest normal
    EXPECT_EQ(to_half(6.097555160522e-5f), 0x03ff);  // largest subnormal
    EXPECT_EQ(to_half(2.9802322e-8f), 0);            // half the smallest subnormal: to even
    EXPECT_EQ(to_half(65519.0f), 0x7bff);
    EXPECT_EQ(to_half(65520.0f), 0x7c00);
}

TEST(Device, isChosenByPartOfItsNameInAnyCase) {
    NEEDS_A_DEVICE();
    for (const DeviceInfo& d : list_devices()) {
        if (!d.usable) continue;
        std::string shouted = d.name.substr(0, 5);
        for (char& c : shouted) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        EXPECT_EQ(Device({.choice = shouted}).info().name, d.name);
        break;
    }
}

TEST(Device, softwareMeansOneThatRunsOnTheCpu) {
    NEEDS_A_DEVICE();
    if (std::ranges::none_of(list_devices(), [](const auto& d) { return d.software && d.usable; }))
        GTEST_SKIP() << "no software device here";
    EXPECT_TRUE(Device({.choice = "software"}).info().software);
}

TEST(Device, unknownNameIsRefusedWithTheListOfDevices) {
    NEEDS_A_DEVICE();
    try {
        Device({.choice = "voodoo2"});
        FAIL() << "accepted";
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("voodoo2"), std::string::npos);
        EXPECT_NE(std::string(e.what()).find(list_devices().front().name), std::string::npos);
    }
}

// Every byte of every level, through more than one staging band: 2048^2 floats are 16 MB, a band is 8.
TEST(Image, textureComesBackAsWritten) {
    NEEDS_A_DEVICE();
    const Device device({.choice = "", .validation = true});
    const auto value = [](int level, int x, int y) {
        return static_cast<float>(level * 5000 + y) + static_cast<float>(x) / 4096.0f;
    };
    const auto texture = make_texture(device, vk::Format::eR32Sfloat, {2048, 2048}, 2, 4, [&](int level, int y, std::byte* out) {
        for (int x = 0; x < 2048 >> level; ++x) {
            const float v = value(level, x, y);
            std::memcpy(out + 4 * x, &v, 4);
        }
    });
    for (std::uint32_t level = 0; level < 2; ++level) {
        const int size = 2048 >> level;
        const Buffer read = make_buffer(device, vk::DeviceSize{4} * 2048 * 2048, vk::BufferUsageFlagBits::eTransferDst);
        device.run([&](const vk::raii::CommandBuffer& commands) {
            transition(commands, texture, vk::ImageLayout::eShaderReadOnlyOptimal, vk::ImageLayout::eTransferSrcOptimal);
            read_back(commands, texture, read, level);
            transition(commands, texture, vk::ImageLayout::eTransferSrcOptimal, vk::ImageLayout::eShaderReadOnlyOptimal);
        });
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) ASSERT_EQ(read.as<float>()[y * size + x], value(static_cast<int>(level), x, y));
    }
    EXPECT_TRUE(device.validation_messages().empty());
}

TEST(Validation, reportsAMistake) {
    NEEDS_A_DEVICE();
    const Device device({.choice = "", .validation = true});
    // A buffer of no bytes is against the rules, and only the layers say so.
    try {
        const vk::raii::Buffer wrong(device.handle(),
                                     vk::BufferCreateInfo{.size = 0, .usage = vk::BufferUsageFlagBits::eUniformBuffer});
    } catch (const vk::SystemError&) {
    }
    EXPECT_FALSE(device.validation_messages().empty());
}

TEST(Device, worksAndStaysSilentUnderValidation) {
    NEEDS_A_DEVICE();
    const Device device({.choice = "", .validation = true});
    const Image target =
        make_image(device, vk::Format::eR32Sfloat, {5, 3}, 1,
                   vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst | vk::ImageUsageFlagBits::eTransferSrc);
    const Buffer read = make_buffer(device, 5 * 3 * 4, vk::BufferUsageFlagBits::eTransferDst);
    device.run([&](const vk::raii::CommandBuffer& commands) {
        transition(commands, target, vk::ImageLayout::eUndefined, vk::ImageLayout::eTransferDstOptimal);
        commands.clearColorImage(*target.handle, vk::ImageLayout::eTransferDstOptimal,
                                 vk::ClearColorValue(std::array{0.25f, 0.0f, 0.0f, 0.0f}),
                                 vk::ImageSubresourceRange{vk::ImageAspectFlagBits::eColor, 0, 1, 0, 1});
        transition(commands, target, vk::ImageLayout::eTransferDstOptimal, vk::ImageLayout::eTransferSrcOptimal);
        read_back(commands, target, read);
    });
    for (int i = 0; i < 15; ++i) EXPECT_EQ(read.as<float>()[i], 0.25f);
    for (const std::string& m : device.validation_messages()) ADD_FAILURE() << m;
}

}  // namespace
}  // namespace relievo::gpu
