// Cells that are put to all lanes of a bundle at once, with their patch broadcast, so that nothing is gathered and no lane waits
// for another: for fields of which a bundle touches little, as thin spikes.
#if defined(RELIEVO_CAST_SHARED_CELLS_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELIEVO_CAST_SHARED_CELLS_H
#undef RELIEVO_CAST_SHARED_CELLS_H
#else
#define RELIEVO_CAST_SHARED_CELLS_H
#endif

#include "cast/bundle_lanes.h"
#include "cast/nearest_hit.h"
#include "cast/slices.h"

HWY_BEFORE_NAMESPACE();
namespace relievo {
namespace HWY_NAMESPACE {

// Slices are taken together until they have more cells than this: fewer turns of the outer loop, whose ends nobody foresees.
constexpr std::size_t few_cells = 10;

// The cells of the blocks that the bundle does not clear: place in the block list times 16, and in the block.
struct CellList {
    std::int32_t cells[most_rows * block_cells + few_cells + lane_count];
};

// Appends those of the k-th block to the `count` there are; the new count. highest: of each place in a block, the highest so far.
HWY_INLINE std::size_t find_cells(const CastGrid& grid, const Bundle& bundle, const BlockList& blocks, std::size_t k, CellList& out,
                                  std::size_t count, F* highest) {
    const Floats d;
    const Ints di;
    const float a_near = blocks.a_near[k], q_low = blocks.q_low[k];
    const std::uint16_t* const tops = grid.tops + static_cast<std::size_t>(blocks.block[k]) * block_cells;
    const F low = hn::Set(d, q_low - bundle.lean_low * a_near), high = hn::Set(d, q_low - bundle.lean_high * a_near);
    const F down = hn::Set(d, bundle.descent_slope * a_near), floor = hn::Set(d, bundle.floor);
    for (std::size_t c = 0; c < Bundle::vectors; ++c) {
        const F top =
            hn::Mul(hn::ConvertTo(d, hn::PromoteTo(di, hn::LoadU(hn::Rebind<std::uint16_t, Ints>(), tops + c * lane_count))),
                    hn::Set(d, node_unit));
        const FMask crossed = hn::And(hn::Ge(low, bundle.cell_low[c]), hn::Le(high, bundle.cell_high[c]));
        const FMask left = hn::And(crossed, hn::Ge(top, hn::Max(floor, hn::Sub(bundle.cell_roof[c], down))));
        highest[c] = hn::Max(highest[c], hn::IfThenElseZero(left, top));
        const I entry = hn::Add(hn::Iota(di, 0), hn::Set(di, static_cast<std::int32_t>(k * block_cells + c * lane_count)));
        hn::StoreU(hn::Compress(entry, hn::RebindMask(di, left)), di, out.cells + count);
        count += hn::CountTrue(d, left);
    }
    return count;
}

// Puts each cell to all lanes.
HWY_INLINE void put_cells(const CastGrid& grid, const Bundle& bundle, const BundleLanes& lanes, const BlockList& blocks,
                          const CellList& list, std::size_t count, NearestHit& nearest) {
    const Floats d;
    const unsigned u_shift = bundle.along_x ? 0 : block_level, v_shift = bundle.along_x ? block_level : 0;
    const int next_p = bundle.along_x ? patch_step : 1, next_q = bundle.along_x ? 1 : patch_step;
    const int p_floats = bundle.along_x ? patch_step : grid.patch_pitch, q_floats = bundle.along_x ? grid.patch_pitch : patch_step;
    const F enter_p = hn::Mul(lanes.back_p, hn::Set(d, -lanes.near_p)),
            leave_p = hn::Mul(lanes.back_p, hn::Set(d, lanes.near_p - 1));
    const F enter_q = hn::Mul(lanes.back_q, hn::Set(d, -lanes.near_q)),
            leave_q = hn::Mul(lanes.back_q, hn::Set(d, lanes.near_q - 1));
    const FMask all = hn::Eq(hn::Zero(d), hn::Zero(d));
    NearestHit near = nearest;
    for (std::size_t k = 0; k < count; ++k) {
        const auto entry = static_cast<unsigned>(list.cells[k]);
        const unsigned n = entry / block_cells, cell = entry % block_cells;
        const auto u = static_cast<std::int32_t>(cell >> u_shift & (block_side - 1)),
                   v = static_cast<std::int32_t>(cell >> v_shift & (block_side - 1));
        const float a_near = blocks.a_near[n];
        const float* const patch = grid.patches + (blocks.patch[n] + u * p_floats + v * q_floats);
        const F descent = lanes.descent_at(a_near);
        const F x = lanes.place_p(descent, (bundle.forward ? a_near : -a_near - block_side) + static_cast<float>(u));
        const F y = lanes.place_q(descent, blocks.q_low[n] + static_cast<float>(v));
        const F enter =
            hn::Max(hn::Max(hn::MulAdd(x, lanes.back_p, enter_p), hn::MulAdd(y, lanes.back_q, enter_q)), hn::Neg(descent));
        const F exit = hn::Min(hn::Min(hn::MulAdd(x, lanes.back_p, leave_p), hn::MulAdd(y, lanes.back_q, leave_q)),
                               hn::Sub(lanes.descent_end, descent));
        near.put(all, hn::Set(d, patch[0]), hn::Set(d, patch[next_p]), hn::Set(d, patch[next_q]),
                 hn::Set(d, patch[next_p + next_q]), x, y, enter, exit, descent, hn::Sub(lanes.z_start, descent), lanes.speed_p,
                 lanes.speed_q, lanes.speed_pq);
    }
    nearest = near;
}

}  // namespace HWY_NAMESPACE
}  // namespace relievo
HWY_AFTER_NAMESPACE();

#endif  // per target
