// Explicit rays and their answers in storage buffers: SurfaceRay and SurfaceHit as scalars, so that both sides lay them out alike.
#ifndef RELIEVO_SHARED_CAST_H
#define RELIEVO_SHARED_CAST_H

struct CastRay {
    float u, v;
    float u_per_height, v_per_height;
    float view_x, view_y, view_z;
    float height_scale;
    float zero_level;
    float z_start;
    float z_end;
    float lod;
};

struct CastHit {
    float u, v;
    float height;
    int found;
    int fetches;
};

#endif
