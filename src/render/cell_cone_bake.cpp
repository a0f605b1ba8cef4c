#include "render/cell_cone_bake.h"

#include "core/map_set.h"
#include "core/parallel_for.h"
#include "core/wrap.h"
#include "maps/cell_cone.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

namespace relievo {

namespace {

#include "shared/cell_cone_bake.h"

constexpr int group_size = 64;      // of the programs
constexpr int most_rows = 1 << 15;  // groups of a dispatch along y: 65535 everywhere
constexpr std::array roof_lengths = {near_roof_reach + 1, middle_roof_reach + 1, far_roof_reach + 1};

}  // namespace

CellConeBake::CellConeBake(const gpu::Device& device)
    : device_(device),
      largest_(device, "maps/cell_cone_largest.comp", 3, sizeof(CellConeStep)),
      roof_(device, "maps/cell_cone_roof.comp", 2, sizeof(CellConeStep)),
      quadrants_(device, "maps/cell_cone_quadrants.comp", 2, sizeof(CellConeStep)),
      levels_(gpu::make_buffer(device, 256 * sizeof(float), vk::BufferUsageFlagBits::eStorageBuffer)) {
    for (int k = 0; k < 256; ++k) levels_.as<float>()[k] = cell_cone_level(k);
}

ImageF CellConeBake::bake(const HeightField& field, const MapBake& bake) {
    const int width = field.width();
    const int height = field.height();
    const std::size_t bytes = field.texels.texels.size() * sizeof(float);
    const gpu::Buffer heights = make_storage(device_, bytes, "cell_cone");
    const std::array cells = {make_storage(device_, bytes, "cell_cone"), make_storage(device_, bytes, "cell_cone")};
    upload(device_, field.texels.texels.data(), bytes, heights);

    CellConeStep step{.width = width, .height = height};
    const auto back_x = [&](int length) { return wrap_index(1 - length, width); };
    const auto back_y = [&](int length) { return wrap_index(1 - length, height); };
    step.back_near_x = back_x(roof_lengths[0]), step.back_near_y = back_y(roof_lengths[0]);
    step.back_middle_x = back_x(roof_lengths[1]), step.back_middle_y = back_y(roof_lengths[1]);
    step.back_far_x = back_x(roof_lengths[2]), step.back_far_y = back_y(roof_lengths[2]);

    // Of the whole: four steps over the cells, then four quadrants.
    const double all = 8.0 * height;
    double done = 0;
    const int band = std::clamp(most_invocations / width, 1, most_rows);
    const auto run = [&](const BakeProgram& program, const DescriptorSet& set, int first, int end) {
        step.first_row = first;
        device_.run([&](const vk::raii::CommandBuffer& commands) {
            program.dispatch(commands, set, step, static_cast<std::uint32_t>((width + group_size - 1) / group_size),
                             static_cast<std::uint32_t>(end - first));
        });
        done += end - first;
    };
    const auto over_cells = [&](const BakeProgram& program, const DescriptorSet& set) {
        for (int first = 0; first < height; first += band) {
            run(program, set, first, std::min(first + band, height));
            report(bake.progress, "cell cone map", done / all);
        }
    };
    over_cells(largest_, largest_.bound({&heights, &levels_, &cells[0]}));
    std::size_t from = 0;
    step.have = 1;
    for (const int length : roof_lengths) {
        step.covered = length;
        step.bits += 8;
        over_cells(roof_, roof_.bound({&cells[from], &cells[1 - from]}));
        from = 1 - from;
        step.have = length;
    }

    std::array<float, 256> levels;
    for (int k = 0; k < 256; ++k) levels[static_cast<std::size_t>(k)] = cell_cone_level(k);
    ImageF cones(width, cell_cone_quadrants * height, 1 + static_cast<int>(roof_lengths.size()));
    const gpu::Buffer texels = gpu::make_buffer(
        device_, sizeof(std::uint32_t) * static_cast<std::size_t>(width) * static_cast<std::size_t>(std::min(band, cones.height)),
        vk::BufferUsageFlagBits::eStorageBuffer);
    const DescriptorSet set = quadrants_.bound({&cells[from], &texels});
    for (int first = 0; first < cones.height; first += band) {
        const int end = std::min(first + band, cones.height);
        run(quadrants_, set, first, end);
        parallel_for(end - first, 16, bake.threads, [&](int begin, int until) {
            const std::uint32_t* word =
                texels.as<std::uint32_t>() + static_cast<std::size_t>(begin) * static_cast<std::size_t>(width);
            float* to = cones.at(0, first + begin);
            for (std::size_t n = static_cast<std::size_t>(until - begin) * static_cast<std::size_t>(width); n > 0;
                 --n, ++word, to += 4)
                for (int c = 0; c < 4; ++c) to[c] = levels[*word >> 8 * c & 255u];
        });
        report(bake.progress, "cell cone map", done / all);
    }
    return cones;
}

}  // namespace relievo
