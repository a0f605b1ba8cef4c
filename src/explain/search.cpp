#include "explain/search.h"

#include "core/error.h"
#include "core/wrap.h"
#include "explain/box_walk.h"

#include <algorithm>
#include <cmath>
#include <optional>

#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
namespace relievo::glsl {
namespace {
#include "surface/ray_entry.glsl"
}
}  // namespace relievo::glsl
#pragma GCC diagnostic pop

namespace relievo {

namespace {

using glsl::Fetch;

glsl::SurfaceRay surface_ray(const RayQuestion& q) { return glsl::view_ray(glsl::vec2(q.uv), glsl::vec3(q.view), q.height_scale, q.zero_level, q.lod); }

Vec2d size_of(const MapSet& maps) { return {static_cast<double>(maps.height.width()), static_cast<double>(maps.height.height())}; }

// What a point fetch of a map is drawn as; boxes are told by their place.
StepKind kind_at_point(Map map) {
    switch (map) {
        case Map::height: return StepKind::sample;
        case Map::normal: return StepKind::normal;
        case Map::cone:
        case Map::conservative_cone:
        case Map::relaxed_cone:
        case Map::robust_cone: return StepKind::cone;
        case Map::distance: return StepKind::sphere;
        default: return StepKind::other;
    }
}

// The last points known above and below the surface, from height samples in their order.
struct Bracket {
    std::optional<Step> above, below;

