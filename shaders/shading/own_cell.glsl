// Where a ray to the light is clear of the bilinear cell that it starts in. The first root of the cell's patch along that ray is the hit
// itself; solving for the second needs no epsilon, which would light the first of every shadow's foot.
#ifndef RELIEVO_SHADING_OWN_CELL
#define RELIEVO_SHADING_OWN_CELL

#include "../surface/maps.glsl"

// Heights that the ray climbs until it leaves the hit's cell; negative where it meets the patch again before, or sinks into it at once.
// uv_per_height: of the ray, UV per height climbed. One fetch. The hit has to lie on the surface, to float rounding.
float climb_out_of_cell(SurfaceHit hit, vec2 uv_per_height) {
    ivec2 size = height_size();
    vec2 texels = vec2(float(size.x), float(size.y));
    vec2 at = vec2(hit.uv.x * texels.x - 0.5f, hit.uv.y * texels.y - 0.5f);
    vec2 cell = vec2(floor(at.x), floor(at.y));
    vec2 inside = vec2(at.x - cell.x, at.y - cell.y);
    vec2 pace = vec2(uv_per_height.x * texels.x, uv_per_height.y * texels.y);
    vec4 c = height_cell(vec2((cell.x + 1.0f) / float(size.x), (cell.y + 1.0f) / float(size.y)));
    float climb = min(abs(pace.x) > 1e-6f ? (pace.x > 0.0f ? 1.0f - inside.x : inside.x) / abs(pace.x) : 1e9f,
                      abs(pace.y) > 1e-6f ? (pace.y > 0.0f ? 1.0f - inside.y : inside.y) / abs(pace.y) : 1e9f);
    // The patch's gap to the ray t heights up: (slope - 1) t + bend t^2, 0 in the hit.
    float twist = (c.x - c.y) - (c.z - c.w);
    float slope = pace.x * ((c.y - c.x) + twist * inside.y) + pace.y * ((c.z - c.x) + twist * inside.x);
    float bend = twist * pace.x * pace.y;
    bool sinks = slope > 1.0f;
    bool returns = (slope - 1.0f) + bend * climb > 0.0f;
    return sinks || returns ? -1.0f : climb;
}

#endif
