#include "render/distance_bake.h"

#include "core/error.h"
#include "core/map_set.h"
#include "core/parallel_for.h"
#include "maps/distance_sites.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace relievo {

namespace {

#include "shared/distance_bake.h"

constexpr int group_size = 64;  // of the programs
constexpr std::uint32_t groups_abreast = 1 << 10;

std::uint32_t groups(std::size_t invocations) { return static_cast<std::uint32_t>((invocations + group_size - 1) / group_size); }

// (k side)^2 for every k of a window, as the CPU rounds it.
void add_away(std::vector<float>& away, int size, float side) {
    for (int k = 0; k <= size / 2; ++k) away.push_back((static_cast<float>(k) * side) * (static_cast<float>(k) * side));
}

// For every slice: what no site of each row is less than, then none of all. Rounding keeps order, so the highest site and the
// largest correction of a row say it.
std::vector<float> least_of(const DistanceSites& sites) {
    const int width = sites.heights.width;
    const int height = sites.heights.height;
    std::vector<float> highest, correction;
    for (int j = 0; j < height; ++j) {
        highest.push_back(*std::max_element(sites.heights.at(0, j), sites.heights.at(0, j) + width));
        correction.push_back(*std::max_element(sites.correction.at(0, j), sites.correction.at(0, j) + width));
    }
    std::vector<float> least;
    for (int k = 0; k < distance_slices; ++k) {
        const float z = static_cast<float>(k) * sites.side_z;
        float of_all = std::numeric_limits<float>::max();
        for (std::size_t j = 0; j < highest.size(); ++j) {
            const float down = std::max(0.0f, z - highest[j]);
            least.push_back(down * down - correction[j]);
            of_all = std::min(of_all, least.back());
        }
        least.push_back(of_all);
    }
    return least;
}

// Half floats without subnormals, numbered upward: 0 is 0, 1 and -1 are 2^-14 and -2^-14.
constexpr std::int32_t least_normal = 0x38800000 >> 13;
float value_of(int number) {
    if (number == 0) return 0.0f;
    const auto bits = static_cast<std::uint32_t>(std::abs(number) - 1 + least_normal) << 13;
    return std::bit_cast<float>(number < 0 ? bits | 0x80000000u : bits);
}
int number_of(float value) {
    const auto steps = static_cast<int>((std::bit_cast<std::uint32_t>(value) & 0x7fffffffu) >> 13) - least_normal + 1;
    return value == 0 ? 0 : value < 0 ? -steps : steps;
}

// Floats as whole numbers in the same order.
std::int32_t order_of(float x) {
    const auto bits = std::bit_cast<std::int32_t>(x);
    return bits >= 0 ? bits : std::numeric_limits<std::int32_t>::min() - bits;
}
float at_order(std::int32_t order) {
    return std::bit_cast<float>(order >= 0 ? order : std::numeric_limits<std::int32_t>::min() - order);
}

// The least squared distance of which `value` or more is stored; it lies above `low`, and not above `high`.
float least_squared(float value, float diagonal2, float low, float high) {
    // About there; the bracket is far wider than what rounding can do.
    const double quarter = diagonal2 / 4.0;
    const double raised = static_cast<double>(value) + std::sqrt(diagonal2) * static_cast<double>(distance_filter_slack) + 1e-6;
    const double guess = raised >= std::sqrt(quarter) ? raised * raised + quarter : raised * 2 * std::sqrt(quarter) + quarter;
    const double around = 1e-5 * (std::abs(guess) + quarter);
    const auto below = std::max(low, static_cast<float>(guess - around));
    const auto above = std::min(high, static_cast<float>(guess + around));
    if (below < above && stored_distance(below, diagonal2) < value && stored_distance(above, diagonal2) >= value)
        low = below, high = above;
    std::int32_t from = order_of(low), until = order_of(high);
    while (std::int64_t{until} - from > 1) {
        const auto middle = static_cast<std::int32_t>((std::int64_t{from} + until) / 2);
        (stored_distance(at_order(middle), diagonal2) >= value ? until : from) = middle;
    }
    return at_order(until);
}

// From which squared distance on each value is stored, for all values of squared distances in [low, high]; an end beyond
// everything.
struct StoredValues {
    int lowest;
    std::vector<float> from;
};
StoredValues stored_values(float low, float high, float diagonal2, int threads) {
    StoredValues values{.lowest = number_of(stored_distance(low, diagonal2)), .from = {}};
    const int count = number_of(stored_distance(high, diagonal2)) - values.lowest + 1;
    values.from.resize(static_cast<std::size_t>(count) + 1, std::numeric_limits<float>::max());
    values.from[0] = low;
    parallel_for(count - 1, 256, threads, [&](int begin, int end) {
        for (int n = begin + 1; n <= end; ++n)
            values.from[static_cast<std::size_t>(n)] = least_squared(value_of(values.lowest + n), diagonal2, low, high);
    });
    return values;
}

}  // namespace

