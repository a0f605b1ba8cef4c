#include "textures/noise.h"

#include "textures/curves.h"
#include "textures/hash.h"

namespace relievo {

namespace {

// Sixteen directions: eight leave visible diagonals when the noise is used as a height.
constexpr Vec2f gradients[16] = {
    {0.98078528f, 0.19509032f},   {0.83146961f, 0.55557023f},   {0.55557023f, 0.83146961f},   {0.19509032f, 0.98078528f},
    {-0.19509032f, 0.98078528f},  {-0.55557023f, 0.83146961f},  {-0.83146961f, 0.55557023f},  {-0.98078528f, 0.19509032f},
    {-0.98078528f, -0.19509032f}, {-0.83146961f, -0.55557023f}, {-0.55557023f, -0.83146961f}, {-0.19509032f, -0.98078528f},
    {0.19509032f, -0.98078528f},  {0.55557023f, -0.83146961f},  {0.83146961f, -0.55557023f},  {0.98078528f, -0.19509032f},
};

constexpr float fade(float t) { return t * t * t * (t * (t * 6 - 15) + 10); }

// The gradient at column i of a hashed row, dotted with the way from there. Only four bits of hash are needed, and the upper bits
// of a product are its well mixed ones: two multiplications do where a full scramble takes four times as long.
constexpr std::uint32_t column_step = 0x9e3779b1u;
float corner(std::uint32_t row, std::uint32_t column, float x, float y) {
    const Vec2f g = gradients[((row ^ column) * 0x85ebca6bu) >> 28];
    return g.x * x + g.y * y;
}

}  // namespace

float gradient_noise(Vec2f uv, int cells_u, int cells_v, std::uint32_t seed) {
    const float x = uv.x * static_cast<float>(cells_u);
    const float y = uv.y * static_cast<float>(cells_v);
    const int i = floor_index(x);
    const int j = floor_index(y);
    const float dx = x - static_cast<float>(i);
    const float dy = y - static_cast<float>(j);
    const int i0 = lattice_index(i, cells_u);
    const int j0 = lattice_index(j, cells_v);
    const int i1 = i0 + 1 == cells_u ? 0 : i0 + 1;
    const int j1 = j0 + 1 == cells_v ? 0 : j0 + 1;
    const std::uint32_t row0 = scramble(seed + static_cast<std::uint32_t>(j0));
    const std::uint32_t row1 = scramble(seed + static_cast<std::uint32_t>(j1));
    const std::uint32_t c0 = static_cast<std::uint32_t>(i0) * column_step;
    const std::uint32_t c1 = static_cast<std::uint32_t>(i1) * column_step;
    const float u = fade(dx);
    const float v = fade(dy);
    const float low = mix(corner(row0, c0, dx, dy), corner(row0, c1, dx - 1, dy), u);
    const float high = mix(corner(row1, c0, dx, dy - 1), corner(row1, c1, dx - 1, dy - 1), u);
    // With unit gradients the extreme, at a cell's centre, is sqrt(1/2).
    return mix(low, high, v) * 1.41421356f;
}

FractalNoise::FractalNoise(FractalSpec spec, const Detail& detail, std::uint32_t salt) {
    float weight = 1;
    float sum = 0;
    for (int k = 0; k < spec.octaves; ++k, weight *= spec.gain) {
        const Octave octave{spec.cells_u << k, spec.cells_v << k, hash(detail.seed, salt * 16u + static_cast<std::uint32_t>(k)),
                            weight};
        sum += weight;
        // A cell of two texels is the raster's limit; the octave is whole from four on.
        const float cell_texels = 1 / (static_cast<float>(std::max(octave.cells_u, octave.cells_v)) * detail.sample_uv);
        const float kept = k == 0 ? std::max(ramp(2, 4, cell_texels), 1e-3f) : ramp(2, 4, cell_texels);
        if (kept <= 0) continue;
        octaves_[static_cast<std::size_t>(count_)] = octave;
        octaves_[static_cast<std::size_t>(count_++)].weight *= kept;
    }
    for (int k = 0; k < count_; ++k) octaves_[static_cast<std::size_t>(k)].weight *= 1.5f / sum;
}

float FractalNoise::operator()(Vec2f uv) const {
    float sum = 0;
    for (int k = 0; k < count_; ++k) {
        const Octave& o = octaves_[static_cast<std::size_t>(k)];
        sum += o.weight * gradient_noise(uv, o.cells_u, o.cells_v, o.seed);
    }
    return sum;
}

float FractalNoise::turbulence(Vec2f uv) const {
    float sum = 0;
    for (int k = 0; k < count_; ++k) {
        const Octave& o = octaves_[static_cast<std::size_t>(k)];
        sum += o.weight * std::abs(gradient_noise(uv, o.cells_u, o.cells_v, o.seed));
    }
    return sum;
}

}  // namespace relievo
