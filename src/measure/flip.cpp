#include "measure/flip.h"

#include "core/error.h"
#include "core/parallel_for.h"
#include "measure/display_values.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace relievo {

namespace {

constexpr double pi = std::numbers::pi;

using Matrix = std::array<std::array<double, 3>, 3>;

// Linear sRGB to CIE XYZ, derived from the primaries and the D65 white (0.3127, 0.3290) of IEC 61966-2-1; the rounding to four
// digits in the standard would already show in the third digit of small errors.
Matrix rgb_to_xyz() {
    return {{{10135552.0 / 24577794.0, 8788810.0 / 24577794.0, 4435075.0 / 24577794.0},
             {2613072.0 / 12288897.0, 8788810.0 / 12288897.0, 887015.0 / 12288897.0},
             {1425312.0 / 73733382.0, 8788810.0 / 73733382.0, 70074185.0 / 73733382.0}}};
}

// Rows divided by their sums: XYZ relative to the white (1,1,1), all that YCxCz and CIELAB need.
Matrix rgb_to_relative_xyz() {
    Matrix m = rgb_to_xyz();
    for (auto& row : m) {
        const double white = row[0] + row[1] + row[2];
        for (double& v : row) v /= white;
    }
    return m;
}

Matrix inverse(const Matrix& m) {
    const auto cofactor = [&](int r, int c) {
        const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
        return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
    };
    const double determinant = m[0][0] * cofactor(0, 0) + m[0][1] * cofactor(0, 1) + m[0][2] * cofactor(0, 2);
    Matrix out;
    for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) out[r][c] = cofactor(c, r) / determinant;
    }
    return out;
}

struct MatrixF {
    float m[3][3];
    explicit MatrixF(const Matrix& from) {
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) m[r][c] = static_cast<float>(from[r][c]);
        }
    }
};

// Half of a one-dimensional kernel, weights[k] for offsets +k and (with the kernel's symmetry) -k.
using HalfKernel = std::vector<float>;

HalfKernel normalised_gaussian(double inverse_two_sigma_squared, int radius) {
    std::vector<double> g(static_cast<std::size_t>(radius) + 1);
    double sum = 0;
    for (int k = 0; k <= radius; ++k) {
        g[k] = std::exp(-inverse_two_sigma_squared * k * k);
        sum += k == 0 ? g[k] : 2 * g[k];
    }
    HalfKernel half;
    for (double v : g) {
        // Weights below a hundred-millionth cannot change a float between 0 and 1; the achromatic filter is half as long without.
        if (v / sum < 1e-8) break;
        half.push_back(static_cast<float>(v / sum));
    }
    return half;
}

// Spatial filtering (section 4.1): contrast sensitivity of the eye as Gaussians in space, g(x) = a sqrt(pi/b) exp(-pi^2 x^2 / b), x in degrees,
// with the paper's constants. The two-dimensional kernel is a function of the distance, so each Gaussian separates; only the
// blue-yellow one is a sum of two, whose shares follow from normalising their sum.
struct ContrastFilters {
    HalfKernel achromatic, red_green, blue_yellow[2];
    float blue_yellow_share[2];
    int radius;  // of the widest

    explicit ContrastFilters(double pixels_per_degree) {
        // Three standard deviations of the widest Gaussian, b = 0.04, for all channels.
        radius = static_cast<int>(std::ceil(3 * std::sqrt(0.04 / (2 * pi * pi)) * pixels_per_degree));
        const auto exponent = [&](double b) { return pi * pi / (b * pixels_per_degree * pixels_per_degree); };
        achromatic = normalised_gaussian(exponent(0.0047), radius);
        red_green = normalised_gaussian(exponent(0.0053), radius);
        const double a[2] = {34.1, 13.5};
        const double b[2] = {0.04, 0.025};
        double volume[2];
        for (int i = 0; i < 2; ++i) {
            blue_yellow[i] = normalised_gaussian(exponent(b[i]), radius);
            double sum = 0;
            for (int k = -radius; k <= radius; ++k) sum += std::exp(-exponent(b[i]) * k * k);
            volume[i] = a[i] * std::sqrt(pi / b[i]) * sum * sum;
        }
        for (int i = 0; i < 2; ++i) blue_yellow_share[i] = static_cast<float>(volume[i] / (volume[0] + volume[1]));
    }
};

