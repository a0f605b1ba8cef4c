// The registers that searches for cones compute in, and what the language has no operator for.
//
// Included once for every kind of machine (core/each_machine.h), in its namespace: no include guard.

namespace relievo::cone_search::RELIEVO_MACHINE {

// Under GCC's and Clang's vector extension, as wide as a register of the machine: wider ones would be taken apart lane by lane.
using Lanes = float __attribute__((vector_size(4 * RELIEVO_LANES)));
using LaneMask = std::int32_t __attribute__((vector_size(4 * RELIEVO_LANES)));
constexpr int lane_count = RELIEVO_LANES;

inline bool any(LaneMask mask) {
#if RELIEVO_LANES == 16
    return __builtin_ia32_cvtd2mask512(mask) != 0;
#elif RELIEVO_LANES == 8
    return __builtin_ia32_movmskps256(reinterpret_cast<Lanes>(mask)) != 0;
#else
    std::uint64_t half[2];
    std::memcpy(half, &mask, sizeof half);
    return (half[0] | half[1]) != 0;
#endif
}
// A lane's answer in the bit of its number.
inline std::uint32_t bits_of(LaneMask mask) {
#if RELIEVO_LANES == 16
    return __builtin_ia32_cvtd2mask512(mask);
#elif RELIEVO_LANES == 8
    return static_cast<std::uint32_t>(__builtin_ia32_movmskps256(reinterpret_cast<Lanes>(mask)));
#else
    std::uint32_t bits = 0;
    for (int l = 0; l < lane_count; ++l) bits |= mask[l] != 0 ? 1u << l : 0u;
    return bits;
#endif
}
// Compilers take a comparison of 16 lanes into a vector and back before they ask which hold.
inline std::uint32_t bits_less(Lanes a, Lanes b) {
#if RELIEVO_LANES == 16
    return __builtin_ia32_cmpps512_mask(a, b, 1, -1, 4);
#else
    return bits_of(a < b);
#endif
}
inline bool any_less(Lanes a, Lanes b) {
#if RELIEVO_LANES == 16
    return bits_less(a, b) != 0;
#else
    return any(a < b);
#endif
}
inline Lanes least(Lanes a, Lanes b) { return a < b ? a : b; }
inline Lanes most(Lanes a, Lanes b) { return a > b ? a : b; }
inline Lanes magnitude(Lanes a) { return a < 0.0f ? -a : a; }
inline Lanes root(Lanes a) {
#if RELIEVO_LANES == 16
    return __builtin_ia32_sqrtps512_mask(a, a, -1, 4);
#elif RELIEVO_LANES == 8
    return __builtin_ia32_sqrtps256(a);
#else
    for (int l = 0; l < lane_count; ++l) a[l] = std::sqrt(a[l]);
    return a;
#endif
}

}  // namespace relievo::cone_search::RELIEVO_MACHINE
