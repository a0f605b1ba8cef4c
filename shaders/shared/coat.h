// Camera, lights and coat as the programs of fur receive them, in fur space: the mesh's smallest sphere is the unit sphere around the
// origin. Scalars only, so that GLSL's and C++'s layouts are the same (render/fur_renderer.cpp asserts it).
#ifndef RELIEVO_SHARED_COAT_H
#define RELIEVO_SHARED_COAT_H

const int tile_px = 32;  // of a picture that strands are plotted into: light is computed in tiles that hold some

struct CoatUniforms {
    float eye_x, eye_y, eye_z;
    float pixel_angle;              // width of a pixel at distance 1
    float key_x, key_y, key_z;      // unit, toward the key light
    float extinction;               // of the key light in the fur, per unit of length
    float rim_x, rim_y, rim_z;      // unit, toward the light behind
    float layers;                   // of shells, growing by degrees: fur/layer_top.glsl
    float fur_length;               // of the longest strand
    float tilt, bend;               // angle from the normal at the root, and what is added up to the tip, radians, where combed fully
    float spread;                   // of single strands, in lengths at the tip
    float width;                    // radius at the root
    float taper;                    // from a cone (0) to a thread that is pointed at its very end (1)
    float length_variation;         // the shortest strand lacks this share of the longest
    float lock, lock_frequency;     // how far locks sway at the tip, in lengths; periods of the noise in a unit
    float curl_radius, curl_turns;  // of the helix of each strand; turns from root to tip
    float reach;                    // no strand is farther from the place it would have without spread and curl
    float cells_per_unit;           // of the grid of roots
    float low_x, low_y, low_z;      // its corner
    int bricks_x, bricks_y, bricks_z;
    float root_r, root_g, root_b;   // linear albedo
    float tip_r, tip_g, tip_b;
    float colour_variation;         // from strand to strand, share
    float grizzle;                  // share of strands that are white
    float countershade;             // how much lighter what looks down is
    float gloss;                    // strength of the highlights
    float sample_shift;             // which of the noise patterns decides on partly covered samples, [0,1)
    float off;                      // how far the layers' mesh may be off the surface on which roots grow
    float guard_hairs;              // share of strands that are twice as thick and never short
    int strands, pieces;            // of plotted strands: how many, and of how many straight pieces each
    int width_px, height_px;        // of the picture they are plotted into
    float thinnest;                 // pixels: what is thinner is plotted this wide, and fewer
};

#endif