// Feature pipeline (section 4.2): edges and points are found by the first and second derivative of a Gaussian, whose positive weights sum to one
// and whose negative weights to minus one. Both factors of exp(-(x^2 + y^2) / (2 sigma^2)) separate.
struct FeatureFilters {
    HalfKernel gaussian, edge /* odd */, point /* even */;
    int radius;

    explicit FeatureFilters(double pixels_per_degree) {
        const double sigma = 0.5 * 0.082 * pixels_per_degree;  // a feature is 0.082 degrees wide
        radius = static_cast<int>(std::ceil(3 * sigma));
        std::vector<double> g, first, second;
        double sum = 0, first_positive = 0, second_positive = 0, second_negative = 0;
        for (int k = 0; k <= radius; ++k) {
            const double twice = k == 0 ? 1 : 2;
            const double value = std::exp(-k * k / (2 * sigma * sigma));
            g.push_back(value);
            first.push_back(k * value);
            second.push_back((k * k / (sigma * sigma) - 1) * value);
            sum += twice * value;
            first_positive += first.back();
            (second.back() > 0 ? second_positive : second_negative) += twice * std::abs(second.back());
        }
        for (int k = 0; k <= radius; ++k) {
            gaussian.push_back(static_cast<float>(g[k] / sum));
            edge.push_back(static_cast<float>(first[k] / first_positive));
            point.push_back(static_cast<float>(second[k] / (second[k] > 0 ? second_positive : second_negative)));
        }
    }
};

enum class Symmetry { even, odd };

// out[x] = sum over k of w[k] * (centre row/column +k  +-  -k). The two neighbours of offset k are given by `ahead` and `behind`,
// so that one loop serves both directions. Sixteen sums at a time stay in registers.
template <Symmetry symmetry, class Ahead, class Behind>
void convolve(const HalfKernel& w, int count, float* out, const Ahead& ahead, const Behind& behind) {
    constexpr int block = 16;
    const int radius = static_cast<int>(w.size()) - 1;
    int x = 0;
    for (; x + block <= count; x += block) {
        float sum[block];
        const float* centre = ahead(0) + x;
        for (int i = 0; i < block; ++i) sum[i] = symmetry == Symmetry::even ? w[0] * centre[i] : 0.0f;
        for (int k = 1; k <= radius; ++k) {
            const float* a = ahead(k) + x;
            const float* b = behind(k) + x;
            const float weight = w[static_cast<std::size_t>(k)];
            for (int i = 0; i < block; ++i) sum[i] += weight * (symmetry == Symmetry::even ? a[i] + b[i] : a[i] - b[i]);
        }
        for (int i = 0; i < block; ++i) out[x + i] = sum[i];
    }
    for (; x < count; ++x) {
        float sum = symmetry == Symmetry::even ? w[0] * ahead(0)[x] : 0.0f;
        for (int k = 1; k <= radius; ++k) {
            const float a = ahead(k)[x];
            const float b = behind(k)[x];
            sum += w[static_cast<std::size_t>(k)] * (symmetry == Symmetry::even ? a + b : a - b);
        }
        out[x] = sum;
    }
}

// Along a row that has `radius` repeated values before and after it.
template <Symmetry symmetry = Symmetry::even>
void convolve_row(const HalfKernel& w, int width, const float* padded_centre, float* out) {
    convolve<symmetry>(w, width, out, [&](int k) { return padded_centre + k; }, [&](int k) { return padded_centre - k; });
}

// Down the column of every x: `row` is the row in question among rows `stride` apart.
template <Symmetry symmetry = Symmetry::even>
void convolve_column(const HalfKernel& w, int width, const float* row, std::ptrdiff_t stride, float* out) {
    convolve<symmetry>(w, width, out, [&](int k) { return row + k * stride; }, [&](int k) { return row - k * stride; });
}

