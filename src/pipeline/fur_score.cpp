#include "pipeline/fur_score.h"

#include "assets/image_file.h"
#include "measure/flip.h"

#include <algorithm>
#include <cmath>

namespace relievo {

namespace {

// A studio's paper: lighter behind the middle, darker toward the edges and below.
Vec3f backdrop(double x, double y) {
    const double dx = x - 0.5, dy = y - 0.42, glow = std::exp(-3.0 * (dx * dx + dy * dy));
    const double v = 0.13 + 0.27 * glow;
    return Vec3f(Vec3d(v, v * 1.01, v * 1.03));
}

// Linear light, before the backdrop.
ImageF before_backdrop(const FurFrames& frames) {
    ImageF all(frames.colour.width, frames.colour.height, 3);
    for (int y = 0; y < all.height; ++y)
        for (int x = 0; x < all.width; ++x) {
            const Vec3f behind = backdrop((x + 0.5) / all.width, (y + 0.5) / all.height);
            const float open = 1 - frames.coverage(x, y);
            const float* c = frames.colour.at(x, y);
            all(x, y, 0) = c[0] + open * behind.x;
            all(x, y, 1) = c[1] + open * behind.y;
            all(x, y, 2) = c[2] + open * behind.z;
        }
    return all;
}

}  // namespace

Image8 shown_fur(const FurFrames& frames) {
    const ImageF linear = before_backdrop(frames);
    Image8 picture(linear.width, linear.height, 3);
    for (std::size_t i = 0; i < linear.texels.size(); ++i) picture.texels[i] = srgb_from_linear(linear.texels[i]);
    return picture;
}

Image8 side_by_side(const Image8& left, const Image8& right) {
    Image8 both(left.width + right.width, left.height, 3);
    for (int y = 0; y < left.height; ++y) {
        std::copy_n(left.at(0, y), left.width * 3, both.at(0, y));
        std::copy_n(right.at(0, y), right.width * 3, both.at(left.width, y));
    }
    return both;
}

FurScore fur_score(const FurFrames& picture, const FurFrames& reference, int threads) {
    FurScore score;
    score.flip = flip(before_backdrop(picture), before_backdrop(reference), {.threads = threads}).mean;
    double sum = 0;
    std::size_t either = 0, inside = 0, open = 0;
    for (std::size_t p = 0; p < reference.coverage.texels.size(); ++p) {
        const float a = picture.coverage.texels[p], b = reference.coverage.texels[p];
        if (a > 0 || b > 0) {
            ++either;
            sum += std::abs(static_cast<double>(a) - static_cast<double>(b));
        }
        inside += b > 0.5f;
        open += b > 0.5f && a < 0.25f;
    }
    if (either > 0) score.coverage_error = sum / static_cast<double>(either);
    if (inside > 0) score.gaps = static_cast<double>(open) / static_cast<double>(inside);
    return score;
}

}  // namespace relievo
