// All lanes as one bundle, slice by slice along the axis it crosses fastest (coherent grid traversal: Wald, Ize, Kensler, Knoll and
// Parker 2006, "Ray tracing animated scenes using coherent grid traversal"). Which cell a lane hits first is decided by signs; the
// roots are solved once, at the end.
#if defined(RELIEVO_CAST_WALK_TOGETHER_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELIEVO_CAST_WALK_TOGETHER_H
#undef RELIEVO_CAST_WALK_TOGETHER_H
#else
#define RELIEVO_CAST_WALK_TOGETHER_H
#endif

#include "cast/cross_slices.h"
#include "cast/shared_cells.h"

#include <bit>

HWY_BEFORE_NAMESPACE();
namespace relievo {
namespace HWY_NAMESPACE {

// More cells than this in a slice, and every lane crosses it by itself. Measured; 8 to 16 are as good.
constexpr std::size_t crowded = 12;

// group: the first slices, tested.
HWY_INLINE LaneHits walk_together(const CastGrid& grid, const Lanes& in, const Bundle& bundle, SliceGroup& group) {
    const Floats d;
    const BundleLanes lanes = bundle_lanes(in, bundle);
    NearestHit nearest;
    const std::int32_t slices = static_cast<std::int32_t>(bundle.a_end * (1.0f / block_side)) + 1;
    for (std::int32_t first = 0; first < slices && !hn::AllTrue(d, nearest.found());
         first += static_cast<std::int32_t>(lane_count)) {
        if (first > 0) test_slices(grid, bundle, first, group);
        std::uint32_t touched = group.touched;
        std::size_t slice;
        float a_near;
        const auto next = [&]() HWY_ATTR {
            slice = static_cast<std::size_t>(std::countr_zero(touched));
            touched &= touched - 1;
            a_near = static_cast<float>((first + static_cast<std::int32_t>(slice)) * block_side);
        };
        // Every lane by itself through `slice` and what is touched right behind it.
        const auto cross = [&](const F* highest) HWY_ATTR {
            std::size_t last = slice;
            while (last < slice + most_behind && last + 1 < lane_count && (touched >> (last + 1) & 1) != 0)
                ++last, touched &= touched - 1;
            cross_slices(grid, bundle, lanes, group, slice, last, a_near, highest, nearest);
        };
        while (touched != 0) {
            if ((group.smooth >> std::countr_zero(touched) & 1) != 0) {
                next();
                cross(nullptr);
            } else {
                BlockList blocks;
                CellList list;
                std::size_t count = 0, block_count = 0, before;  // before: the cells of the slices before the last
                F highest[Bundle::vectors];
                do {
                    next();
                    before = count;
                    for (F& h : highest) h = hn::Zero(d);
                    std::size_t k = block_count;
                    block_count = find_blocks(grid, bundle, group, slice, a_near, blocks, block_count);
                    for (; k < block_count; ++k) count = find_cells(grid, bundle, blocks, k, list, count, highest);
                } while (count <= few_cells && block_count <= few_blocks && touched != 0);
                const bool crosses = count - before > crowded;
                put_cells(grid, bundle, lanes, blocks, list, crosses ? before : count, nearest);
                if (crosses) cross(highest);
            }
            if (hn::AllTrue(d, nearest.found())) break;
        }
    }
    const FMask found = nearest.found();
    return {hn::IfThenElse(found, nearest.begin, lanes.descent_end), nearest.gap, nearest.slope, nearest.bend, found};
}

}  // namespace HWY_NAMESPACE
}  // namespace relievo
HWY_AFTER_NAMESPACE();

#endif  // per target
