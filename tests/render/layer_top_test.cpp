// Where layers of shells lie: they fill the fur whatever their number, and none jumps as that grows.
#include "render/fur_frames.h"
#include "techniques/glsl.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace relievo {
namespace glsl {
#include "fur/layer_top.glsl"
}
namespace {

// The tops of all layers, and the lower end of the last.
std::vector<double> tops(double layers) {
    const FurView view = with_layers({}, layers);
    std::vector<double> result;
    for (int i = 0; i <= view.layers; ++i) result.push_back(static_cast<double>(glsl::layer_top(i, static_cast<float>(layers_of(view)))));
    return result;
}

TEST(LayerTop, HalvesTheOutermostOfEqualLayersFirst) {
    EXPECT_EQ(tops(1), (std::vector<double>{1, 0}));
    EXPECT_EQ(tops(4), (std::vector<double>{1, 0.75, 0.5, 0.25, 0}));
    EXPECT_EQ(tops(6), (std::vector<double>{1, 0.875, 0.75, 0.625, 0.5, 0.25, 0}));
    EXPECT_EQ(tops(6.25), (std::vector<double>{1, 0.875, 0.75, 0.625, 0.5, 0.46875, 0.25, 0}));
    EXPECT_EQ(tops(8), (std::vector<double>{1, 0.875, 0.75, 0.625, 0.5, 0.375, 0.25, 0.125, 0}));
}

TEST(LayerTop, FillsTheFurWithLayersThinnerAbove) {
    for (double layers = 1; layers <= 64; layers += 1.0 / 16) {
        const std::vector<double> t = tops(layers);
        EXPECT_EQ(t.front(), 1) << layers;
        EXPECT_EQ(t.back(), 0) << layers;
        double thickest = 0;
        for (std::size_t i = 1; i < t.size(); ++i) {
            EXPECT_LT(t[i], t[i - 1]) << layers;
            thickest = std::max(thickest, t[i - 1] - t[i]);
        }
        EXPECT_LT(thickest, 2 / layers + 1e-6) << layers;
    }
}

// Only one layer's lower end is new or has moved, by half a layer at most for a whole layer more.
TEST(LayerTop, MovesOneLayerAtATime) {
    const double step = 1.0 / 64;
    for (double layers = 1; layers < 64; layers += step) {
        const std::vector<double> before = tops(layers), after = tops(layers + step);
        // What of the fur changed hands: ends that are not in the other list, and how near the next one there is.
        int moved = 0;
        double farthest = 0;
        for (const double top : after) {
            double nearest = 1;
            for (const double other : before) nearest = std::min(nearest, std::abs(other - top));
            moved += nearest > 0;
            farthest = std::max(farthest, nearest);
        }
        EXPECT_EQ(moved, 1) << layers;
        EXPECT_LT(farthest, step / layers + 1e-6) << layers;
    }
}

}  // namespace
}  // namespace relievo
