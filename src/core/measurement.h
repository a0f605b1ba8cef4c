// The verdict on one Frame against another. A number that does not exist carries the reason instead.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace relievo {

struct Percentiles {
    double p50 = 0, p99 = 0, max = 0;
};

struct FetchCount {
    double mean = 0, p95 = 0, max = 0;
};

struct TimeSpread {
    double min = 0, median = 0, max = 0;
    int runs = 0;
};

// Either a value or the reason why there is none.
template <class T>
struct Measured {
    std::optional<T> value;
    std::string reason;  // set exactly when value is not

    Measured() : reason("not measured") {}
    Measured(T v) : value(std::move(v)) {}
    static Measured missing(std::string why) {
        Measured m;
        m.reason = std::move(why);
        return m;
    }
    explicit operator bool() const { return value.has_value(); }
    const T& operator*() const { return *value; }
    const T* operator->() const { return &*value; }
};

// Shares are in [0,1] of the pixels where the reference has a hit; that of the shadow, of those where the picture has one too.
struct Measurement {
    Measured<double> missed_first_hit;      // share of hits late by more than half a texel along the ray, or not found at all
    Measured<double> early_hit;             // share of hits early by more than half a texel
    Measured<double> astray;                // share of hits that are not where the technique promises (core/promise.h)
    Measured<double> astray_budget;         // the share its row of the catalogue allows here
    Measured<Percentiles> uv_error_texels;  // distance in UV, in texels of the height map
    Measured<Percentiles> height_error;     // |height - true height|, in [0,1]
    Measured<Percentiles> normal_error_deg;
    Measured<double> shadow_mismatch;       // share of pixels whose key-light visibility differs by more than one half
    Measured<double> flip;                  // mean LDR-FLIP
    Measured<double> ssim;
    Measured<double> psnr_db;
    Measured<FetchCount> fetches;
    Measured<TimeSpread> gpu_ms;
};

// Whether the technique keeps what its row says; missing where it was not judged.
inline Measured<bool> inside_budget(const Measurement& m) {
    if (!m.astray) return Measured<bool>::missing(m.astray.reason);
    if (!m.astray_budget) return Measured<bool>::missing(m.astray_budget.reason);
    return *m.astray <= *m.astray_budget;
}

}  // namespace relievo
