// What the programs that bake the 3D distance map are told (shaders/hosts/maps/distance_*.comp).
#ifndef RELIEVO_SHARED_DISTANCE_BAKE_H
#define RELIEVO_SHARED_DISTANCE_BAKE_H

struct DistanceStep {
    int width, height;        // voxels of a slice
    int first_slice, slices;  // of this dispatch
    int axis;                 // along which the transform runs: 0 for u, 1 for v
    int lowest_value;         // the first of the values that may be stored, as its number (distance_stored.comp)
    int values;               // how many there are
    float side_z;             // of a voxel, in heights
    float quarter, half_diagonal, slack;  // of what is stored (maps/distance_sites.h)
};

#endif
