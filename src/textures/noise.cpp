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

float corner(std::uint32_t h, float x, float y) {
    const Vec2f g = gradients[h & 15u];
    return g.x * x + g.y * y;
}

}  // namespace

float gradient_noise(Vec2f uv, int cells_u, int cells_v, std::uint32_t seed) {
    const float x = uv.x * static_cast<float>(cells_u);
    const float y = uv.y * static_cast<float>(cells_v);
    const float fx = std::floor(x);
    const float fy = std::floor(y);
    const float dx = x - fx;
    const float dy = y - fy;
    const int i0 = wrap_index(static_cast<int>(fx), cells_u);
    const int j0 = wrap_index(static_cast<int>(fy), cells_v);
    const int i1 = i0 + 1 == cells_u ? 0 : i0 + 1;
    const int j1 = j0 + 1 == cells_v ? 0 : j0 + 1;
    const std::uint32_t row0 = scramble(seed + static_cast<std::uint32_t>(j0));
    const std::uint32_t row1 = scramble(seed + static_cast<std::uint32_t>(j1));
    const auto at = [](std::uint32_t row, int i) { return scramble(row + static_cast<std::uint32_t>(i)); };
    const float u = fade(dx);
    const float v = fade(dy);
    const float low = mix(corner(at(row0, i0), dx, dy), corner(at(row0, i1), dx - 1, dy), u);
    const float high = mix(corner(at(row1, i0), dx, dy - 1), corner(at(row1, i1), dx - 1, dy - 1), u);
    // With unit gradients the extreme, at a cell's centre, is sqrt(1/2).
    return mix(low, high, v) * 1.41421356f;
}

FractalNoise::FractalNoise(FractalSpec spec, const Detail& detail, std::uint32_t salt) {
    float weight = 1;
    float sum = 0;
    for (int k = 0; k < spec.octaves; ++k, weight *= spec.gain) {
        const Octave octave{spec.cells_u << k, spec.cells_v << k, hash(detail.seed, salt * 16u + static_cast<std::uint32_t>(k)), weight};
        sum += weight;
        // A cell of two texels is the raster's limit; the octave is whole from four on.
        const float cell_texels = 1 / (static_cast<float>(std::max(octave.cells_u, octave.cells_v)) * detail.texel_uv);
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