// CIELAB's f.
inline float lab_f(float t) {
    constexpr float delta = 6.0f / 29.0f;
    constexpr float linear_below = delta * delta * delta;
    return t > linear_below ? std::cbrt(t) : t * (1 / (3 * delta * delta)) + 4.0f / 29.0f;
}

// L* and the Hunt-adjusted a*, b* (colours are less colourful where it is dark) of linear RGB.
inline void hunt_lab(const MatrixF& to_xyz, float r, float g, float b, float* lightness, float* a, float* b_out) {
    const float fx = lab_f(to_xyz.m[0][0] * r + to_xyz.m[0][1] * g + to_xyz.m[0][2] * b);
    const float fy = lab_f(to_xyz.m[1][0] * r + to_xyz.m[1][1] * g + to_xyz.m[1][2] * b);
    const float fz = lab_f(to_xyz.m[2][0] * r + to_xyz.m[2][1] * g + to_xyz.m[2][2] * b);
    const float l = 116 * fy - 16;
    *lightness = l;
    *a = 0.01f * l * 500 * (fx - fy);
    *b_out = 0.01f * l * 200 * (fy - fz);
}

// Error redistribution: the exponent q_c makes large HyAB distances count less, then the range up to p_c of the largest possible
// distance (between green and blue) is given p_t of the scale.
struct Redistribution {
    static constexpr double exponent = 0.7, knee_share = 0.4, knee_error = 0.95;
    float knee, below, above;

    explicit Redistribution(const MatrixF& to_xyz) {
        float l1, a1, b1, l2, a2, b2;
        hunt_lab(to_xyz, 0, 1, 0, &l1, &a1, &b1);
        hunt_lab(to_xyz, 0, 0, 1, &l2, &a2, &b2);
        const double largest = std::pow(std::abs(l1 - l2) + std::hypot(a1 - a2, b1 - b2), exponent);
        knee = static_cast<float>(knee_share * largest);
        below = static_cast<float>(knee_error / (knee_share * largest));
        above = static_cast<float>((1 - knee_error) / (largest - knee_share * largest));
    }
    float operator()(float hyab) const {
        const float d = std::pow(hyab, static_cast<float>(exponent));
        return d < knee ? below * d : static_cast<float>(knee_error) + above * (d - knee);
    }
};

// One picture inside one band of rows: everything filtered along the rows, then what one row needs, filtered down the columns.
class BandOfPicture {
public:
    enum Plane { y_csf, cx_csf, cz_wide, cz_narrow, y_gaussian, y_edge, y_point, plane_count };

