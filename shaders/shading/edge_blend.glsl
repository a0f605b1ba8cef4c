// Edge anti-aliasing inside the search: a pixel whose ray just passed an edge, or just met one, shows something of both sides.
// Mile 2008, 3.6.7, has two forms; both look along one ray only, so edges that run up the screen stay as they are. As published both
// know heights and no pixels, and from near they mix in edges that are many pixels away: worse than nothing. Here neither reaches
// farther than the pixel does.
#ifndef RELIEVO_SHADING_EDGE_BLEND
#define RELIEVO_SHADING_EDGE_BLEND

#include "../surface/chart.glsl"
#include "../surface/exact_height.glsl"
#include "../surface/maps.glsl"
#include "../surface/ray_entry.glsl"

// The other surface that a pixel shows, and how much of the pixel it has.
struct EdgeNeighbour {
    SurfaceHit hit;
    float share;
};

// A pixel as a difference in height. A ray moved by the pixel's footprint in UV changes its gap to the field by footprint /
// |uv_per_height| heights, so a gap measured in this unit is the edge's distance from the pixel's middle.
float pixel_in_heights(SurfaceRay ray) { return exp2(ray.lod) / max(length(ray.uv_per_height), 1e-6f); }

// What a ray meets that goes through the same pixel, so many pixels farther from the eye. What this ray meets if it goes on behind the
// edge would be cheaper, and is wrong where that is a narrow groove: the groove then fills all that the edge leaves of the pixel.
SurfaceHit hit_farther(SurfaceRay ray, float pixels, MarchParams params, float chart) {
    SurfaceRay beside = ray;
    beside.uv = ray.uv - ray.uv_per_height * (pixels * exp2(ray.lod) / max(length(ray.uv_per_height), 1e-6f));
    beside.z_start = 1.0f;
    beside.z_end = 0.0f;
    beside = over_chart(beside, chart);
    SurfaceHit hit;
    hit.uv = beside.uv;
    hit.height = beside.z_end;
    hit.found = false;
    if (beside.z_start > beside.z_end) hit = technique(beside, params);
    if (!on_chart(hit.uv, chart)) hit.found = false;
    return hit;
}

// First form: one step behind the hit the ray is above the field again, so it met an edge; what lies behind gets a share of the pixel
// (published: half). The step is a quarter of a pixel, so that the edge leaves half a pixel to a quarter, and 3/8 in the mean. A thin ridge
// is an edge all over.
EdgeNeighbour edge_behind(SurfaceRay ray, SurfaceHit hit, MarchParams params, float chart) {
    EdgeNeighbour other;
    other.hit = hit;
    other.share = 0.0f;
    float next = hit.height - 0.25f * pixel_in_heights(ray);
    if (next > ray.z_end) {
        if (height_at(uv_at(ray, next)) < next) {
            other.hit = hit_farther(ray, 0.3125f, params, chart);  // the middle of those 3/8
            other.share = 0.375f;
        }
    }
    return other;
}

// Where the ray came nearest above the field before its hit, and the field receded again: (height, gap); a gap of 1 where it never
// did. Samples stand evenly between start and hit; the best is then looked at closer, by halves.
vec2 nearest_pass(SurfaceRay ray, float z_hit, int samples) {
    float dz = (ray.z_start - z_hit) / float(samples + 1);
    vec2 best = vec2(ray.z_start, 1.0f);
    float before = ray.z_start - height_at(uv_at(ray, ray.z_start));
    float z = ray.z_start - dz;
    float gap = z - height_at(uv_at(ray, z));
    for (int i = 1; i < samples; ++i) {
        float z_next = z - dz;
        float next = z_next - height_at(uv_at(ray, z_next));
        if (gap >= 0.0f && gap <= before && gap < next && gap < best.y) best = vec2(z, gap);
        before = gap;
        gap = next;
        z = z_next;
    }
    if (best.y < 1.0f) {
        float half_step = 0.5f * dz;
        for (int i = 0; i < 5; ++i) {
            float below = best.x - half_step;
            float above = best.x + half_step;
            float gap_below = below - height_at(uv_at(ray, below));
            float gap_above = above - height_at(uv_at(ray, above));
            if (gap_below >= 0.0f && gap_below < best.y) best = vec2(below, gap_below);
            if (gap_above >= 0.0f && gap_above < best.y) best = vec2(above, gap_above);
            half_step *= 0.5f;
        }
    }
    return best;
}

// The point of the field under a place of the ray.
SurfaceHit below_ray(SurfaceRay ray, float z) {
    SurfaceHit hit;
    hit.uv = uv_at(ray, z);
    hit.height = exact_height(hit.uv);  // the shadow of an exact technique takes it at its word
    hit.found = true;
    return hit;
}

// Second form: an edge passed within `width` (in heights) gets the more of the pixel the nearer the ray came; half of it when the ray
// touched, as an edge through the pixel's middle has (published: all of it), and nothing beyond half a pixel.
EdgeNeighbour edge_passed(SurfaceRay ray, SurfaceHit hit, float width, int samples) {
    EdgeNeighbour other;
    other.hit = hit;
    other.share = 0.0f;
    vec2 pass = nearest_pass(ray, hit.height, samples);
    float reach = min(width, 0.5f * pixel_in_heights(ray));
    if (pass.y < reach) {
        other.hit = below_ray(ray, pass.x);
        other.share = 0.5f - 0.5f * pass.y / reach;
    }
    return other;
}

// Ours: both sides of the edge, by the pixel's own size: an edge nearer than half a pixel has the rest of that half. The same behind the
// hit, where the deepest the ray dips before it comes out again counts.
EdgeNeighbour edge_covered(SurfaceRay ray, SurfaceHit hit, MarchParams params, float chart, int samples) {
    EdgeNeighbour other;
    other.hit = hit;
    other.share = 0.0f;
    float pixel = pixel_in_heights(ray);
    vec2 pass = nearest_pass(ray, hit.height, samples);
    if (pass.y < 0.5f * pixel) {
        other.hit = below_ray(ray, pass.x);
        other.share = 0.5f - pass.y / pixel;
    } else {
        float dz = 0.5f * pixel / float(8);
        dz = max(dz, (hit.height - ray.z_end) / float(samples));
        float z = hit.height - dz;
        float deepest = 0.0f;
        bool out_again = false;
        for (int i = 0; i < samples && !out_again; ++i) {
            float dip = height_at(uv_at(ray, z)) - z;
            deepest = max(deepest, dip);
            if (dip < 0.0f) out_again = true;
            if (deepest > 0.5f * pixel || z <= ray.z_end) break;
            if (!out_again) z -= dz;
        }
        if (out_again && deepest < 0.5f * pixel && z > ray.z_end) {
            float away = deepest / pixel;
            other.hit = hit_farther(ray, 0.5f * (away + 0.5f), params, chart);  // in the middle of what the edge leaves
            other.share = 0.5f - away;
        }
    }
    return other;
}

// chart: as in surface/chart.glsl.
EdgeNeighbour edge_neighbour(SurfaceRay ray, SurfaceHit hit, MarchParams params, int mode, float width, int samples, float chart) {
    EdgeNeighbour other;
    other.hit = hit;
    other.share = 0.0f;
    if (mode == edge_behind_mode) {
        other = edge_behind(ray, hit, params, chart);
    } else if (mode == edge_passed_mode) {
        other = edge_passed(ray, hit, width, samples);
    } else if (mode == edge_covered_mode) {
        other = edge_covered(ray, hit, params, chart, samples);
    }
    return other;
}

#endif
