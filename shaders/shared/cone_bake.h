// What the program that bakes the cone map is told (shaders/hosts/maps/cone.comp).
#ifndef RELIEVO_SHARED_CONE_BAKE_H
#define RELIEVO_SHARED_CONE_BAKE_H

struct ConeStep {
    int width, height;  // texels
    int first_row;      // of this dispatch
    int levels;         // of the pyramid, the texels among them
};

#endif