    BandOfPicture(const ImageF& rgb, const MatrixF& to_xyz, const ContrastFilters& contrast, const FeatureFilters& feature, int first,
                  int last)
        : contrast_(contrast), feature_(feature), width_(rgb.width), halo_(std::max(contrast.radius, feature.radius)), first_(first) {
        stride_ = static_cast<std::ptrdiff_t>(width_) * plane_count;
        const int rows = last - first + 2 * halo_;
        filtered_.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(stride_));
        std::vector<float> padded[3];
        for (auto& p : padded) p.resize(static_cast<std::size_t>(width_ + 2 * halo_));
        for (int i = 0; i < rows; ++i) {
            const int y = std::clamp(first - halo_ + i, 0, rgb.height - 1);
            float* out = filtered_.data() + i * stride_;
            // Repeated rows beyond the border need not be filtered again.
            if (i > 0 && y == std::clamp(first - halo_ + i - 1, 0, rgb.height - 1)) {
                std::copy(out - stride_, out, out);
                continue;
            }
            filter_row(rgb.at(0, y), to_xyz, padded, out);
        }
    }

    struct Row {
        std::vector<float> lightness, a, b;                  // Hunt-adjusted CIELAB of the filtered picture
        std::vector<float> edge_x, edge_y, point_x, point_y;  // features of the unfiltered luminance
        std::vector<float> scratch;
        explicit Row(int width) {
            for (auto* v : {&lightness, &a, &b, &edge_x, &edge_y, &point_x, &point_y, &scratch}) v->resize(static_cast<std::size_t>(width));
        }
    };

    void row(int y, const MatrixF& to_xyz, const MatrixF& to_rgb, Row& out) const {
        const float* base = filtered_.data() + (y - first_ + halo_) * stride_;
        const auto plane = [&](Plane p) { return base + static_cast<std::ptrdiff_t>(p) * width_; };
        float* relative_y = out.lightness.data();
        float* cx = out.a.data();
        float* cz = out.b.data();
        float* narrow = out.scratch.data();
        convolve_column(contrast_.achromatic, width_, plane(y_csf), stride_, relative_y);
        convolve_column(contrast_.red_green, width_, plane(cx_csf), stride_, cx);
        convolve_column(contrast_.blue_yellow[0], width_, plane(cz_wide), stride_, cz);
        convolve_column(contrast_.blue_yellow[1], width_, plane(cz_narrow), stride_, narrow);
        const float wide_share = contrast_.blue_yellow_share[0];
        const float narrow_share = contrast_.blue_yellow_share[1];
        for (int x = 0; x < width_; ++x) {
            const float fy = relative_y[x];
            const float fx = cx[x] + fy;
            const float fz = fy - (wide_share * cz[x] + narrow_share * narrow[x]);
            // Filtering the channels differently can leave the cube of displayable colours.
            const float r = std::clamp(to_rgb.m[0][0] * fx + to_rgb.m[0][1] * fy + to_rgb.m[0][2] * fz, 0.0f, 1.0f);
            const float g = std::clamp(to_rgb.m[1][0] * fx + to_rgb.m[1][1] * fy + to_rgb.m[1][2] * fz, 0.0f, 1.0f);
            const float b = std::clamp(to_rgb.m[2][0] * fx + to_rgb.m[2][1] * fy + to_rgb.m[2][2] * fz, 0.0f, 1.0f);
            hunt_lab(to_xyz, r, g, b, &relative_y[x], &cx[x], &cz[x]);
        }
        convolve_column(feature_.gaussian, width_, plane(y_edge), stride_, out.edge_x.data());
        convolve_column<Symmetry::odd>(feature_.edge, width_, plane(y_gaussian), stride_, out.edge_y.data());
        convolve_column(feature_.gaussian, width_, plane(y_point), stride_, out.point_x.data());
        convolve_column(feature_.point, width_, plane(y_gaussian), stride_, out.point_y.data());
    }

private:
    // The opponent channels Y, Cx, Cz are 116 Y/Yn - 16, 500 (X/Xn - Y/Yn), 200 (Y/Yn - Z/Zn). The filters sum to one, so the
    // factors and the offset, undone after filtering, are left out; Y/Yn is also the luminance that section 4.2 asks for.
    void filter_row(const float* rgb, const MatrixF& to_xyz, std::vector<float> (&padded)[3], float* out) const {
        float* py = padded[0].data() + halo_;
        float* px = padded[1].data() + halo_;
        float* pz = padded[2].data() + halo_;
        for (int x = 0; x < width_; ++x) {
            const float r = rgb[3 * x], g = rgb[3 * x + 1], b = rgb[3 * x + 2];
            const float fx = to_xyz.m[0][0] * r + to_xyz.m[0][1] * g + to_xyz.m[0][2] * b;
            const float fy = to_xyz.m[1][0] * r + to_xyz.m[1][1] * g + to_xyz.m[1][2] * b;
            const float fz = to_xyz.m[2][0] * r + to_xyz.m[2][1] * g + to_xyz.m[2][2] * b;
            py[x] = fy;
            px[x] = fx - fy;
            pz[x] = fy - fz;
        }
        for (float* p : {py, px, pz}) {
            std::fill(p - halo_, p, p[0]);
            std::fill(p + width_, p + width_ + halo_, p[width_ - 1]);
        }
        const auto plane = [&](Plane p) { return out + static_cast<std::ptrdiff_t>(p) * width_; };
        convolve_row(contrast_.achromatic, width_, py, plane(y_csf));
        convolve_row(contrast_.red_green, width_, px, plane(cx_csf));
        convolve_row(contrast_.blue_yellow[0], width_, pz, plane(cz_wide));
        convolve_row(contrast_.blue_yellow[1], width_, pz, plane(cz_narrow));
        convolve_row(feature_.gaussian, width_, py, plane(y_gaussian));
        convolve_row<Symmetry::odd>(feature_.edge, width_, py, plane(y_edge));
        convolve_row(feature_.point, width_, py, plane(y_point));
    }

    const ContrastFilters& contrast_;
    const FeatureFilters& feature_;
    int width_, halo_, first_;
    std::ptrdiff_t stride_;
    std::vector<float> filtered_;  // rows of plane_count planes
};

}  // namespace

