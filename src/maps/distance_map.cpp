#include "maps/distance_map.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

// The nearest point of a column {z' <= h(x)} is |x - p| away across and max(0, z - h(x)) down, so for one slice z
//   d(p)^2 = min over x of |x - p|^2 + max(0, z - h(x))^2,
// a transform of a sampled function that is separable along u and v (Felzenszwalb, Huttenlocher 2012), if x runs over a lattice.
// It runs over all points, and the two lemmas below make a lattice do, as a lower bound that is off by second order only.
//
// Lemma 1, sites. Let x lie in a cell with corners x_i, heights h_i and bilinear weights w_i. The mean of squared distances exceeds
// that of the mean point by the variance:  sum w_i |x_i - p|^2 = |x - p|^2 + variance of x_i <= ... + (a^2 + b^2) / 4, a and b the
// cell's sides; and  sum w_i max(0, z - h_i)^2 <= max(0, z - h)^2 + (h_max - h_min)^2 / 4. Some corner is not above the mean, so
//   d(p)^2 >= min_i (|x_i - p|^2 + max(0, z - h_i)^2) - c^2,   c^2 = (a^2 + b^2 + (h_max - h_min)^2) / 4.
// In steep cells c is long; there the corners are raised to h_max instead, which for points of the lattice is the distance to the
// box under h_max: off by at most a cell across, whatever the slope.
//
// Lemma 2, reading. d^2 - |p|^2 is a minimum of linear functions, hence concave; so trilinear blending I of values at corners p_i obeys
//   I[d^2](p) <= d(p)^2 + (a^2 + b^2 + c_z^2) / 4 = d(p)^2 + D / 4.
// With an increasing concave f, I[f(d^2)] <= f(I[d^2]) <= f(d^2 + D/4) (Jensen), which is at most d if f(t + D/4) <= sqrt(t):
//   f(t) = sqrt(t - D/4) for t >= D/2, and below the line through (D/4, 0) that meets it there.

namespace relievo {

namespace {

constexpr int most_voxels = 512;

// Devices may keep 8 bits of a filter's weights (VkPhysicalDeviceLimits::subTexelPrecisionBits), so that they read up to 1/512 of a
// voxel aside, along each axis; d grows by at most the way.
constexpr float filter_slack = 1.0f / 256;

// Heights at the voxels' corners in u and v whose bilinear surface is nowhere below the field: the field's own where there is a voxel
// for every texel, else raised by what the field rises above the coarser surface in the cells around.
ImageF lattice_heights(const HeightField& field, int width, int height) {
    ImageF lattice(width, height, 1);
    if (width == field.width() && height == field.height()) return field.texels;
    const double per_x = static_cast<double>(field.width()) / width;
    const double per_y = static_cast<double>(field.height()) / height;
    const auto at = [&](double x, double y) {  // in texels, 0 at the first one's centre
        return field.sample({(x + 0.5) / field.width(), (y + 0.5) / field.height()});
    };
    ImageF excess(width, height, 1);  // of cell [i, i+1] x [j, j+1]
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) lattice(i, j) = static_cast<float>(at((i + 0.5) * per_x - 0.5, (j + 0.5) * per_y - 0.5));
    // Between lines of either lattice both surfaces are bilinear, so their difference is largest where lines cross.
    const auto lines = [](int i, double per) {
        const double first = (i + 0.5) * per - 0.5;
        std::vector<double> found{first};
        for (double line = std::floor(first) + 1; line < first + per; line += 1) found.push_back(line);
        found.push_back(first + per);
        return found;
    };
    for (int j = 0; j < height; ++j) {
        const auto ys = lines(j, per_y);
        const int j1 = j + 1 == height ? 0 : j + 1;
        for (int i = 0; i < width; ++i) {
            const auto xs = lines(i, per_x);
            const int i1 = i + 1 == width ? 0 : i + 1;
            double most = 0;
            for (const double y : ys) {
                const double fy = (y - ys.front()) / per_y;
                for (const double x : xs) {
                    const double fx = (x - xs.front()) / per_x;
                    const double low = std::lerp(static_cast<double>(lattice(i, j)), static_cast<double>(lattice(i1, j)), fx);
                    const double high = std::lerp(static_cast<double>(lattice(i, j1)), static_cast<double>(lattice(i1, j1)), fx);
                    most = std::max(most, at(x, y) - std::lerp(low, high, fy));
                }
            }
            excess(i, j) = static_cast<float>(most) + 1e-6f;
        }
    }
    ImageF raised = lattice;
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
            const int i0 = i > 0 ? i - 1 : width - 1;
            const int j0 = j > 0 ? j - 1 : height - 1;
            raised(i, j) += std::max(std::max(excess(i, j), excess(i0, j)), std::max(excess(i, j0), excess(i0, j0)));
        }
    return raised;
}

