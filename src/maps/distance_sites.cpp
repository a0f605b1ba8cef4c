#include "maps/distance_sites.h"

#include "core/map_set.h"

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

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

void raise_and_correct(DistanceSites& sites, const ImageF& lattice) {
    const float a = sites.side_u;
    const float b = sites.side_v;
    sites.heights = lattice;
    sites.correction = ImageF(lattice.width, lattice.height, 1, 0.0f);
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
}

}  // namespace

DistanceSites distance_sites(const HeightField& field, float height_scale) {
    assert(height_scale >= 0);
    const int width = std::min(field.width(), most_voxels);
    const int height = std::min(field.height(), most_voxels);
    const float u = 1.0f / static_cast<float>(width);
    const float v = 1.0f / static_cast<float>(height);
    const float scale = std::max(height_scale, 8 * std::max(u, v));
    DistanceSites sites{.heights = {}, .correction = {}, .side_u = u / scale, .side_v = v / scale, .side_z = 1.0f / static_cast<float>(distance_slices - 1)};
    sites.diagonal2 = sites.side_u * sites.side_u + sites.side_v * sites.side_v + sites.side_z * sites.side_z;
    raise_and_correct(sites, lattice_heights(field, width, height));
    return sites;
}

}  // namespace relievo
