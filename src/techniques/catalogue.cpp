#include "techniques/catalogue.h"

#include "heightfield_functions.h"  // generated: one declaration per file of shaders/techniques/heightfield

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace relievo {

// The id is the file's name and the function's, so an entry without a file does not compile.
#define SHADER(name) .id = #name, .family = family_of(&heightfield::name), .heightfield = &heightfield::name

namespace {

float share(int steps) { return 1.0f / static_cast<float>(steps); }
float halved(float length, int times) { return std::ldexp(length, -times); }

// The step of a count that goes by the view's cosine and is rounded.
float cosine_step(const MarchParams& p, float view_z) {
    return 1 / (view_z * static_cast<float>(p.min_steps) + (1 - view_z) * static_cast<float>(p.max_steps) - 0.5f);
}

// A shift of w (h - zero level) along the ray, where h is the height of some point between polygon and hit: off by w (h - hit) and by
// (1 - w) (zero level - hit), and w is the view's cosine where the shift is not divided by it.
Promise offset_limited(float view_z) { return {.unmoved = 1.0 - static_cast<double>(view_z), .relief = static_cast<double>(view_z)}; }

constexpr Technique table[] = {
    {
        SHADER(texture_mapping),
        .title = "Texture mapping",
        .summary = "paints the colour on a flat polygon",
        .source = {"Catmull", 1974, "A Subdivision Algorithm for Computer Display of Curved Surfaces"},
        .effects = {},
        .maps = {},
        .shaded_by = ShadedBy::polygon,
        .knobs = {},
        .max_fetches = [](const MarchParams&) { return 0; },
        .promise = [](const MarchParams&, float) { return Promise{.polygon = true}; },
        .limits = "no relief of any kind",
    },
    {
        SHADER(bump_mapping),
        .title = "Bump mapping",
        .summary = "shades a flat polygon with normals taken from differences of the heights",
        .source = {"Blinn", 1978, "Simulation of Wrinkled Surfaces"},
        .effects = {},
        .maps = {},
        .shaded_by = ShadedBy::height_slopes,
        .knobs = {},
        .max_fetches = [](const MarchParams&) { return 0; },
        .promise = [](const MarchParams&, float) { return Promise{.polygon = true}; },
        .limits = "nothing shifts, hides or shadows: flat as soon as the view is grazing or moves",
    },
    {
        SHADER(normal_mapping),
        .title = "Normal mapping",
        .summary = "shades a flat polygon with the normals of the detailed surface",
        .source = {"Cohen, Olano, Manocha", 1998, "Appearance-Preserving Simplification"},
        .effects = {},
        .maps = {},
        .knobs = {},
        .max_fetches = [](const MarchParams&) { return 0; },
        .promise = [](const MarchParams&, float) { return Promise{.polygon = true}; },
        .limits = "nothing shifts, hides or shadows: flat as soon as the view is grazing or moves",
    },
    {
        SHADER(emboss_bump),
        .title = "Emboss bump mapping",
        .summary = "lights a flat polygon by the height here less the height a little toward the light",
        .source = {"Peeples; Michael", 1999, "Emboss Bump Mapping"},
        .effects = {},
        .maps = {},
        .shaded_by = ShadedBy::emboss,
        .knobs = {},
        .max_fetches = [](const MarchParams&) { return 0; },
        .promise = [](const MarchParams&, float) { return Promise{.polygon = true}; },
        .limits = "no highlights and no slopes across the light; steep slopes burn out or go black; nothing shifts, hides or shadows",
    },
    {
        SHADER(parallax_mapping),
        .title = "Parallax mapping",
        .summary = "shifts the texture by the height found under the ray",
        .source = {"Kaneko et al.", 2001, "Detailed Shape Representation with Parallax Mapping"},
        .effects = {.motion_parallax = true},
        .solves = {.level = true},
        .precision = [](const MarchParams&, float) { return Precision{}; },
        .maps = {Map::height},
        .knobs = {},
        .max_fetches = [](const MarchParams&) { return 1; },
        .promise = [](const MarchParams&, float) { return Promise{.relief = 1}; },
        .limits = "the shift grows without bound at grazing views and tears the texture",
    },
    {
        SHADER(parallax_offset_limiting),
        .title = "Parallax mapping with offset limiting",
        .summary = "shifts by the height without dividing by the view's cosine",
        .source = {"Welsh", 2004, "Parallax Mapping with Offset Limiting: A Per-Pixel Approximation of Uneven Surfaces"},
        .effects = {.motion_parallax = true},
        .maps = {Map::height},
        .knobs = {},
        .max_fetches = [](const MarchParams&) { return 1; },
        .promise = [](const MarchParams&, float view_z) { return offset_limited(view_z); },
        .limits = "flattens toward the horizon; no part ever hides another",
    },
    {
        SHADER(parallax_averaged),
        .title = "Averaged parallax mapping",
        .summary = "repeats the offset-limited shift with the mean of the height it came from and the height it led to",
        .source = {"Welsh; its refinement by averaging", 2004, "Parallax Mapping with Offset Limiting: A Per-Pixel Approximation of Uneven Surfaces"},
        .effects = {.motion_parallax = true},
        .maps = {Map::height},
        .knobs = {{knob::iterations, 3}},
        .max_fetches = [](const MarchParams& p) { return p.iterations + 1; },
        .promise = [](const MarchParams&, float view_z) { return offset_limited(view_z); },
        .budget = {.per_wall = 0.036f},
        .limits = "settles where a steeper ray would meet the field: flattens toward the horizon, and behind sharp edges shows whatever it lands on",
    },
    {
        SHADER(linear_search),
        .title = "Linear search (steep parallax)",
        .summary = "takes equal steps down the ray until one ends below the surface",
        .source = {"McGuire, McGuire", 2005, "Steep Parallax Mapping"},
        .effects = {.motion_parallax = true, .self_occlusion = true, .self_shadow = true},
        .solves = {.level = true, .ramp = true, .wedge = true, .step = true},
        .precision = [](const MarchParams& p, float) { return Precision{.error = share(p.max_steps), .stride = share(p.max_steps)}; },
        .converges = {&knob::max_steps},
        .maps = {Map::height},
        .knobs = {{knob::max_steps, 64}},
        .max_fetches = [](const MarchParams& p) { return p.max_steps; },
        .limits = "slices the relief into terraces, and steps over what is thinner than a step",
    },
    {
        SHADER(binary_search),
        .title = "Binary search alone",
        .summary = "halves the whole ray toward some crossing of the surface",
        .source = {"Policarpo, Oliveira, Comba", 2005, "Real-Time Relief Mapping on Arbitrary Polygonal Surfaces"},
        .effects = {.motion_parallax = true, .self_shadow = true},
        .solves = {.level = true, .ramp = true},
        .precision = [](const MarchParams& p, float) { return Precision{.error = halved(1, p.refine_steps)}; },
        .maps = {Map::height},
        .knobs = {{knob::refine_steps, 10}},
        .max_fetches = [](const MarchParams& p) { return p.refine_steps; },
        .promise = [](const MarchParams& p, float) { return Promise{.error = halved(1, p.refine_steps), .stride = 1}; },
        .limits = "finds a hidden crossing wherever the ray meets the surface more than once: half of what a wall hides is shown, four tenths of its shadow are lit",
    },
    {
        SHADER(relief_mapping),
        .title = "Relief mapping",
        .summary = "brackets the surface by a linear search and bisects the bracket",
        .source = {"Policarpo, Oliveira, Comba", 2005, "Real-Time Relief Mapping on Arbitrary Polygonal Surfaces"},
        .effects = {.motion_parallax = true, .self_occlusion = true, .self_shadow = true},
        .solves = {.level = true, .ramp = true, .wedge = true, .step = true},
        .precision = [](const MarchParams& p, float) {
            return Precision{.error = halved(share(p.max_steps), p.refine_steps), .stride = share(p.max_steps)};
        },
        .converges = {&knob::max_steps, &knob::refine_steps},
        .maps = {Map::height},
        .knobs = {{knob::max_steps, 30}, {knob::refine_steps, 6}},
        .max_fetches = [](const MarchParams& p) { return p.max_steps + p.refine_steps; },
        .limits = "sharp where it hits, but steps over what is thinner than a step",
    },
    {
        SHADER(interval_mapping),
        .title = "Interval mapping",
        .summary = "brackets the surface by a linear search and closes in on it along chords",
        .source = {"Risser, Shah, Pattanaik", 2005, "Interval Mapping"},
        .effects = {.motion_parallax = true, .self_occlusion = true, .self_shadow = true},
        .solves = {.level = true, .ramp = true, .wedge = true, .step = true},
        .precision = [](const MarchParams& p, float) { return Precision{.error = share(p.max_steps), .stride = share(p.max_steps)}; },
        .converges = {&knob::max_steps, &knob::refine_steps},
        .maps = {Map::height},
        .knobs = {{knob::max_steps, 30}, {knob::refine_steps, 2}},
        .max_fetches = [](const MarchParams& p) { return p.max_steps + 1 + p.refine_steps; },
        .promise = [](const MarchParams& p, float) { return Promise{.error = share(8 * p.max_steps), .stride = share(p.max_steps)}; },
        .budget = {.per_wall = 0.0125f},
        .limits = "creeps up to sheer steps, whose foot a chord does not see, and steps over what is thinner than a step",
    },
    {
        SHADER(distance_mapping),
        .title = "Distance mapping",
        .summary = "leaps through a 3D map of distances to the relief, and searches the rest in short steps",
        .source = {"Donnelly", 2005, "Per-Pixel Displacement Mapping with Distance Functions"},
        .effects = {.motion_parallax = true, .self_occlusion = true, .self_shadow = true},
        .solves = {.level = true, .ramp = true, .wedge = true, .step = true},
        .precision = [](const MarchParams& p, float) {
            return Precision{.error = halved(share(p.max_steps), p.refine_steps), .stride = share(p.max_steps)};
        },
        .converges = {&knob::max_steps, &knob::refine_steps},
        .maps = {Map::height, Map::distance},
        .knobs = {{knob::max_steps, 32}, {knob::refine_steps, 6}},
        .max_fetches = [](const MarchParams& p) { return 2 * p.max_steps + p.refine_steps; },
        .limits = "a map of 64 slices, and fetches twice a step where walls are near; within a voxel of the surface it steps over what is thinner than a step",
    },
    {
        SHADER(parallax_slope),
        .title = "Parallax mapping with slope",
        .summary = "weakens the offset-limited shift where the surface is steep",
        .source = {"Premecz", 2006, "Iterative Parallax Mapping with Slope Information"},
        .effects = {.motion_parallax = true},
        .maps = {Map::height, Map::normal},
        .knobs = {},
        .max_fetches = [](const MarchParams&) { return 2; },
        .promise = [](const MarchParams&, float view_z) {
            Promise between = offset_limited(view_z);  // and no shift at all
            between.polygon = true;
            return between;
        },
        .limits = "steep flanks stay where they are; no part ever hides another",
    },
    {
        SHADER(parallax_iterative),
        .title = "Iterative parallax mapping",
        .summary = "repeats the shift from where it landed, damped by the slope",
        .source = {"Premecz", 2006, "Iterative Parallax Mapping with Slope Information"},
        .effects = {.motion_parallax = true},
        .solves = {.level = true},
        .precision = [](const MarchParams& p, float view_z) { return Precision{.error = std::pow(1 - view_z, static_cast<float>(p.iterations))}; },
        .converges = {&knob::iterations},
        .maps = {Map::height, Map::normal},
        .knobs = {{knob::iterations, 4}},
        .max_fetches = [](const MarchParams& p) { return 2 * p.iterations; },
        .promise = [](const MarchParams& p, float view_z) { return Promise{.unmoved = std::pow(1 - view_z, static_cast<float>(p.iterations)), .relief = 1}; },
        .budget = {.astray = 0.125f, .per_wall = 0.04f},
        .limits = "settles on whichever crossing is near, so steep walls smear",
    },
    {
        SHADER(parallax_occlusion_mapping),
        .title = "Parallax occlusion mapping",
        .summary = "takes more linear steps at grazing views, then one secant",
        .source = {"Tatarchuk", 2006, "Dynamic Parallax Occlusion Mapping with Approximate Soft Shadows"},
        .effects = {.motion_parallax = true, .self_occlusion = true, .self_shadow = true},
        .solves = {.level = true, .ramp = true, .wedge = true, .step = true},
        .precision = [](const MarchParams& p, float view_z) {
            const float step = cosine_step(p, view_z);
            return Precision{.error = step, .stride = step};
        },
        .converges = {&knob::max_steps, &knob::min_steps},
        .maps = {Map::height},
        .knobs = {{knob::max_steps, 64}, {knob::min_steps, 8}},
        .max_fetches = [](const MarchParams& p) { return p.max_steps + 1; },
        .promise = [](const MarchParams& p, float view_z) {
            const double step = cosine_step(p, view_z);
            return Promise{.error = step / 4, .stride = step};
        },
        .budget = {.per_wall = 0.025f},
        .limits = "cuts corners at steps, and steps over what is thinner than a step",
    },
    {
        SHADER(cone_step_mapping),
        .title = "Cone step mapping",
        .summary = "leaps to the wall of the empty cone above each texel",
        .source = {"Dummer", 2006, "Cone Step Mapping: An Iterative Ray-Heightfield Intersection Algorithm"},
        .effects = {.motion_parallax = true, .self_occlusion = true, .self_shadow = true},
        .solves = {.level = true, .ramp = true},
        .precision = [](const MarchParams& p, float) { return Precision{.error = p.tolerance}; },
        .converges = {&knob::max_steps},
        .maps = {Map::cone},
        .knobs = {{knob::max_steps, 64}, {knob::tolerance, 1e-3f}},
        .max_fetches = [](const MarchParams& p) { return p.max_steps; },
        .promise = [](const MarchParams& p, float) { return Promise{.error = p.tolerance, .texels = 1}; },
        .budget = {.per_wall = 0.09f},
        .limits = "creeps beside thin spikes and stops short when its steps run out; cones blended between texels are too wide, so it enters sharp edges and ridges",
    },
    {
        SHADER(relaxed_cone_stepping),
        .title = "Relaxed cone stepping",
        .summary = "leaps to the wall of a cone inside which the surface is entered at most once, and bisects the leap that ends below it",
        .source = {"Policarpo, Oliveira", 2007, "Relaxed Cone Stepping for Relief Mapping"},
        .effects = {.motion_parallax = true, .self_occlusion = true, .self_shadow = true},
        .solves = {.level = true, .ramp = true},
        .precision = [](const MarchParams& p, float) { return Precision{.error = std::max(p.tolerance, halved(1, p.refine_steps))}; },
        .converges = {&knob::max_steps, &knob::refine_steps},
        .maps = {Map::relaxed_cone},
        .knobs = {{knob::max_steps, 64}, {knob::refine_steps, 8}, {knob::tolerance, 1e-3f}},
        .max_fetches = [](const MarchParams& p) { return p.max_steps + p.refine_steps; },
        .promise = [](const MarchParams& p, float) { return Promise{.error = std::max(p.tolerance, halved(1, p.refine_steps)), .texels = 1}; },
        .budget = {.per_wall = 0.036f},
        .limits = "creeps beside thin spikes and stops short when its steps run out; cones blended between texels are too wide, so it may pass a sharp ridge",
    },
    {
        SHADER(max_mip_tracing),
        .title = "Maximum mipmap tracing",
        .summary = "skips empty nodes of a pyramid of maxima and solves each cell it may touch",
        .source = {"Tevs, Ihrke, Seidel", 2008, "Maximum Mipmaps for Fast, Accurate, and Scalable Dynamic Height Field Rendering"},
        .effects = {.motion_parallax = true, .self_occlusion = true, .self_shadow = true},
        .solves = {.level = true, .ramp = true, .wedge = true, .step = true},
        .precision = [](const MarchParams&, float) { return Precision{}; },
        .converges = {&knob::max_steps},
        .maps = {Map::height, Map::max_pyramid},
        .knobs = {{knob::max_steps, 2048}},
        .max_fetches = [](const MarchParams& p) { return p.max_steps; },
        .exact = true,
        .limits = "none in what it finds; its cost grows with grazing views and spiky relief",
    },
    {
        SHADER(contact_refinement),
        .title = "Contact refinement",
        .summary = "searches the step that met the surface again in shorter steps",
        .source = {"Riccardi", 2019, "Contact Refinement Parallax Mapping"},
        .effects = {.motion_parallax = true, .self_occlusion = true, .self_shadow = true},
        .solves = {.level = true, .ramp = true, .wedge = true, .step = true},
        .precision = [](const MarchParams& p, float) {
            return Precision{.error = share(p.max_steps) * std::pow(share(p.contact_steps), static_cast<float>(p.refine_steps)), .stride = share(p.max_steps)};
        },
        .converges = {&knob::max_steps, &knob::refine_steps},
        .maps = {Map::height},
        .knobs = {{knob::max_steps, 30}, {knob::refine_steps, 2}, {knob::contact_steps, 4}},
        .max_fetches = [](const MarchParams& p) { return p.max_steps + p.refine_steps * (p.contact_steps - 1); },
        .limits = "steps over what is thinner than a step",
    },
    {
        SHADER(robust_cone_stepping),
        .title = "Robust cone step mapping",
        .summary = "leaps through cones narrowed to the least of nine, never less than to the next cell's wall",
        .source = {"Ban, Valasek", 2024, "Robust Cone Step Mapping"},
        .effects = {.motion_parallax = true, .self_occlusion = true, .self_shadow = true},
        .solves = {.level = true, .ramp = true, .wedge = true, .step = true},
        .precision = [](const MarchParams& p, float) { return Precision{.error = halved(1, p.refine_steps), .stride = 2e-3f}; },
        .converges = {&knob::max_steps, &knob::refine_steps},
        .maps = {Map::height, Map::robust_cone},
        .knobs = {{knob::max_steps, 48}, {knob::refine_steps, 8}},
        .max_fetches = [](const MarchParams& p) { return 2 * p.max_steps + p.refine_steps; },
        .budget = {.per_wall = 0.0065f},
        .limits = "walks from cell to cell in rough relief and stops short when its steps run out; misses what is entered and left within a cell",
    },
    {
        SHADER(cell_cone_tracing),
        .title = "Cell cone tracing",
        .summary = "leaps under roofs over the cells ahead, a cone in terraces that holds nothing of the surface, and solves each cell it may touch",
        .source = {"relievo", 2026, "Casting a ray at a height field without ever missing it"},
        .effects = {.motion_parallax = true, .self_occlusion = true, .self_shadow = true},
        .solves = {.level = true, .ramp = true, .wedge = true, .step = true},
        .precision = [](const MarchParams&, float) { return Precision{}; },
        .converges = {&knob::max_steps},
        .maps = {Map::height, Map::cell_cone},
        .knobs = {{knob::max_steps, 2048}},
        .max_fetches = [](const MarchParams& p) { return p.max_steps; },
        .exact = true,
        .limits = "none in what it finds; its cost grows with grazing views and with spikes close together",
    },
};

#undef SHADER

constexpr bool every_file_has_an_entry() {
    for (const std::string_view file : heightfield::files) {
        bool listed = false;
        for (const Technique& t : table) listed = listed || t.id == file;
        if (!listed) return false;
    }
    return true;
}
static_assert(every_file_has_an_entry(),
              "a file in shaders/techniques/heightfield has no entry in the table above: add one (CONTRIBUTING.md, Add a technique)");

constexpr bool in_order_of_year() {
    for (std::size_t i = 1; i < std::size(table); ++i)
        if (table[i].source.year < table[i - 1].source.year) return false;
    return true;
}
static_assert(in_order_of_year(), "the table is read as a history: keep it in order of year");

}  // namespace

std::span<const Technique> techniques() { return table; }

const Technique* find_technique(std::string_view id) {
    const auto it = std::ranges::find(table, id, &Technique::id);
    return it == std::end(table) ? nullptr : it;
}

Promise promise_of(const Technique& technique, const MarchParams& params, float view_z) {
    if (technique.promise) return technique.promise(params, view_z);
    const Precision p = technique.precision(params, view_z);
    return {.error = p.error, .stride = p.stride};
}

double wall_exposure(double rms_slope, double elevation_deg) { return rms_slope / std::tan(elevation_deg * std::numbers::pi / 180); }

double astray_budget(const Technique& technique, double exposure) {
    const Budget& b = technique.budget;
    return std::min(1.0, astray_by_rounding + static_cast<double>(b.astray) + 1 - std::exp(-static_cast<double>(b.per_wall) * exposure));
}

MarchParams default_params(const Technique& technique) {
    MarchParams params{.max_steps = 1, .min_steps = 1, .refine_steps = 0, .contact_steps = 2, .iterations = 1, .tolerance = 1e-3f};
    for (const KnobDefault& d : technique.knobs) d.knob->set(params, d.value);
    return params;
}

}  // namespace relievo
