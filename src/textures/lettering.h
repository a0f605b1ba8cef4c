// Roman capitals drawn as strokes of two weights with bracketed serifs, after the proportions of inscriptions.
#pragma once

#include "textures/carving.h"

#include <string_view>
#include <vector>

namespace relievo {

// The letters of the word RELIEVO (E, I, L, O, R, V); others leave a gap. Set in one line about `centre`, `cap_height` tall, UV.
std::vector<Groove> inscription(std::string_view text, Vec2f centre, float cap_height, const Section& section);

}  // namespace relievo
