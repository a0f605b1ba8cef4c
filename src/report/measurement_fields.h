// The names of a Measurement's numbers, written once: JSON, CSV and the page walk them.
#pragma once

#include "core/measurement.h"

#include <string_view>

namespace relievo {

// Calls f(name, Measured<T>&) for each member, in the order of the struct. M is Measurement or const Measurement.
template <class M, class F>
void each_field(M& m, F f) {
    f("missed_first_hit", m.missed_first_hit);
    f("early_hit", m.early_hit);
    f("astray", m.astray);
    f("astray_budget", m.astray_budget);
    f("uv_error_texels", m.uv_error_texels);
    f("height_error", m.height_error);
    f("normal_error_deg", m.normal_error_deg);
    f("shadow_mismatch", m.shadow_mismatch);
    f("flip", m.flip);
    f("ssim", m.ssim);
    f("psnr_db", m.psnr_db);
    f("fetches", m.fetches);
    f("gpu_ms", m.gpu_ms);
}

// Calls f(part, number&) for each part of one measured value; a plain number has one part without a name.
template <class F>
void each_part(double& v, F f) { f("", v); }
template <class F>
void each_part(Percentiles& v, F f) { f("p50", v.p50), f("p99", v.p99), f("max", v.max); }
template <class F>
void each_part(FetchCount& v, F f) { f("mean", v.mean), f("p95", v.p95), f("max", v.max); }
template <class F>
void each_part(TimeSpread& v, F f) { f("min", v.min), f("median", v.median), f("max", v.max); }

// What a reader needs to know of one number. `id` is "field" or "field.part".
struct Column {
    std::string_view id;
    std::string_view title;
    std::string_view unit;  // "share" is shown as a percentage
    bool smaller_is_better;
    std::string_view help;
};

// The first is no member: late and early hits together, since each alone calls a flat polygon (never late) or a coarse search
// (never early) perfect.
inline constexpr std::string_view wrong_id = "wrong";

inline constexpr Column columns[] = {
    {wrong_id, "Wrong", "share", true, "pixels whose hit is off by more than half a texel along the ray, either way, or not found"},
    {"missed_first_hit", "Missed", "share", true, "pixels whose first hit is missed: late by more than half a texel, or not found"},
    {"early_hit", "Early", "share", true, "pixels that stop more than half a texel before the surface"},
    {"astray", "Astray", "share", true, "pixels whose hit is not where the technique promises"},
    {"astray_budget", "Allowed astray", "share", true, "the most of them that the catalogue allows the technique on this relief from this view"},
    {"uv_error_texels.p50", "UV error p50", "texels", true, "median distance between the found and the true texture coordinate"},
    {"uv_error_texels.p99", "UV error p99", "texels", true, "99 of 100 pixels are nearer to the true texture coordinate than this"},
    {"uv_error_texels.max", "UV error max", "texels", true, "largest distance to the true texture coordinate"},
    {"height_error.p99", "Height error p99", "height", true, "99 of 100 pixels are nearer to the true height than this, in [0,1]"},
    {"normal_error_deg.p99", "Normal error p99", "°", true, "99 of 100 shading normals are off by less than this"},
    {"shadow_mismatch", "Shadow", "share", true, "pixels lit that should be in self-shadow, or the reverse"},
    {"flip", "FLIP", "", true, "visible difference to the reference when flipping between the two, 0 to 1"},
    {"ssim", "SSIM", "", false, "structural similarity to the reference, at most 1"},
    {"psnr_db", "PSNR", "dB", false, "peak signal-to-noise ratio against the reference"},
    {"fetches.mean", "Fetches", "per pixel", true, "texture fetches of the search, mean over the surface"},
    {"fetches.p95", "Fetches p95", "per pixel", true, "95 of 100 pixels need no more fetches than this"},
    {"fetches.max", "Fetches max", "per pixel", true, "most fetches of any pixel"},
    {"gpu_ms.min", "Time min", "ms", true, "fastest run of the pass on the device"},
    {"gpu_ms.median", "Time", "ms", true, "median run of the pass on the device"},
    {"gpu_ms.max", "Time max", "ms", true, "slowest run of the pass on the device"},
};

}  // namespace relievo
