#include "measure/hits.h"

#include "core/error.h"
#include "core/parallel_for.h"
#include "measure/along_ray.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>

namespace relievo {

namespace {

constexpr auto hit = static_cast<std::uint8_t>(Coverage::hit);

void require_finite(const ImageF& plane, int x, int y, const char* plane_name, const char* frame_name) {
    for (int c = 0; c < plane.channels; ++c) {
        if (std::isfinite(plane(x, y, c))) continue;
        throw Error("compare", std::string(frame_name), "its " + std::string(plane_name) + " at pixel (" + std::to_string(x) + ", " +
                    std::to_string(y) + ") is not a finite number", "pixels count from the top left corner");
    }
}

void require_sound_hit(const Frame& frame, int x, int y, const char* name) {
    require_finite(frame.hit_uv, x, y, "hit UV", name);
    require_finite(frame.hit_height, x, y, "hit height", name);
    require_finite(frame.normal, x, y, "normal", name);
    require_finite(frame.shadow, x, y, "shadow", name);
    require_finite(frame.fetches, x, y, "fetch count", name);
    const float* n = frame.normal.at(x, y);
    if (n[0] * n[0] + n[1] * n[1] + n[2] * n[2] < 1e-6f) {
        throw Error("compare", name, "its normal at pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") has no length",
                    "every hit carries a unit normal");
    }
}

// Exact also for small angles, where the arc cosine of a dot product loses half of its digits.
double angle_deg(const float* a, const float* b) {
    const Vec3d u{a[0], a[1], a[2]};
    const Vec3d v{b[0], b[1], b[2]};
    return std::atan2(length(cross(u, v)), dot(u, v)) * (180 / std::numbers::pi);
}

// The facts of one row, in order of x.
struct Row {
    int judged = 0, missed = 0, early = 0, compared = 0, shadow_differs = 0;
    std::vector<float> uv, height, normal, fetches;
    std::optional<Error> fault;  // kept, not thrown: the message is about the first pixel, whichever thread ends first
};

// Absurd but finite coordinates can have a distance beyond float.
float finite_float(double v) { return static_cast<float>(std::min(v, static_cast<double>(std::numeric_limits<float>::max()))); }

std::vector<float> joined(std::vector<Row>& rows, std::vector<float> Row::*member) {
    std::size_t count = 0;
    for (const Row& row : rows) count += (row.*member).size();
    std::vector<float> all;
    all.reserve(count);
    for (Row& row : rows) all.insert(all.end(), (row.*member).begin(), (row.*member).end());
    return all;
}

Measured<Percentiles> percentiles(std::vector<float> values, const std::string& reason_if_empty) {
    if (values.empty()) return Measured<Percentiles>::missing(reason_if_empty);
    return Percentiles{.p50 = nearest_rank(values, 0.50), .p99 = nearest_rank(values, 0.99),
                       .max = *std::max_element(values.begin(), values.end())};
}

}  // namespace

double nearest_rank(std::vector<float>& values, double p) {
    assert(!values.empty() && p > 0 && p <= 1);
    // 0.99 * 100 is a little more than 99 in binary; without the allowance its ceiling would be 100.
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(p * static_cast<double>(values.size()) * (1 - 1e-12)));
    const auto at = values.begin() + std::max<std::ptrdiff_t>(rank, 1) - 1;
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

