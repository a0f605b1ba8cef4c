#include "measure/measure.h"

#include "core/error.h"
#include "measure/display_values.h"
#include "measure/flip.h"
#include "measure/hits.h"
#include "measure/psnr.h"
#include "measure/ssim.h"

#include <string>

namespace relievo {

Measurement measure(const Frame& picture, const Frame& reference, const RayField& rays, const MeasureSettings& settings) {
    const auto size = [](int width, int height) { return std::to_string(width) + "x" + std::to_string(height); };
    const std::string asked = size(rays.width, rays.height);
    const std::string drawn = size(picture.width, picture.height);
    const std::string judge = size(reference.width, reference.height);
    if (drawn != judge || drawn != asked || picture.width <= 0 || picture.height <= 0) {
        throw Error("measure", "a picture of " + drawn, "the reference is " + judge + " and the rays are " + asked,
                    "all three must have the same size, at least 1x1");
    }

    Measurement m;
    HitMetrics hits = hit_metrics(picture, reference, rays, {settings.texels_x, settings.texels_y}, settings.threads);
    m.missed_first_hit = hits.missed_first_hit;
    m.early_hit = hits.early_hit;
    m.uv_error_texels = hits.uv_error_texels;
    m.height_error = hits.height_error;
    m.normal_error_deg = hits.normal_error_deg;
    m.shadow_mismatch = hits.shadow_mismatch;
    m.fetches = hits.fetches;

    const FlipSettings flip_settings{.pixels_per_degree = settings.pixels_per_degree, .threads = settings.threads};
    m.flip = flip(picture.colour, reference.colour, flip_settings).mean;

    const ImageF shown = display_values(picture.colour, "the picture", settings.threads);
    const ImageF true_shown = display_values(reference.colour, "the reference", settings.threads);
    m.ssim = ssim(shown, true_shown, settings.threads);
    m.psnr_db = psnr_db(shown, true_shown, settings.threads);
    return m;
}

}  // namespace relievo