DistanceBake::DistanceBake(const gpu::Device& device)
    : device_(device),
      down_(device, "maps/distance_down.comp", 3, sizeof(DistanceStep)),
      along_(device, "maps/distance_along.comp", 4, sizeof(DistanceStep)),
      stored_(device, "maps/distance_stored.comp", 3, sizeof(DistanceStep)) {}

ImageF DistanceBake::bake(const HeightField& field, const MapBake& bake) {
    const DistanceSites sites = distance_sites(field, bake.height_scale);
    // Far below any relief; from there on squares come near the least normal floats, which devices may flush to 0.
    if (std::min(sites.side_u, sites.side_v) < 0x1p-40f)
        throw Error("bake", "the distance map on " + device_.info().name,
                    "its height_scale is " + std::to_string(bake.height_scale) + ", beyond what devices round alike",
                    "bake it on the CPU (--device cpu)");
    const int width = sites.heights.width;
    const int height = sites.heights.height;
    const std::size_t slice = sites.heights.texels.size();
    const int slices = std::clamp(most_invocations / static_cast<int>(slice), 1, distance_slices);
    const std::size_t batch = slice * static_cast<std::size_t>(slices);

    const std::vector<float> least = least_of(sites);
    std::vector<float> away;
    add_away(away, width, sites.side_u);
    add_away(away, height, sites.side_v);
    // No voxel is nearer than the least says, and none farther than straight down to the lowest site.
    const float deepest =
        std::max(0.0f, static_cast<float>(distance_slices - 1) * sites.side_z - *std::ranges::min_element(sites.heights.texels));
    const StoredValues values = stored_values(*std::ranges::min_element(least), deepest * deepest, sites.diagonal2, bake.threads);

    const auto filled = [&](const std::vector<float>& data) {
        gpu::Buffer buffer = make_storage(device_, data.size() * sizeof(float), "distance");
        upload(device_, data.data(), data.size() * sizeof(float), buffer);
        return buffer;
    };
    const gpu::Buffer heights = filled(sites.heights.texels), corrections = filled(sites.correction.texels),
                      away_buffer = filled(away), least_buffer = filled(least), from = filled(values.from);
    const std::array squared = {make_storage(device_, batch * sizeof(float), "distance"),
                                make_storage(device_, batch * sizeof(float), "distance")};
    const gpu::Buffer halves =
        gpu::make_buffer(device_, (batch + 1) / 2 * sizeof(std::uint32_t), vk::BufferUsageFlagBits::eStorageBuffer);
    const DescriptorSet down = down_.bound({&heights, &corrections, &squared[0]});
    const DescriptorSet along_u = along_.bound({&squared[0], &squared[1], &away_buffer, &least_buffer});
    const DescriptorSet along_v = along_.bound({&squared[1], &squared[0], &away_buffer, &least_buffer});
    const DescriptorSet stored = stored_.bound({&squared[0], &from, &halves});

    DistanceStep step{.width = width,
                      .height = height,
                      .lowest_value = values.lowest,
                      .values = static_cast<int>(values.from.size()) - 1,
                      .side_z = sites.side_z,
                      .quarter = sites.diagonal2 / 4,
                      .half_diagonal = 0.5f * std::sqrt(sites.diagonal2),
                      .slack = std::sqrt(sites.diagonal2) * distance_filter_slack + 1e-6f};
    ImageF map(width, height * distance_slices, 1);
    for (int first = 0; first < distance_slices; first += slices) {
        step.first_slice = first;
        step.slices = std::min(slices, distance_slices - first);
        const auto depth = static_cast<std::uint32_t>(step.slices);
        const std::size_t count = slice * depth;
        device_.run([&](const vk::raii::CommandBuffer& commands) {
            const std::uint32_t across = groups(static_cast<std::size_t>(width));
            const auto rows = static_cast<std::uint32_t>(height);
            down_.dispatch(commands, down, step, across, rows, depth);
            step.axis = 0;
            along_.dispatch(commands, along_u, step, across, rows, depth);
            step.axis = 1;
            along_.dispatch(commands, along_v, step, across, rows, depth);
            const std::uint32_t words = groups((count + 1) / 2);
            stored_.dispatch(commands, stored, step, std::min(words, groups_abreast), (words + groups_abreast - 1) / groups_abreast,
                             1);
        });
        const auto* from_device = halves.as<std::uint16_t>();
        float* to = map.at(0, first * height);
        parallel_for(static_cast<int>(count), 1 << 16, bake.threads, [&](int begin, int end) {
            for (int n = begin; n < end; ++n) {
                const std::uint32_t half = from_device[n];
                const std::uint32_t magnitude = half & 0x7fffu;
                to[n] = std::bit_cast<float>((half & 0x8000u) << 16 | (magnitude != 0 ? (magnitude << 13) + 0x38000000u : 0u));
            }
        });
        report(bake.progress, "distance map", static_cast<double>(first + step.slices) / distance_slices);
    }
    return map;
}

}  // namespace relievo
