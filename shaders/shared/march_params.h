// The knobs of the height-field family, as the GPU receives them. Their ranges, units and help stand in techniques/knobs.h.
#ifndef RELIEVO_SHARED_MARCH_PARAMS_H
#define RELIEVO_SHARED_MARCH_PARAMS_H

struct MarchParams {
    int max_steps;      // steps of the first search, or visited nodes of a hierarchical one
    int min_steps;      // the same where the view is steepest, for searches that adapt to the angle
    int refine_steps;   // refinements of the bracketed interval: halvings, secants, or searches in shorter steps
    int contact_steps;  // shorter steps into which a step that met the surface is cut
    int iterations;     // repetitions of a parallax estimate
    float tolerance;    // height difference at which a search counts as arrived
};

#endif