FlipResult flip(const ImageF& picture, const ImageF& reference, const FlipSettings& settings) {
    assert(!picture.empty() && picture.width == reference.width && picture.height == reference.height);
    assert(picture.channels == 3 && reference.channels == 3);
    const double ppd = settings.pixels_per_degree;
    if (!(ppd >= 1) || !std::isfinite(ppd)) {
        throw Error("compare", "two pictures by FLIP", "pixels per degree must be a number of at least 1, not " + std::to_string(ppd),
                    "67 is a 0.7 m wide display of 3840 pixels seen from 0.7 m");
    }
    const ImageF a = clamped_to_display(picture, "the picture", settings.threads);
    const ImageF b = clamped_to_display(reference, "the reference", settings.threads);

    const Matrix forward = rgb_to_relative_xyz();
    const MatrixF to_xyz(forward);
    const MatrixF to_rgb(inverse(forward));
    const ContrastFilters contrast(ppd);
    const FeatureFilters feature(ppd);
    const Redistribution redistribute(to_xyz);

    const int width = a.width;
    FlipResult result{.error = ImageF(width, a.height, 1)};
    std::vector<double> sums(static_cast<std::size_t>(a.height), 0.0);
    // Bands of this many rows: enough that the rows filtered twice at their borders cost little, few enough for every core.
    constexpr int band = 48;
    parallel_for(a.height, band, settings.threads, [&](int first, int last) {
        const BandOfPicture band_a(a, to_xyz, contrast, feature, first, last);
        const BandOfPicture band_b(b, to_xyz, contrast, feature, first, last);
        BandOfPicture::Row p(width), q(width);
        for (int y = first; y < last; ++y) {
            band_a.row(y, to_xyz, to_rgb, p);
            band_b.row(y, to_xyz, to_rgb, q);
            double sum = 0;
            for (int i = 0; i < width; ++i) {
                const auto x = static_cast<std::size_t>(i);
                const float da = p.a[x] - q.a[x];
                const float db = p.b[x] - q.b[x];
                const float colour = redistribute(std::abs(p.lightness[x] - q.lightness[x]) + std::sqrt(da * da + db * db));

                const auto magnitude = [x](const std::vector<float>& u, const std::vector<float>& v) {
                    return std::sqrt(u[x] * u[x] + v[x] * v[x]);
                };
                const float edges = std::abs(magnitude(p.edge_x, p.edge_y) - magnitude(q.edge_x, q.edge_y));
                const float points = std::abs(magnitude(p.point_x, p.point_y) - magnitude(q.point_x, q.point_y));
                // Feature difference with q_f = 1/2; the largest magnitude is sqrt(2).
                const float features = std::sqrt(std::max(edges, points) * static_cast<float>(1 / std::numbers::sqrt2));

                // Final difference: features make a colour difference more visible, never visible by themselves.
                const float error = std::clamp(std::pow(colour, 1 - features), 0.0f, 1.0f);
                result.error(i, y) = error;
                sum += static_cast<double>(error);
            }
            sums[static_cast<std::size_t>(y)] = sum;
        }
    });
    result.mean = std::accumulate(sums.begin(), sums.end(), 0.0) / (static_cast<double>(width) * a.height);
    return result;
}

}  // namespace relievo
