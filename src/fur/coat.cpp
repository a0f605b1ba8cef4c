#include "fur/coat.h"

namespace relievo {

namespace {

constexpr CoatPreset presets[] = {
    {"rabbit", "soft, dense, medium long, agouti", {}},
    {"velvet",
     "short, upright, even",
     {.strands = 400000, .length = 0.025f, .tilt = 0.25f, .bend = 0.35f, .spread = 0.05f, .width = 0.36f, .length_variation = 0.2f, .lock = 0.15f, .lock_size = 0.15f,
      .root_colour = {0.10f, 0.015f, 0.02f}, .tip_colour = {0.38f, 0.05f, 0.07f}, .colour_variation = 0.12f, .countershade = 0, .gloss = 0.9f, .guard_hairs = 0, .softness = 0.05f, .beat = 12}},
    {"fox",
     "long guard hairs over a dense undercoat, red with a light belly",
     {.strands = 160000, .length = 0.16f, .tilt = 0.75f, .bend = 0.55f, .spread = 0.02f, .width = 0.28f, .length_variation = 0.55f, .lock = 0.3f, .lock_size = 0.11f,
      .root_colour = {0.16f, 0.06f, 0.025f}, .tip_colour = {0.62f, 0.24f, 0.07f}, .colour_variation = 0.3f, .countershade = 0.8f, .gloss = 0.5f, .guard_hairs = 0.15f, .softness = 0.5f, .beat = 2}},
    {"sheep",
     "long thick curls, wool white",
     {.strands = 40000, .length = 0.11f, .tilt = 0.2f, .bend = 0.5f, .spread = 0.01f, .width = 0.38f, .taper = 0.8f, .length_variation = 0.25f, .lock = 0.4f, .lock_size = 0.06f,
      .curl_radius = 1, .curl_turns = 3, .root_colour = {0.42f, 0.36f, 0.28f}, .tip_colour = {0.72f, 0.67f, 0.58f}, .colour_variation = 0.08f, .countershade = 0, .gloss = 0.12f,
      .guard_hairs = 0, .softness = 0.15f, .beat = 3}},
    {"otter",
     "wet: pointed locks lying flat, dark and shining",
     {.strands = 150000, .length = 0.07f, .tilt = 1.0f, .bend = 0.3f, .spread = 0.015f, .width = 0.26f, .length_variation = 0.3f, .lock = 0.32f, .lock_size = 0.05f,
      .root_colour = {0.05f, 0.03f, 0.02f}, .tip_colour = {0.15f, 0.09f, 0.055f}, .colour_variation = 0.15f, .countershade = 0.5f, .gloss = 0.8f, .guard_hairs = 0.2f, .softness = 0.1f, .beat = 5, .damping = 0.7f}},
    {"porcupine",
     "stiff, sparse, thick quills, dark with white ones between",
     {.strands = 9000, .length = 0.22f, .tilt = 0.75f, .bend = 0.15f, .spread = 0.04f, .width = 0.1f, .taper = 0.7f, .length_variation = 0.5f, .lock = 0.1f, .lock_size = 0.2f,
      .root_colour = {0.03f, 0.025f, 0.02f}, .tip_colour = {0.11f, 0.09f, 0.065f}, .colour_variation = 0.3f, .grizzle = 0.3f, .countershade = 0, .gloss = 0.8f, .guard_hairs = 0.3f, .softness = 0.03f, .beat = 7, .damping = 0.1f}},
};

constexpr CoatKnob knobs[] = {
    {"strands", &Coat::strands, 100, 4e6f, "strands on the whole mesh"},
    {"length", &Coat::length, 0.002f, 0.5f, "of the longest strand, in radii of the mesh's smallest sphere"},
    {"tilt", &Coat::tilt, 0, 1.3f, "angle from the normal at the root, radians"},
    {"bend", &Coat::bend, 0, 1.3f, "what is added to it up to the tip, radians"},
    {"spread", &Coat::spread, 0, 0.3f, "by which single strands leave the common direction, in lengths at the tip"},
    {"width", &Coat::width, 0.02f, 0.8f, "radius at the root, in mean distances between roots"},
    {"taper", &Coat::taper, 0, 1, "from a cone (0) to a thread that is pointed at its very end (1)"},
    {"length_variation", &Coat::length_variation, 0, 0.95f, "the shortest strand lacks this share of the longest"},
    {"lock", &Coat::lock, 0, 0.6f, "how far locks sway at the tip, in lengths"},
    {"lock_size", &Coat::lock_size, 0.01f, 1, "of a lock, in radii"},
    {"curl_radius", &Coat::curl_radius, 0, 1, "of each strand's helix, in mean distances between roots"},
    {"curl_turns", &Coat::curl_turns, 0, 8, "of the helix from root to tip"},
    {"colour_variation", &Coat::colour_variation, 0, 1, "from strand to strand, share"},
    {"grizzle", &Coat::grizzle, 0, 1, "share of strands that are white"},
    {"countershade", &Coat::countershade, 0, 1, "how much lighter what looks down is"},
    {"gloss", &Coat::gloss, 0, 4, "strength of the highlights"},
    {"guard_hairs", &Coat::guard_hairs, 0, 1, "share of strands that are thicker and of full length"},
    {"softness", &Coat::softness, 0, 3, "angle at which a pull as strong as gravity holds the longest strand's tip, radians"},
    {"beat", &Coat::beat, 0.2f, 20, "at which that strand swings when let go, a second"},
    {"damping", &Coat::damping, 0, 2, "of its swing; 1: it comes back without swinging"},
};

}  // namespace

std::span<const CoatPreset> coat_presets() { return presets; }
std::span<const CoatKnob> coat_knobs() { return knobs; }

}  // namespace relievo