HitMetrics hit_metrics(const Frame& picture, const Frame& reference, const RayField& rays, Vec2i texels, int threads) {
    assert(picture.width == reference.width && picture.height == reference.height);
    assert(picture.width == rays.width && picture.height == rays.height);
    assert(texels.x >= 0 && texels.y >= 0);
    const bool has_texels = texels.x > 0 && texels.y > 0;
    const Vec2d size{static_cast<double>(texels.x), static_cast<double>(texels.y)};

    std::vector<Row> rows(static_cast<std::size_t>(picture.height));
    const auto judge_row = [&](Row& row, int y) {
        for (int x = 0; x < picture.width; ++x) {
            const bool found = picture.coverage(x, y) == hit;
            if (found) {
                require_sound_hit(picture, x, y, "the picture");
                row.fetches.push_back(picture.fetches(x, y));
            }
            if (rays.coverage(x, y) != hit || reference.coverage(x, y) != hit) continue;
            require_sound_hit(reference, x, y, "the reference");
            require_finite(rays.view, x, y, "view direction", "the rays");
            ++row.judged;
            if (!found) {
                ++row.missed;
                continue;
            }
            ++row.compared;
            const float* uv = picture.hit_uv.at(x, y);
            const float* true_uv = reference.hit_uv.at(x, y);
            const float* view = rays.view.at(x, y);
            if (has_texels) {
                const Vec2d a{uv[0], uv[1]};
                const Vec2d b{true_uv[0], true_uv[1]};
                const double late = texels_along_ray(a, b, {view[0], view[1], view[2]}, size);
                if (late > right_within_texels) ++row.missed;
                if (late < -right_within_texels) ++row.early;
                row.uv.push_back(finite_float(length((a - b) * size)));
            }
            row.height.push_back(finite_float(std::abs(static_cast<double>(picture.hit_height(x, y)) -
                                                       static_cast<double>(reference.hit_height(x, y)))));
            row.normal.push_back(finite_float(angle_deg(picture.normal.at(x, y), reference.normal.at(x, y))));
            if (std::abs(picture.shadow(x, y) - reference.shadow(x, y)) > 0.5f) ++row.shadow_differs;
        }
    };
    parallel_for(picture.height, 16, threads, [&](int begin, int end) {
        for (int y = begin; y < end; ++y) {
            Row& row = rows[static_cast<std::size_t>(y)];
            try {
                judge_row(row, y);
            } catch (const Error& fault) {
                row.fault = fault;
            }
        }
    });
    for (const Row& row : rows) {
        if (row.fault) throw Error(*row.fault);
    }

    long long judged = 0, missed = 0, early = 0, compared = 0, shadow_differs = 0;
    for (const Row& row : rows) {
        judged += row.judged;
        missed += row.missed;
        early += row.early;
        compared += row.compared;
        shadow_differs += row.shadow_differs;
    }

    const std::string none_judged = "the reference has no hit in any pixel";
    const std::string none_compared = judged == 0 ? none_judged : "no surface was found in any pixel";
    const std::string no_texels = "without a height map there is no texel to measure in";

    HitMetrics m;
    if (!has_texels) {
        m.missed_first_hit = m.early_hit = Measured<double>::missing(no_texels);
        m.uv_error_texels = Measured<Percentiles>::missing(no_texels);
    } else if (judged == 0) {
        m.missed_first_hit = m.early_hit = Measured<double>::missing(none_judged);
        m.uv_error_texels = Measured<Percentiles>::missing(none_judged);
    } else {
        m.missed_first_hit = static_cast<double>(missed) / static_cast<double>(judged);
        m.early_hit = static_cast<double>(early) / static_cast<double>(judged);
        m.uv_error_texels = percentiles(joined(rows, &Row::uv), none_compared);
    }
    m.height_error = percentiles(joined(rows, &Row::height), none_compared);
    m.normal_error_deg = percentiles(joined(rows, &Row::normal), none_compared);
    m.shadow_mismatch = compared == 0 ? Measured<double>::missing(none_compared)
                                      : Measured<double>(static_cast<double>(shadow_differs) / static_cast<double>(compared));

    std::vector<float> fetches = joined(rows, &Row::fetches);
    if (fetches.empty()) {
        m.fetches = Measured<FetchCount>::missing("no surface was found in any pixel");
    } else {
        const double mean = std::accumulate(fetches.begin(), fetches.end(), 0.0) / static_cast<double>(fetches.size());
        const double p95 = nearest_rank(fetches, 0.95);
        m.fetches = FetchCount{.mean = mean, .p95 = p95, .max = *std::max_element(fetches.begin(), fetches.end())};
    }
    return m;
}

}  // namespace relievo
