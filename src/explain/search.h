// One search on one ray, with every step it took.
#pragma once

#include "core/map_set.h"
#include "techniques/technique.h"

#include <string>
#include <vector>

namespace relievo {

// A view ray as a person asks for it.
struct RayQuestion {
    Vec2d uv;             // where it meets the polygon
    Vec3d view{0, 0, 1};  // unit, tangent space, toward the eye
    float height_scale = 0.05f;
    float zero_level = 1;
    float lod = -16;      // as in SurfaceRay; the finest normals if left alone
};

// What a fetch was for, as far as its place tells: the shader texts do not say.
enum class StepKind {
    sample,    // a height read on the way down the ray
    bisection, // a height read in the middle of the last bracket, the nearest points known above and below the surface
    secant,    // a height read where the straight line between the ends of that bracket meets the ray
    cone,      // an empty cone over a texel
    sphere,    // an empty ball around the point
    node,      // the top of a pyramid's node
    cell,      // the four corners of a cell
    normal,    // the surface's slope
    other,     // another map, at a point of the ray
};

// x runs along the ray's way over the field, in texels from where the ray enters the slab, growing as the ray sinks; z is height.
struct Step {
    StepKind kind = StepKind::sample;
    int number = 0;    // 1 is the first fetch
    double x = 0;      // of the point; of a box, where the ray enters it
    double x_end = 0;  // of a box: where the ray leaves it
    double z = 0;      // of the ray at x
    double value = 0;  // height read; of a box, its top
    double size = 0;   // cone: half-width in texels of the section per unit of height; sphere: radius in heights; node: level;
                       // normal: slope of the section, heights per texel
    bool skipped = false;  // a box that the ray passes over
    bool solved = false;   // a cell whose surface was intersected
};

// A straight line that a search took for the surface in the end: the found hit is where it meets the ray.
struct Chord {
    double x0 = 0, z0 = 0, x1 = 0, z1 = 0;
};

struct SearchPoint {
    double x = 0;  // texels along the section
    double z = 0;  // height
};

struct Search {
    const Technique* technique = nullptr;
    MarchParams params{};
    std::vector<Step> steps;
    std::vector<Chord> chord;  // at most one
    SearchPoint found;         // the texture coordinate it answers, at the height it answers
    bool has_found = false;
    double texels_off = 0;     // from the true hit, signed along the section: positive is late, behind it
    int fetches = 0;
};

// The vertical section of a field along a ray, and what is known of the ray.
struct Section {
    RayQuestion question;
    Vec2d entry_uv;           // where the ray enters the slab, at height 1
    Vec2d uv_per_texel;       // along the section
    double drop_per_texel = 0;  // heights
    SearchPoint truth;        // the exact first hit
    double polygon_x = 0;     // where the ray meets the polygon
    double texels_per_uv = 0; // along the section

    Vec2d uv_at(double x) const { return entry_uv + uv_per_texel * x; }
    double ray_height(double x) const { return 1 - drop_per_texel * x; }
};

// true_uv: of the exact first hit (reference_cast), not wrapped. Throws Error for a ray so steep that it stays over one point of the
// field (less than 1/50 texel of way), where all steps would coincide.
Section section_of(const MapSet& maps, const RayQuestion& question, Vec2d true_uv, double true_height);

// Runs the technique's own text on the ray, on the CPU, with the maps of its row.
Search search_along(const Section& section, const Technique& technique, const MarchParams& params, const MapSet& maps);

}  // namespace relievo