struct Sites {
    ImageF heights;     // raised where cells are steep
    ImageF correction;  // c^2 of lemma 1
};

// a, b: a voxel's sides, in heights.
Sites sites_of(const ImageF& lattice, float a, float b) {
    Sites sites{.heights = lattice, .correction = ImageF(lattice.width, lattice.height, 1, 0.0f)};
    // Where a cell rises by more than twice its diagonal, c exceeds a cell and the box is nearer the truth.
    const float steep2 = 4 * (a * a + b * b);
    for (int j = 0; j < lattice.height; ++j) {
        const int j1 = j + 1 == lattice.height ? 0 : j + 1;
        for (int i = 0; i < lattice.width; ++i) {
            const int i1 = i + 1 == lattice.width ? 0 : i + 1;
            const auto [low, high] = std::minmax({lattice(i, j), lattice(i1, j), lattice(i, j1), lattice(i1, j1)});
            const float rise2 = (high - low) * (high - low);
            const float c2 = (a * a + b * b + rise2) / 4;
            for (const auto& [x, y] : {std::pair{i, j}, {i1, j}, {i, j1}, {i1, j1}}) {
                if (rise2 > steep2) {
                    sites.heights(x, y) = std::max(sites.heights(x, y), high);
                } else {
                    sites.correction(x, y) = std::max(sites.correction(x, y), c2);
                }
            }
        }
    }
    return sites;
}

// f of lemma 2, less what rounding and filters may add, rounded down to a half float (10 bits of fraction, no subnormals).
float stored(float squared, float diagonal2) {
    const float quarter = diagonal2 / 4;
    const float diagonal = std::sqrt(diagonal2);
    const float value = squared >= 2 * quarter ? std::sqrt(squared - quarter) : (squared - quarter) / (0.5f * diagonal);
    const float low = value - diagonal * filter_slack - 1e-6f;
    if (std::abs(low) < 0x1p-14f) return low < 0 ? -0x1p-14f : 0.0f;
    std::uint32_t bits = std::bit_cast<std::uint32_t>(low);
    if (low < 0) bits += 0x1fffu;  // away from zero
    return std::bit_cast<float>(bits & ~0x1fffu);
}

// One slice's transform: in place of w values a pass takes, at most so far away as can still matter,
//   out[i] = min over k of in[i + k] + (k side)^2.
// Plain windows instead of lower envelopes of parabolas: distances in a relief are short, the loops run in vector registers, and no
// division rounds.
class Slice {
public:
    Slice(const Sites& sites, float a, float b)
        : sites_(sites), a_(a), b_(b), width_(sites.heights.width), height_(sites.heights.height), across_(size()), padded_(static_cast<std::size_t>(3 * width_)) {}

    // Writes the stored values of slice z.
    void run(float z, float diagonal2, float* out) {
        for (int j = 0; j < height_; ++j) along_row(z, j);
        lowest_ = *std::ranges::min_element(across_);
        row_.resize(static_cast<std::size_t>(width_));
        for (int j = 0; j < height_; ++j) {
            along_column(j);
            float* to = out + static_cast<std::size_t>(j) * static_cast<std::size_t>(width_);
            for (int i = 0; i < width_; ++i) to[i] = stored(row_[static_cast<std::size_t>(i)], diagonal2);
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

    const Sites& sites_;
    float a_, b_;
    int width_, height_;
    std::vector<float> across_;  // after the pass along u
    std::vector<float> padded_;  // a row three times
    std::vector<float> row_;
    float lowest_ = 0;
};

}  // namespace

ImageF distance_map(const HeightField& field, float height_scale, int threads, const Progress& progress) {
    assert(height_scale >= 0);
    const int width = std::min(field.width(), most_voxels);
    const int height = std::min(field.height(), most_voxels);
    const float side_u = 1.0f / static_cast<float>(width);
    const float side_v = 1.0f / static_cast<float>(height);
    const float scale = std::max(height_scale, 8 * std::max(side_u, side_v));
    const float a = side_u / scale;
    const float b = side_v / scale;
    const float side_z = 1.0f / static_cast<float>(distance_slices - 1);
    const float diagonal2 = a * a + b * b + side_z * side_z;
    const Sites sites = sites_of(lattice_heights(field, width, height), a, b);

    ImageF map(width, height * distance_slices, 1);
    parallel_for(distance_slices, 1, threads, [&](int begin, int end) {
        Slice slice(sites, a, b);
        for (int k = begin; k < end; ++k) slice.run(static_cast<float>(k) * side_z, diagonal2, map.at(0, k * height));
    }, progress, "distance map");
    return map;
}

}  // namespace relievo
