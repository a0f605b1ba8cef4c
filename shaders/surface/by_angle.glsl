// What a view's angle and distance may change before the search begins: how many steps it takes, and how high the relief is.
#ifndef RELIEVO_SURFACE_BY_ANGLE
#define RELIEVO_SURFACE_BY_ANGLE

// Steps of a search at this angle. `cosine` rule: n = n_min + (n_max - n_min) (1 - cos alpha), alpha from the normal (Tatarchuk 2006;
// Mile 2008, 3.6.4). `texel` rule: the ray crosses tan(alpha) * height_scale * resolution texels, and takes a step for each; no
// fewer than n_min, no more than n_max.
int steps_by_angle(int max_steps, float view_z, float texels_per_height, int mode, int least_steps) {
    int steps = max_steps;
    int least = min(least_steps, max_steps);
    if (mode == steps_cosine) {
        steps = least + int(float(max_steps - least) * (1.0f - view_z) + 0.5f);
    } else if (mode == steps_texel) {
        steps = clamp(int(texels_per_height) + 1, least, max_steps);
    }
    return steps;
}

// Share of the relief's amplitude at this angle (Mile 2008, 3.6.4): s_min + (1 - s_min) cos alpha, or 1 - (1 - cos alpha)^k, which
// stays near 1 longer. Both flatten the relief where a search steps over most.
float scale_by_angle(float view_z, int mode, float least_share, float power) {
    float share = 1.0f;
    if (mode == scale_cosine) {
        share = mix(least_share, 1.0f, view_z);
    } else if (mode == scale_power) {
        share = 1.0f - pow(1.0f - clamp(view_z, 0.0f, 1.0f), power);
    }
    return share;
}

// Share of the relief's amplitude that is left where a pixel covers `texels` of them: all of it up to `near`, none from `far` on, where
// the relief is smaller than a pixel and the normals' mip chain shows all there is to see.
float scale_by_footprint(float texels, float near, float far) {
    return clamp((far - texels) / max(far - near, 1e-6f), 0.0f, 1.0f);
}

#endif
