// The fur family's question and answer, fixed before its first technique so that the height-field family does not shape the
// catalogue alone. A shell technique is  ShellSample name(ShellPoint point, ShellParams params).
#ifndef RELIEVO_SHARED_SHELLS_H
#define RELIEVO_SHARED_SHELLS_H

// A point on one extruded layer of a mesh, object space.
struct ShellPoint {
    vec3 position;     // on the layer
    vec3 base;         // the surface point under it, along the extrusion
    vec3 normal;       // unit, of the base
    vec3 view;         // unit, toward the eye
    float level;       // height in the fur: 0 at the skin, 1 at the longest tip
    float fur_height;  // length of the longest strand, object units
    float footprint;   // width of a pixel on the layer, object units: coverage is averaged over it
};

// What that point of the layer shows.
struct ShellSample {
    vec3 tangent;    // unit, along the strand
    vec3 albedo;     // linear RGB
    float coverage;  // share of the pixel covered by strands, [0,1]
    float occlusion; // share of ambient light that reaches it, [0,1]
};

struct ShellParams {
    int layers;
    float density;    // strands per square object unit
    float thickness;  // strand radius at the root, as a share of the mean root spacing
    float curl;
    float clump;
};

#endif
