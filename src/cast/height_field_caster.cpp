#include "cast/height_field_caster.h"

#include "cast/cast_grid.h"
#include "core/error.h"
#include "core/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <utility>

namespace relievo {

namespace {

// Rays per task: small enough for every core to get some of a small picture, large enough that handing it out costs nothing.
constexpr std::size_t rays_per_task = 4096;

// The smallest q with q * node_unit >= h in float, as the kernels compute it.
std::uint16_t rounded_up(float h) {
    const int q = static_cast<int>(h * 65535.0f);
    return static_cast<std::uint16_t>(static_cast<float>(q) * node_unit >= h ? q : q + 1);
}

// One level more than the coarsest that a ray asks for: nodes remain until a period is a few across, as in maps/max_pyramid.
int levels_of(int width, int height) {
    int levels = 1;
    while (levels < 12 && (std::max(width, height) >> levels) >= 4 && (std::min(width, height) >> levels) >= 1) ++levels;
    return levels;
}

}  // namespace

// In one cache line.
struct alignas(32) TopBlock {
    std::uint16_t cells[block_cells];
};

struct HeightFieldCaster::Built {
    std::vector<float> patches;
    std::vector<TopBlock> tops;
    std::vector<std::uint16_t> nodes;
    std::vector<float> tops_up, tops_right;
    std::vector<std::uint32_t> roofs_up, roofs_right;
    CastGrid grid;
    CastTarget target{};
    std::string target_name;
    int threads = 0;
};

std::vector<std::string> caster_targets() {
    std::vector<std::string> names;
    for (const CastTarget& target : runnable_cast_targets()) names.push_back(target.name);
    return names;
}

HeightFieldCaster::HeightFieldCaster(const HeightField& field, const CasterSettings& settings) {
    const std::string attempt = "build a caster for";
    const std::string subject = "a height field of " + std::to_string(field.width()) + "x" + std::to_string(field.height());
    if (field.empty()) throw Error(attempt, subject, "it has no texels");
    auto built = std::make_unique<Built>();
    built->threads = settings.threads;
    const auto targets = runnable_cast_targets();
    const auto chosen = settings.target.empty() ? targets.begin()
                                                : std::find_if(targets.begin(), targets.end(),
                                                               [&](const CastTarget& t) { return t.name == settings.target; });
    if (chosen == targets.end()) {
        std::string known;
        for (const CastTarget& t : targets) known += (known.empty() ? "" : ", ") + std::string(t.name);
        throw Error(attempt, subject, "this processor has no target '" + settings.target + "'", "it has " + known);
    }
    built->target = *chosen;
    built->target_name = chosen->name;

    CastGrid& grid = built->grid;
    const int width = grid.width = field.width();
    const int height = grid.height = field.height();
    grid.levels = levels_of(width, height);
    const int coarsest = 1 << (grid.levels - 1);
    const int rows = (height + coarsest - 1) / coarsest * coarsest;
    grid.stack = 2 * rows;
    grid.node_pitch = (width + coarsest - 1) / coarsest * coarsest + 32;  // not a power of two: rows would share cache sets
    grid.block_columns = (width + block_side - 1) / block_side;
    const int block_rows = (height + block_side - 1) / block_side;
    const auto at = [](int row, int pitch) { return static_cast<std::size_t>(row) * static_cast<std::size_t>(pitch); };
    // One node of slack, as 32 bits are read where 16 are wanted.
    built->nodes.resize(at(grid.stack, grid.node_pitch) + 2);
    built->tops.resize(at(block_rows, grid.block_columns));
    // Not a power of two either, nor near one.
    grid.patch_pitch = patch_step * (width + 1) + 30;
    built->patches.resize(at(height, grid.patch_pitch));
    std::uint16_t* const nodes = built->nodes.data();
    const float* const texels = field.texels.texels.data();

    std::atomic<bool> valid{true};
    parallel_for(block_rows, 16, settings.threads, [&](int begin, int end) {
        bool good = true;
        for (int j = begin * block_side; j < std::min(end * block_side, height); ++j) {
            const float* const row = texels + at(j, width);
            const float* const above = texels + at(j + 1 == height ? 0 : j + 1, width);
            std::uint16_t* const node_row = nodes + at(j, grid.node_pitch);
            float* const patch = built->patches.data() + at(j, grid.patch_pitch);
            for (int i = 0; i < width; ++i) {
                const int next = i + 1 == width ? 0 : i + 1;
                const float h00 = row[i], h10 = row[next], h01 = above[i], h11 = above[next];
                good &= h00 >= 0 && h00 <= 1;
                patch[patch_step * i] = h00, patch[patch_step * i + 1] = h01;
                const std::size_t block = at(j / block_side, grid.block_columns) + static_cast<std::size_t>(i / block_side);
                const auto cell = static_cast<std::size_t>(j % block_side * block_side + i % block_side);
                const float top = std::max(std::max(h00, h10), std::max(h01, h11));
                // What is no height is not made a node: it is refused below.
                node_row[i] = built->tops[block].cells[cell] = top >= 0 && top <= 1 ? rounded_up(top) : std::uint16_t{0};
            }
            std::copy(patch, patch + patch_step, patch + patch_step * width);
        }
        if (!good) valid = false;
    });
    if (!valid) throw Error(attempt, subject, "a height is outside [0, 1] or not a number", "scale the heights to [0, 1] first");

    for (int level = 1; level < grid.levels; ++level) {
        const int from_row = grid.stack - (grid.stack >> (level - 1));
        const int to_row = grid.stack - (grid.stack >> level);
        // Cells behind the period's end are 0 and raise no maximum.
        const int columns = (grid.node_pitch - 32) >> level;
        parallel_for(rows >> level, 64, settings.threads, [&](int begin, int end) {
            for (int j = begin; j < end; ++j) {
                const std::uint16_t* row = nodes + at(from_row + 2 * j, grid.node_pitch);
                const std::uint16_t* above = row + grid.node_pitch;
                std::uint16_t* to = nodes + at(to_row + j, grid.node_pitch);
                for (int i = 0; i < columns; ++i)
                    to[i] = std::max(std::max(row[2 * i], row[2 * i + 1]), std::max(above[2 * i], above[2 * i + 1]));
            }
        });
    }
    const int columns = grid.block_columns;
    std::vector<std::uint32_t> tops(at(block_rows, columns)), sums(tops.size());
    for (std::size_t block = 0; block < tops.size(); ++block) {
        const std::uint16_t* const of = built->tops[block].cells;
        tops[block] = *std::max_element(of, of + block_cells);
        for (int k = 0; k < block_cells; ++k) sums[block] += of[k];
    }
    const auto index = [&](int i, int j) { return at(j % block_rows, columns) + static_cast<std::size_t>(i % columns); };
    const auto top = [&](int i, int j) { return static_cast<float>(tops[index(i, j)]) * node_unit; };
    built->tops_up.resize(at(columns, block_rows + tops_slack));
    built->tops_right.resize(at(block_rows, columns + tops_slack));
    built->roofs_up.resize(tops.size());
    built->roofs_right.resize(tops.size());
    parallel_for(columns, 16, settings.threads, [&](int begin, int end) {
        for (int i = begin; i < end; ++i)
            for (int j = 0; j < block_rows + tops_slack; ++j)
                built->tops_up[at(i, block_rows + tops_slack) + static_cast<std::size_t>(j)] = top(i, j);
    });
    parallel_for(block_rows, 16, settings.threads, [&](int begin, int end) {
        for (int j = begin; j < end; ++j) {
            for (int i = 0; i < columns + tops_slack; ++i)
                built->tops_right[at(j, columns + tops_slack) + static_cast<std::size_t>(i)] = top(i, j);
            for (int i = 0; i < columns; ++i) {
                std::uint32_t up = 0, right = 0, up_sum = 0, right_sum = 0;
                for (int k = 0; k < roof_blocks; ++k) {
                    up = std::max(up, tops[index(i, j + k)]), right = std::max(right, tops[index(i + k, j)]);
                    up_sum += sums[index(i, j + k)], right_sum += sums[index(i + k, j)];
                }
                built->roofs_up[index(i, j)] = up << 16 | up_sum / (roof_blocks * block_cells);
                built->roofs_right[index(i, j)] = right << 16 | right_sum / (roof_blocks * block_cells);
            }
        }
    });
    grid.roofs_up = built->roofs_up.data();
    grid.roofs_right = built->roofs_right.data();
    grid.tops_up = built->tops_up.data();
    grid.tops_right = built->tops_right.data();
    grid.patches = built->patches.data();
    grid.tops = built->tops.data()->cells;
    grid.nodes = nodes;
    built_ = std::move(built);
}

HeightFieldCaster::~HeightFieldCaster() = default;
HeightFieldCaster::HeightFieldCaster(HeightFieldCaster&&) noexcept = default;
HeightFieldCaster& HeightFieldCaster::operator=(HeightFieldCaster&&) noexcept = default;

const std::string& HeightFieldCaster::target() const { return built_->target_name; }

void HeightFieldCaster::cast(std::span<const CastRay> rays, std::span<CastHit> hits) const {
    assert(rays.size() == hits.size());
    const auto task = [&](std::size_t first) {
        built_->target.function(built_->grid, rays.data() + first, std::min(rays_per_task, rays.size() - first),
                                hits.data() + first);
    };
    const auto tasks = static_cast<int>((rays.size() + rays_per_task - 1) / rays_per_task);
    if (tasks == 1) return task(0);
    parallel_for(tasks, 1, built_->threads, [&](int begin, int end) {
        for (int t = begin; t < end; ++t) task(static_cast<std::size_t>(t) * rays_per_task);
    });
}

}  // namespace relievo
