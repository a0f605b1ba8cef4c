#include "render/cone_bake.h"

#include "core/parallel_for.h"
#include "core/vec.h"
#include "maps/cone_map.h"
#include "maps/texel_maxima.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <vector>

namespace relievo {

namespace {

#include "shared/cone_bake.h"

constexpr int group_side = 8;  // of the program
// How long a walk is depends on the heights and the device, so dispatches begin small and grow or shrink toward a tenth of a second.
constexpr int first_texels = 1 << 13;
constexpr int most_texels = 1 << 20;

std::uint32_t groups(int texels) { return static_cast<std::uint32_t>((texels + group_side - 1) / group_side); }

}  // namespace

ConeBake::ConeBake(const gpu::Device& device) : device_(device), program_(device, "maps/cone.comp", 4, sizeof(ConeStep)) {}

ImageF ConeBake::bake(const HeightField& field, const MapBake& bake) {
    const int width = field.width();
    const int height = field.height();
    std::vector<float> maxima;
    std::vector<std::int32_t> level_begin;
    for (const ImageF& level : texel_maxima(field.texels, 1, bake.threads)) {
        level_begin.push_back(static_cast<std::int32_t>(maxima.size()));
        maxima.insert(maxima.end(), level.texels.begin(), level.texels.end());
    }
    std::vector<float> squares;
    for (const int size : {width, height})
        for (int d = 0; d <= size / 2; ++d) squares.push_back(squared_distance(d, size));

    const auto filled = [&](const auto& data) {
        const std::size_t bytes = data.size() * sizeof data[0];
        gpu::Buffer buffer = make_storage(device_, bytes, "cone");
        upload(device_, data.data(), bytes, buffer);
        return buffer;
    };
    const gpu::Buffer maxima_buffer = filled(maxima), levels = filled(level_begin), squares_buffer = filled(squares);
    const auto rows_of = [&](int texels) { return std::max(texels / width / group_side, 1) * group_side; };
    const int most_rows = rows_of(most_texels);
    const gpu::Buffer limits = gpu::make_buffer(
        device_, static_cast<std::size_t>(width) * static_cast<std::size_t>(std::min(most_rows, height)) * sizeof(Vec2f),
        vk::BufferUsageFlagBits::eStorageBuffer);
    const DescriptorSet set = program_.bound({&maxima_buffer, &levels, &squares_buffer, &limits});

    ConeStep step{.width = width, .height = height, .first_row = 0, .levels = static_cast<int>(level_begin.size())};
    ImageF cones(width, height, 2);
    for (int band = rows_of(first_texels), rows = 0; step.first_row < height; step.first_row += rows) {
        rows = std::min(band, height - step.first_row);
        const auto began = std::chrono::steady_clock::now();
        device_.run([&](const vk::raii::CommandBuffer& commands) { program_.dispatch(commands, set, step, groups(width), groups(rows)); });
        const std::chrono::duration<double> took = std::chrono::steady_clock::now() - began;
        if (took.count() < 0.05) band = std::min(2 * band, most_rows);
        if (took.count() > 0.2) band = std::max(band / 2 / group_side, 1) * group_side;
        parallel_for(rows, 16, bake.threads, [&](int begin, int end) {
            for (int j = begin; j < end; ++j) {
                const Vec2f* limit = limits.as<Vec2f>() + static_cast<std::size_t>(j) * static_cast<std::size_t>(width);
                const float* heights = field.texels.at(0, step.first_row + j);
                float* to = cones.at(0, step.first_row + j);
                for (int i = 0; i < width; ++i, to += 2) {
                    to[0] = heights[i];
                    to[1] = std::sqrt(limit[i].x / limit[i].y);
                }
            }
        });
        report(bake.progress, "cone map", static_cast<double>(step.first_row + rows) / height);
    }
    return cones;
}

}  // namespace relievo
