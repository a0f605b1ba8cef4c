#include "techniques/knobs.h"

#include <algorithm>
#include <cmath>

namespace relievo {

void Knob::set(MarchParams& params, float value) const {
    const float clamped = std::clamp(value, min, max);
    if (const auto* whole = std::get_if<int MarchParams::*>(&member)) {
        params.**whole = static_cast<int>(std::lround(clamped));
    } else {
        params.*std::get<float MarchParams::*>(member) = clamped;
    }
}

const Knob* find_knob(std::string_view id) {
    const auto it = std::ranges::find(knobs, id, &Knob::id);
    return it == knobs.end() ? nullptr : *it;
}

}  // namespace relievo
