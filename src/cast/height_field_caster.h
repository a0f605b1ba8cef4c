// First hits of rays with the declared bilinear surface on the CPU, as many at a time as the processor's vectors hold (16 with
// AVX-512, 8 with AVX2, 4 with SSE4). Every cell a ray may touch is solved exactly: nothing is missed that float can resolve. For
// pictures, baking and physics; the truth that everything is judged by is src/reference, which shares nothing with this.
#pragma once

#include "core/height_field.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace relievo {

// A descending ray in texture space, as ReferenceRay: at height z it stands over uv + (z - zero_level) * uv_per_height, and is
// searched from z_start down to z_end <= z_start. All finite; its whole way at most `longest_way_texels`.
struct CastRay {
    Vec2f uv;
    Vec2f uv_per_height;
    float zero_level = 1;
    float z_start = 1;
    float z_end = 0;
};

struct CastHit {
    Vec2f uv;  // not wrapped
    float height = 0;
    bool found = false;  // false: uv and height are the ray's end
};

// A ray so long that integers of its cells no longer fit a float's. At height_scale 0.1 and 1024 texels: flatter than 0.0015
// degrees.
inline constexpr float longest_way_texels = 1 << 22;

struct CasterSettings {
    int threads = 0;     // for building and casting; 0: all cores. The hits do not depend on it.
    std::string target;  // instruction set, a name of caster_targets(); empty: the best this processor has
};

// What this processor runs of what was compiled, best first.
std::vector<std::string> caster_targets();

class HeightFieldCaster {
public:
    // Throws Error where the field is empty, a height lies outside [0, 1] or is no number, or the target is not one of ours.
    // Keeps about 15 bytes a texel; the field itself is not kept.
    explicit HeightFieldCaster(const HeightField& field, const CasterSettings& settings = {});
    ~HeightFieldCaster();
    HeightFieldCaster(HeightFieldCaster&&) noexcept;
    HeightFieldCaster& operator=(HeightFieldCaster&&) noexcept;

    // hits[k] is the first point of rays[k] at which the field is no lower than the ray. A ray with z_end <= 0 always finds one, as
    // every field is at least 0. Fastest where neighbours in the list are neighbours in space (blocks of 4x4 pixels), correct in
    // any order. One hit per ray; safe to call from several threads.
    void cast(std::span<const CastRay> rays, std::span<CastHit> hits) const;

    const std::string& target() const;

private:
    struct Built;
    std::unique_ptr<const Built> built_;
};

}  // namespace relievo
