// What a row of the catalogue says about a technique. The families' signatures are fixed here, all of them, so that the
// catalogue serves height fields, layered fields and fur alike:
//   height field and layered field:  SurfaceHit  name(SurfaceRay, MarchParams)
//   shells (fur):                    ShellSample name(ShellPoint, ShellParams)
#pragma once

#include "core/map_set.h"
#include "core/promise.h"
#include "techniques/glsl.h"
#include "techniques/knobs.h"

#include <initializer_list>
#include <span>
#include <string_view>

namespace relievo {

enum class Family { heightfield };

using HeightFieldFunction = glsl::SurfaceHit (*)(glsl::SurfaceRay, glsl::MarchParams);

// A list that lives inside a constexpr table row.
template <class T, int capacity>
struct Few {
    T items[static_cast<std::size_t>(capacity)]{};
    int count = 0;
    constexpr Few() = default;
    constexpr Few(std::initializer_list<T> list) {
        for (const T& item : list) items[count++] = item;  // too many: out of bounds, so the table does not compile
    }
    constexpr const T* begin() const { return items; }
    constexpr const T* end() const { return items + count; }
    constexpr bool contains(const T& t) const {
        for (const T& item : *this)
            if (item == t) return true;
        return false;
    }
};

struct Source {
    std::string_view author;
    int year;
    std::string_view title;
};

// The four effects the field compares. A test measures each: a claim asks for all of motion parallax's direction and half its
// amount, for nothing seen that a wall hides, for half of a wall's shadow; no claim means less than half is hidden, none dark.
struct Effects {
    bool motion_parallax = false;
    bool self_occlusion = false;
    bool self_shadow = false;
    bool silhouette = false;
};

struct KnobDefault {
    const Knob* knob = nullptr;
    float value = 0;
    constexpr KnobDefault() = default;
    constexpr KnobDefault(const Knob& k, float v) : knob(&k), value(v) {}
    constexpr bool operator==(const KnobDefault&) const = default;
};

// Fields whose hits are known in closed form. Where a row says true, the first hit is found there within the row's precision;
// where it says false, a test shows that it is not.
struct Solves {
    bool level = false;  // one height everywhere, whatever the zero level
    bool ramp = false;   // a slope, which a ray meets once
    bool wedge = false;  // a sharp ridge, which hides what is behind it
    bool step = false;   // plateaux with walls one texel wide
};

// How near a search comes to the crossings of ray and surface, in heights of the ray, whose whole way is 1.
struct Precision {
    float error = 0;   // a hit is at most this far from a crossing, or stands this close above the surface
    float stride = 0;  // what the ray is inside of for less than this may be stepped over
};

// The share of rays that may break the row's promise, on any relief. Nothing but rounding for a search whose bound is a theorem; for
// the others what was measured on the contract's fields and on thirty materials by others (docs/measured.md), and a margin above it.
struct Budget {
    float astray = 0;    // whatever the relief
    float per_wall = 0;  // each unit of the picture's wall exposure loses this share of what was right until then
};

// What float may turn on a ray that only grazes something: measured at most 3e-4 on the thirty materials.
inline constexpr double astray_by_rounding = 1e-3;

// What the light falls on where the search has found its hit.
enum class ShadedBy : int {
    polygon = glsl::shaded_by_polygon,
    normal_map = glsl::shaded_by_normal_map,
    height_slopes = glsl::shaded_by_height_slopes,
    emboss = glsl::shaded_by_emboss,
};

struct Technique {
    std::string_view id;
    Family family;
    HeightFieldFunction heightfield = nullptr;
    std::string_view title;
    std::string_view summary;  // one clause: what it does
    Source source;
    Effects effects = {};
    Solves solves = {};
    Precision (*precision)(const MarchParams&, float view_z) = nullptr;  // view_z: cosine of the view; null: nothing is solved
    Few<const Knob*, 4> converges = {};  // turning one of these up never makes the mean error worse
    Few<Map, 4> maps;          // maps of the search; shading adds colour and what shaded_by asks for
    ShadedBy shaded_by = ShadedBy::normal_map;
    Few<KnobDefault, 4> knobs;
    int (*max_fetches)(const MarchParams&) = nullptr;  // most fetches the search may make with these knobs
    // Where the hit lies, in terms that hold on any relief; null: what `precision` says. Either this or a precision is stated.
    Promise (*promise)(const MarchParams&, float view_z) = nullptr;
    Budget budget = {};
    bool exact = false;        // finds the declared surface's first hit, up to float rounding
    std::string_view limits;   // where it fails
};

constexpr Family family_of(HeightFieldFunction) { return Family::heightfield; }

// The maps of a set that the technique's search may read, bound for the calling thread through glsl::bound_maps.
inline glsl::BoundMaps declared_maps(const Technique& technique, const MapSet& maps) {
    glsl::BoundMaps bound{.maps = &maps, .readable = {}};
    for (const Map map : technique.maps) bound.readable.set(index_of(map));
    return bound;
}

constexpr std::string_view title_of(ShadedBy shaded_by) {
    switch (shaded_by) {
        case ShadedBy::polygon: return "the polygon's own normal";
        case ShadedBy::normal_map: return "the normal map";
        case ShadedBy::height_slopes: return "normals from differences of heights";
        case ShadedBy::emboss: return "differences of heights along the light";
    }
    return {};
}

// What the row promises of a ray at these knobs.
Promise promise_of(const Technique& technique, const MarchParams& params, float view_z);

// Walls that a ray passes, as the mean over a picture: the root mean square slope of the relief as drawn, over the tangent of the view's
// elevation. At 1 a typical flank is as steep as the ray.
double wall_exposure(double rms_slope, double elevation_deg);

// The greatest share of rays that may break the promise at this exposure. Failures at each wall are independent, so that they
// accumulate as 1 - exp(-rate * walls).
double astray_budget(const Technique& technique, double exposure);

// The technique's knobs at their defaults; knobs it does not declare hold values it never reads.
MarchParams default_params(const Technique& technique);

}  // namespace relievo
