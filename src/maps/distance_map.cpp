#include "maps/distance_map.h"

#include "core/parallel_for.h"
#include "maps/distance_sites.h"

#include <algorithm>
#include <vector>

// The nearest point of a column {z' <= h(x)} is |x - p| away across and max(0, z - h(x)) down, so for one slice z
//   d(p)^2 = min over x of |x - p|^2 + max(0, z - h(x))^2,
// a transform of a sampled function that is separable along u and v (Felzenszwalb, Huttenlocher 2012), if x runs over a lattice.
// It runs over all points, and two lemmas (distance_sites.cpp) make a lattice do, as a lower bound that is off by second order only.

namespace relievo {

namespace {

// One slice's transform: in place of w values a pass takes, at most so far away as can still matter,
//   out[i] = min over k of in[i + k] + (k side)^2.
// Plain windows instead of lower envelopes of parabolas: distances in a relief are short, the loops run in vector registers, and no
// division rounds.
class Slice {
public:
    explicit Slice(const DistanceSites& sites)
        : sites_(sites), a_(sites.side_u), b_(sites.side_v), width_(sites.heights.width), height_(sites.heights.height), across_(size()), padded_(static_cast<std::size_t>(3 * width_)) {}

    // Writes the stored values of slice z.
    void run(float z, float* out) {
        for (int j = 0; j < height_; ++j) along_row(z, j);
        lowest_ = *std::ranges::min_element(across_);
        row_.resize(static_cast<std::size_t>(width_));
        for (int j = 0; j < height_; ++j) {
            along_column(j);
            float* to = out + static_cast<std::size_t>(j) * static_cast<std::size_t>(width_);
            for (int i = 0; i < width_; ++i) to[i] = stored_distance(row_[static_cast<std::size_t>(i)], sites_.diagonal2);
        }
    }

private:
    std::size_t size() const { return static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_); }

    static void lower(float* out, const float* left, const float* right, float add, int count) {
        for (int i = 0; i < count; ++i) {
            const float l = left[i] + add;
            const float r = right[i] + add;
            const float nearer = l < r ? l : r;
            out[i] = nearer < out[i] ? nearer : out[i];
        }
    }

    // Whether sites `away` off, which hold at least `least`, can still lower something; the highest value is looked up now and then.
    static bool matters(const float* out, int count, float away, float least, int k, float& highest) {
        if (k % 4 == 1) highest = *std::max_element(out, out + count);
        return away + least < highest;
    }

    void along_row(float z, int j) {
        const float* heights = sites_.heights.at(0, j);
        const float* correction = sites_.correction.at(0, j);
        float* middle = padded_.data() + width_;
        float least = 1e30f;
        for (int i = 0; i < width_; ++i) {
            const float down = std::max(0.0f, z - heights[i]);
            middle[i] = down * down - correction[i];
            least = std::min(least, middle[i]);
        }
        std::copy_n(middle, width_, middle - width_);
        std::copy_n(middle, width_, middle + width_);
        float* out = across_.data() + static_cast<std::size_t>(j) * static_cast<std::size_t>(width_);
        std::copy_n(middle, width_, out);
        float highest = 0;
        for (int k = 1; k <= width_ / 2; ++k) {  // farther ones have a nearer repeat
            const float away = (static_cast<float>(k) * a_) * (static_cast<float>(k) * a_);
            if (!matters(out, width_, away, least, k, highest)) break;
            lower(out, middle - k, middle + k, away, width_);
        }
    }

    void along_column(int j) {
        const auto row = [&](int y) { return across_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_); };
        std::copy_n(row(j), width_, row_.data());
        float highest = 0;
        for (int k = 1; k <= height_ / 2; ++k) {
            const float away = (static_cast<float>(k) * b_) * (static_cast<float>(k) * b_);
            if (!matters(row_.data(), width_, away, lowest_, k, highest)) break;
            lower(row_.data(), row(wrap_index(j - k, height_)), row(wrap_index(j + k, height_)), away, width_);
        }
    }

    const DistanceSites& sites_;
    float a_, b_;
    int width_, height_;
    std::vector<float> across_;  // after the pass along u
    std::vector<float> padded_;  // a row three times
    std::vector<float> row_;
    float lowest_ = 0;
};

}  // namespace

ImageF distance_map(const HeightField& field, float height_scale, int threads, const Progress& progress) {
    const DistanceSites sites = distance_sites(field, height_scale);
    const int height = sites.heights.height;
    ImageF map(sites.heights.width, height * distance_slices, 1);
    parallel_for(distance_slices, 1, threads, [&](int begin, int end) {
        Slice slice(sites);
        for (int k = begin; k < end; ++k) slice.run(static_cast<float>(k) * sites.side_z, map.at(0, k * height));
    }, progress, "distance map");
    return map;
}

}  // namespace relievo
