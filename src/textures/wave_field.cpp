#include "textures/wave_field.h"

#include "textures/curves.h"
#include "textures/hash.h"

namespace relievo {

WaveField::WaveField(int cells, const std::function<float(Vec2f)>& phase, float disorder, std::uint32_t seed) : cells_(cells) {
    const float cell = 1.0f / static_cast<float>(cells);
    wavelets_.reserve(static_cast<std::size_t>(cells) * static_cast<std::size_t>(cells));
    for (int j = 0; j < cells; ++j) {
        for (int i = 0; i < cells; ++i) {
            Dice dice(hash(seed, static_cast<std::uint32_t>(j * cells + i)));
            Wavelet w;
            w.centre = {dice.roll(), dice.roll()};
            const Vec2f uv = (Vec2f{static_cast<float>(i), static_cast<float>(j)} + w.centre) * cell;
            const float e = 0.25f * cell;
            // Central differences of the phase, in turns per cell.
            w.wave =
                Vec2f{phase(uv + Vec2f{e, 0}) - phase(uv - Vec2f{e, 0}), phase(uv + Vec2f{0, e}) - phase(uv - Vec2f{0, e})} * 2.0f;
            w.phase = phase(uv) + dice.roll(-disorder, disorder);
            wavelets_.push_back(w);
        }
    }
}

float WaveField::at(Vec2f uv) const {
    const Vec2f p = uv * static_cast<float>(cells_);
    const int i0 = floor_index(p.x);
    const int j0 = floor_index(p.y);
    float sum = 0;
    float windows = 1e-6f;
    for (int j = j0 - 1; j <= j0 + 1; ++j) {
        for (int i = i0 - 1; i <= i0 + 1; ++i) {
            const auto index = static_cast<std::size_t>(lattice_index(j, cells_) * cells_ + lattice_index(i, cells_));
            const Wavelet& w = wavelets_[index];
            const Vec2f d = p - Vec2f{static_cast<float>(i), static_cast<float>(j)} - w.centre;
            // The window ends where a wavelet could fall outside the 3 x 3 cells that are looked at.
            const float closeness = 1 - dot(d, d);
            if (closeness <= 0) continue;
            const float window = closeness * closeness;
            sum += window * cos_turns(dot(w.wave, d) + w.phase);
            windows += window;
        }
    }
    return sum / windows;
}

}  // namespace relievo
