// What a coat of fur is like: a row of numbers, and the table of coats that are known by name.
#pragma once

#include "core/vec.h"

#include <span>
#include <string_view>

namespace relievo {

// Lengths are in radii of the mesh's smallest sphere unless said otherwise.
struct Coat {
    float strands = 200000;        // on the whole mesh
    float length = 0.09f;          // of the longest strand
    float tilt = 0.7f;             // angle from the normal at the root, radians
    float bend = 0.6f;             // what is added to it up to the tip, radians
    float spread = 0.02f;          // by which single strands leave the common direction, in lengths at the tip
    float width = 0.3f;            // radius at the root, in mean distances between roots
    float taper = 0.5f;            // from a cone (0) to a thread that is pointed at its very end (1)
    float length_variation = 0.5f; // the shortest strand lacks this share of the longest
    float lock = 0.25f;            // how far locks sway at the tip, in lengths
    float lock_size = 0.06f;       // of a lock
    float curl_radius = 0;         // of each strand's helix, in mean distances between roots
    float curl_turns = 0;          // from root to tip
    Vec3f root_colour{0.2f, 0.15f, 0.1f};  // linear albedo
    Vec3f tip_colour{0.5f, 0.4f, 0.3f};
    float colour_variation = 0.25f;  // from strand to strand, share
    float grizzle = 0;               // share of strands that are white
    float countershade = 0.3f;       // how much lighter what looks down is
    float gloss = 0.4f;              // strength of the highlights
    float guard_hairs = 0.1f;        // share of strands that are 1.6 times as thick and of full length
    float softness = 0.35f;          // angle at which a pull as strong as gravity, across it, holds the longest strand's tip, radians
    float beat = 3;                  // at which it swings when let go, a second
    float damping = 0.25f;           // 1: it comes back without swinging
};

// The angle from the normal at which fully combed strands stand in the mean, radians.
constexpr float mean_lean(const Coat& coat) { return coat.tilt + coat.bend / 2; }

struct CoatPreset {
    std::string_view id;
    std::string_view summary;
    Coat coat;
};

// The first is the one taken where none is named.
std::span<const CoatPreset> coat_presets();

// A number of a coat as options and help know it.
struct CoatKnob {
    std::string_view id;
    float Coat::*member;
    float least, most;
    std::string_view help;
};
std::span<const CoatKnob> coat_knobs();

}  // namespace relievo
