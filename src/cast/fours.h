// Four floats that lie side by side, for each lane, as four vectors: what four gathers would load, in a quarter of the loads.
// Processors that take a gather apart (AMD's family 25) cast a fifth faster for it.
#if defined(RELIEVO_CAST_FOURS_H) == defined(HWY_TARGET_TOGGLE)
#ifdef RELIEVO_CAST_FOURS_H
#undef RELIEVO_CAST_FOURS_H
#else
#define RELIEVO_CAST_FOURS_H
#endif

#include "cast/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace relievo {
namespace HWY_NAMESPACE {

struct Fours {
    F first, second, third, fourth;
};

#if HWY_TARGET != HWY_SCALAR
// Of every fourth lane from `lane` on its 16 bytes, side by side.
template <class D, class Of>
HWY_INLINE hn::Vec<D> load_blocks(D d, const Of& of, std::size_t lane) {
    if constexpr (hn::MaxLanes(D()) == 4) {
        return hn::LoadU(d, of(lane));
    } else {
        const hn::Half<D> half;
        return hn::Combine(d, load_blocks(half, of, lane + hn::MaxLanes(half)), load_blocks(half, of, lane));
    }
}
#endif

// of(lane): where the lane's four floats are.
template <class Of>
HWY_INLINE Fours load_fours(const Of& of) {
    const Floats d;
#if HWY_TARGET == HWY_SCALAR
    const float* const at = of(0);
    return {hn::Set(d, at[0]), hn::Set(d, at[1]), hn::Set(d, at[2]), hn::Set(d, at[3])};
#else
    const hn::Repartition<double, Floats> wide;
    // Four lanes are turned within 16 bytes.
    F from[4];
    for (std::size_t k = 0; k < 4; ++k) from[k] = load_blocks(d, of, k);
    const auto pairs = [&](F a, F b) HWY_ATTR { return hn::BitCast(wide, hn::InterleaveLower(d, a, b)); };
    const auto pairs_behind = [&](F a, F b) HWY_ATTR { return hn::BitCast(wide, hn::InterleaveUpper(d, a, b)); };
    const auto low_01 = pairs(from[0], from[1]), low_23 = pairs(from[2], from[3]);
    const auto high_01 = pairs_behind(from[0], from[1]), high_23 = pairs_behind(from[2], from[3]);
    return {hn::BitCast(d, hn::InterleaveLower(wide, low_01, low_23)), hn::BitCast(d, hn::InterleaveUpper(wide, low_01, low_23)),
            hn::BitCast(d, hn::InterleaveLower(wide, high_01, high_23)),
            hn::BitCast(d, hn::InterleaveUpper(wide, high_01, high_23))};
#endif
}

}  // namespace HWY_NAMESPACE
}  // namespace relievo
HWY_AFTER_NAMESPACE();

#endif  // per target