    bool whole() const { return above && below; }
    void take(const Step& step) { (step.z > step.value ? above : below) = step; }
    double middle() const { return (above->z + below->z) / 2; }
    // Height at which the straight line between the two surface points meets the ray.
    double crossing() const {
        const double over = above->z - above->value, under = below->value - below->z;
        return above->z + (below->z - above->z) * over / std::max(over + under, 1e-30);
    }
};

// Two heights of one ray are the same point: float rounding along a ray of a few hundred texels, and far below a step.
bool same_height(double a, double b) { return std::abs(a - b) < 2e-5; }

// Samples that halve the bracket or stand on its chord are refinements. Before there is one, only halvings of the whole way are.
void tell_refinements(std::vector<Step>& steps) {
    Bracket bracket;
    double top = 1, floor = 0;  // of the whole way, as halvings alone have narrowed it
    for (Step& step : steps) {
        if (step.kind != StepKind::sample) continue;
        if (bracket.whole()) {
            if (same_height(step.z, bracket.middle())) {
                step.kind = StepKind::bisection;
            } else if (same_height(step.z, bracket.crossing())) {
                step.kind = StepKind::secant;
            }
        } else if (same_height(step.z, (top + floor) / 2)) {
            step.kind = StepKind::bisection;
            (step.z > step.value ? top : floor) = step.z;
        } else {
            top = floor = -1;  // it does not halve
        }
        bracket.take(step);
    }
}

// The straight line that a search ended with, if it took one for the surface to answer where the ray meets it: the level line at
// the last height read, or the chord between two surface points.
std::vector<Chord> last_chord(const std::vector<Step>& steps, SearchPoint found, double found_z) {
    const auto level = std::find_if(steps.rbegin(), steps.rend(), [](const Step& s) { return s.kind == StepKind::sample; });
    if (level != steps.rend() && std::abs(level->value - found.z) < 1e-6 && !same_height(level->z, found.z))
        return {{level->x, level->value, found.x, level->value}};
    Bracket bracket;
    for (const Step& step : steps) {
        if (step.kind != StepKind::sample && step.kind != StepKind::bisection && step.kind != StepKind::secant) continue;
        if (same_height(step.z, found_z)) return {};
        bracket.take(step);
    }
    if (!bracket.whole() || !same_height(bracket.crossing(), found_z)) return {};
    return {{bracket.above->x, bracket.above->value, bracket.below->x, bracket.below->value}};
}

// Makes the step of a cell cone one of the roof that leads farthest, if one leads out of the cell: to the far wall of its square, or
// to where the ray comes down to it.
void take_roof(Step& step, const glsl::vec4& value, const Section& section, const BoxWalk& walk) {
    const std::pair<int, float> roofs[] = {{near_roof_reach, value.y}, {middle_roof_reach, value.z}, {far_roof_reach, value.w}};
    for (const auto& [reach, height] : roofs) {
        const double comes_down = (1 - static_cast<double>(height)) / section.drop_per_texel;
        const double leads_to = std::min(walk.ahead(reach).leave, comes_down);
        if (leads_to <= step.x_end) continue;
        step.x_end = leads_to;
        step.value = height;
        step.skipped = true;
    }
}

}  // namespace

Section section_of(const MapSet& maps, const RayQuestion& question, Vec2d true_uv, double true_height) {
    const glsl::SurfaceRay ray = surface_ray(question);
    const Vec2d size = size_of(maps);
    const Vec2d uv_per_height{ray.uv_per_height};
    const double way = length(uv_per_height * size);  // texels from the top of the slab to its floor
    if (!(way > 0.02))
        throw Error("draw the section of", "this ray", "it looks straight down, so that all steps stand on one line",
                    "take a lower elevation or another pixel");
    Section section;
    section.question = question;
    section.entry_uv = question.uv + uv_per_height * (1.0 - static_cast<double>(question.zero_level));
    section.uv_per_texel = -uv_per_height / way;
    section.drop_per_texel = 1 / way;
    section.texels_per_uv = 1 / length(section.uv_per_texel);
    section.polygon_x = way * (1.0 - static_cast<double>(question.zero_level));
    const Vec2d along = section.uv_per_texel * size;  // unit, in texels
    section.truth = {dot((true_uv - section.entry_uv) * size, along), true_height};
    return section;
}

Search search_along(const Section& section, const Technique& technique, const MarchParams& params, const MapSet& maps) {
    const glsl::SurfaceRay ray = surface_ray(section.question);
    std::vector<Fetch> log;
    glsl::bound_maps = declared_maps(technique, maps);
    glsl::fetch_count = 0;
    glsl::fetch_log = &log;
    const glsl::SurfaceHit hit = technique.heightfield(ray, params);
    glsl::fetch_log = nullptr;
    glsl::bound_maps = {};

    const Vec2d size = size_of(maps);
    const Vec2d along = section.uv_per_texel * size;
    const auto x_of = [&](glsl::vec2 uv) { return dot((Vec2d(uv) - section.entry_uv) * size, along); };

    Search search{.technique = &technique, .params = params, .steps = {}, .chord = {}, .found = {}, .has_found = hit.found, .texels_off = 0, .fetches = glsl::fetch_count};
    BoxWalk walk(section, maps.height.width(), maps.height.height());
    for (const Fetch& f : log) {
        Step step{.kind = kind_at_point(f.map), .number = static_cast<int>(&f - log.data()) + 1};
        if (f.place == Fetch::Place::cell || f.place == Fetch::Place::node) {
            const BoxSpan span = walk.node(f.index, f.level);
            step.kind = f.place == Fetch::Place::cell ? StepKind::cell : StepKind::node;
            step.x = span.enter;
            step.x_end = span.leave;
            step.size = f.level;
            step.value = step.kind == StepKind::cell ? std::max({f.value.x, f.value.y, f.value.z, f.value.w}) : f.value.x;
            step.skipped = section.ray_height(step.x_end) > step.value;
            if (f.map == Map::cell_cone) take_roof(step, f.value, section, walk);
            step.solved = step.kind == StepKind::cell && !step.skipped;
        } else {
            step.x = x_of(f.uv);
            step.value = f.value.x;
            if (step.kind == StepKind::cone) step.size = f.value.y * section.texels_per_uv;
            if (step.kind == StepKind::sphere) step.size = f.value.x;
            if (step.kind == StepKind::normal) {
                // n is upright on the surface: its heights fall by n.s / n.z along a direction s.
                const Vec2d direction = section.uv_per_texel * section.texels_per_uv;
                step.size = -(static_cast<double>(f.value.x) * direction.x + static_cast<double>(f.value.y) * direction.y) /
                            std::max(static_cast<double>(f.value.z), 1e-6) / (static_cast<double>(section.question.height_scale) * section.texels_per_uv);
                step.value = maps.height.sample(Vec2d(f.uv));
            }
        }
        step.z = section.ray_height(step.x);
        search.steps.push_back(step);
    }
    tell_refinements(search.steps);

    search.found = {x_of(hit.uv), hit.height};
    search.texels_off = search.found.x - section.truth.x;
    if (hit.found) search.chord = last_chord(search.steps, search.found, section.ray_height(search.found.x));
    return search;
}

}  // namespace relievo
