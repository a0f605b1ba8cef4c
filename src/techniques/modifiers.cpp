#include "techniques/modifiers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace relievo {

namespace {

using Numbers = glsl::DrawNumbers;
using Options = DrawOptions;

constexpr Source mile{"Mile", 2008, "Shader nyelvek lehetőségei: Felület részleteinek megjelenítése"};
constexpr Source tatarchuk{"Tatarchuk", 2006, "Dynamic Parallax Occlusion Mapping with Approximate Soft Shadows"};

constexpr ModifierValue shadow_values[] = {
    {"none", "every point is lit"},
    {"hard", "the technique asked again from the light, a point", {"Policarpo, Oliveira, Comba", 2005, "Real-Time Relief Mapping on Arbitrary Polygonal Surfaces"}},
    {"soft", "by how deep the light ray dips below the field", mile},
    {"tatarchuk", "by eight heights along the light ray, the nearer the weightier", tatarchuk},
    {"horizon", "by a map of the horizon in 32 directions, and five heights close by", {"Max", 1988, "Horizon Mapping: Shadows for Bump-Mapped Surfaces"}},
    {"area", "the technique asked from many points of the light's disc"},
};

constexpr ModifierValue edge_values[] = {
    {"none", "a pixel shows the one point that its ray meets"},
    {"behind", "a pixel that met an edge is mixed with what lies behind", mile},
    {"passed", "an edge that the ray passed within half a pixel is mixed in, by the gap", mile},
    {"covered", "both sides of an edge, by how much of the pixel they cover"},
};
constexpr ModifierValue steps_values[] = {
    {"fixed", "as many as max_steps says"},
    {"cosine", "from least_steps up to max_steps, with 1 - cos of the view's angle", tatarchuk},
    {"texel", "one for each texel that the ray crosses, from least_steps up to max_steps"},
};
constexpr ModifierValue scale_values[] = {
    {"fixed", "the relief is as high as it is"},
    {"cosine", "lower toward the horizon, with cos of the view's angle", mile},
    {"power", "the same, by a curve that keeps the height for longer", mile},
};
constexpr ModifierValue border_values[] = {
    {"repeat", "the texture goes on beyond the polygon"},
    {"clip", "nothing beyond the texture's own square [0,1]^2", {"Oliveira, Policarpo", 2005, "An Efficient Representation for Surface Details"}},
    {"chart", "nothing beyond the polygon's texture coordinates"},
};
constexpr ModifierValue fade_values[] = {
    {"none", "the relief is as high far away as near"},
    {"footprint", "flat where a pixel covers many texels"},
};
constexpr ModifierValue mip_values[] = {
    {"polygon", "colour and normal at the level of the pixel's footprint on the polygon"},
    {"hit", "at the level of its footprint on the surface that was hit", {"Igehy", 1999, "Tracing Ray Differentials"}},
    {"finest", "at the finest level"},
};
constexpr ModifierValue shading_values[] = {
    {"phong", "mirrored light against the eye", {"Phong", 1975, "Illumination for Computer Generated Pictures"}},
    {"blinn_phong", "the half vector against the normal", {"Blinn", 1977, "Models of Light Reflection for Computer Synthesized Pictures"}},
    {"ggx", "a microfacet surface, dielectric or metal", {"Walter et al.", 2007, "Microfacet Models for Refraction through Rough Surfaces"}},
    {"gouraud", "Phong's light at the corners of a grid, blended between", {"Gouraud", 1971, "Continuous Shading of Curved Surfaces"}},
    {"flat", "Phong's light on one normal for each cell of a grid"},
};

constexpr ModifierValue sheet_values[] = {
    {"none", "nothing but the relief"},
    {"polygon", "a level sheet, hidden by the polygon: what depth buffers hold when a shader leaves them alone"},
    {"relief", "a level sheet, hidden by the relief: the depth of the hit is written", {"Policarpo, Oliveira, Comba", 2005, "Real-Time Relief Mapping on Arbitrary Polygonal Surfaces"}},
};

constexpr ModifierValue sides_values[] = {
    {"front", "from behind there is nothing"},
    {"both", "from behind what rises is sunk, and what is sunk rises", mile},
};

constexpr Modifier table[] = {
    {
        .id = "shadow",
        .title = "Shadow",
        .help = "how the relief's shadow on itself is found",
        .values = shadow_values,
        .choice = &Options::shadow,
        .usual = glsl::shadow_hard,
        .truth = glsl::shadow_area,
    },
    {
        .id = "edge",
        .title = "Edges",
        .help = "whether pixels at the relief's own edges are mixed from both sides",
        .values = edge_values,
        .choice = &Options::edge,
        .usual = glsl::edge_none,
        .truth = glsl::edge_none,
    },
    {
        .id = "steps",
        .title = "Steps by angle",
        .help = "how many steps a search takes at a view's angle, where it takes steps",
        .values = steps_values,
        .choice = &Options::steps,
        .usual = glsl::steps_fixed,
        .truth = glsl::steps_fixed,
    },
    {
        .id = "scale",
        .title = "Scale by angle",
        .help = "how high the relief is at a view's angle",
        .values = scale_values,
        .choice = &Options::scale,
        .usual = glsl::scale_fixed,
        .truth = glsl::scale_fixed,
    },
    {
        .id = "border",
        .title = "Border",
        .help = "what there is beyond the texture",
        .values = border_values,
        .choice = &Options::border,
        .usual = glsl::border_repeat,
        .truth = -1,
    },
    {
        .id = "fade",
        .title = "Distance fade",
        .help = "whether the relief flattens where it is smaller than a pixel",
        .values = fade_values,
        .choice = &Options::fade,
        .usual = glsl::fade_none,
        .truth = glsl::fade_none,
    },
    {
        .id = "mip",
        .title = "Mip level",
        .help = "at which level colour and normal are read",
        .values = mip_values,
        .choice = &Options::mip,
        .usual = glsl::mip_polygon,
        .truth = glsl::mip_finest,
    },
    {
        .id = "shading",
        .title = "Shading",
        .help = "how the surface reflects",
        .values = shading_values,
        .choice = &Options::shading,
        .usual = glsl::shading_phong,
        .truth = -1,
    },
    {
        .id = "sheet",
        .title = "Sheet",
        .help = "a sheet of water that meets the relief, to see whose depth hides it",
        .values = sheet_values,
        .choice = &Options::sheet,
        .usual = glsl::sheet_none,
        .truth = glsl::sheet_relief,
    },
    {
        .id = "sides",
        .title = "Sides",
        .help = "which sides of the polygon show the relief",
        .values = sides_values,
        .choice = &Options::sides,
        .usual = sides_front,
        .truth = -1,
    },
};
enum Row { shadow_row, edge_row, steps_row, scale_row, border_row, fade_row, mip_row, shading_row, sheet_row };

constexpr std::uint32_t bit(int value) { return 1u << value; }

constexpr ModifierNumber number_table[] = {
    {
        .id = "light_radius",
        .title = "Light's radius",
        .unit = "degrees",
        .help = "of the key light's disc as seen from the surface; the sun's is 0.27",
        .min = 0,
        .max = 20,
        .step = 0.1f,
        .initial = 3,
        .to_unit = std::numbers::pi_v<float> / 180,
        .member = &Numbers::light_radius,
        .of = &table[shadow_row],
        .values = bit(glsl::shadow_soft) | bit(glsl::shadow_tatarchuk) | bit(glsl::shadow_horizon) | bit(glsl::shadow_area),
    },
    {
        .id = "shadow_depth",
        .title = "Black at depth",
        .unit = "height",
        .help = "penetration of the light ray at which a soft shadow is black",
        .min = 0.001f,
        .max = 1,
        .step = 0.001f,
        .initial = 0.15f,
        .to_unit = 1,
        .member = &Numbers::shadow_depth,
        .of = &table[shadow_row],
        .values = bit(glsl::shadow_soft),
    },
    {
        .id = "shadow_softening",
        .title = "Softening",
        .unit = "",
        .help = "factor on the blocking that the eight samples see",
        .min = 0.01f,
        .max = 10,
        .step = 0.01f,
        .initial = 0.58f,
        .to_unit = 1,
        .member = &Numbers::shadow_softening,
        .of = &table[shadow_row],
        .values = bit(glsl::shadow_tatarchuk),
    },
    {
        .id = "shadow_samples",
        .title = "Shadow samples",
        .unit = "",
        .help = "heights along the light ray, or rays to the light's disc",
        .min = 1,
        .max = 256,
        .step = 1,
        .initial = 16,
        .to_unit = 1,
        .member = &Numbers::shadow_samples,
        .of = &table[shadow_row],
        .values = bit(glsl::shadow_soft) | bit(glsl::shadow_area),
    },
    {
        .id = "edge_width",
        .title = "Edge width",
        .unit = "height",
        .help = "gap between ray and field at which an edge that was passed leaves the pixel, if half a pixel is not nearer",
        .min = 0.001f,
        .max = 1,
        .step = 0.001f,
        .initial = 0.05f,
        .to_unit = 1,
        .member = &Numbers::edge_width,
        .of = &table[edge_row],
        .values = bit(glsl::edge_passed_mode),
    },
    {
        .id = "edge_samples",
        .title = "Edge samples",
        .unit = "",
        .help = "heights along the view ray that look for edges",
        .min = 2,
        .max = 512,
        .step = 1,
        .initial = 48,
        .to_unit = 1,
        .member = &Numbers::edge_samples,
        .of = &table[edge_row],
        .values = bit(glsl::edge_passed_mode) | bit(glsl::edge_covered_mode),
    },
    {
        .id = "least_steps",
        .title = "Fewest steps",
        .unit = "",
        .help = "steps when looking straight down",
        .min = 1,
        .max = 4096,
        .step = 1,
        .initial = 8,
        .to_unit = 1,
        .member = &Numbers::least_steps,
        .of = &table[steps_row],
        .values = bit(glsl::steps_cosine) | bit(glsl::steps_texel),
    },
    {
        .id = "least_scale",
        .title = "Scale at the horizon",
        .unit = "",
        .help = "share of the relief's amplitude that is left at the horizon",
        .min = 0,
        .max = 1,
        .step = 0.01f,
        .initial = 0.3f,
        .to_unit = 1,
        .member = &Numbers::least_scale,
        .of = &table[scale_row],
        .values = bit(glsl::scale_cosine),
    },
    {
        .id = "scale_exponent",
        .title = "Exponent",
        .unit = "",
        .help = "k of 1 - (1 - cos a)^k",
        .min = 1,
        .max = 64,
        .step = 0.1f,
        .initial = 8,
        .to_unit = 1,
        .member = &Numbers::scale_exponent,
        .of = &table[scale_row],
        .values = bit(glsl::scale_power),
    },
    {
        .id = "fade_near",
        .title = "Fade from",
        .unit = "texels",
        .help = "what a pixel covers where the relief begins to flatten",
        .min = 0,
        .max = 1024,
        .step = 0.1f,
        .initial = 32,
        .to_unit = 1,
        .member = &Numbers::fade_near,
        .of = &table[fade_row],
        .values = bit(glsl::fade_footprint),
    },
    {
        .id = "fade_far",
        .title = "Flat from",
        .unit = "texels",
        .help = "what a pixel covers where the relief is flat",
        .min = 0,
        .max = 1024,
        .step = 0.1f,
        .initial = 128,
        .to_unit = 1,
        .member = &Numbers::fade_far,
        .of = &table[fade_row],
        .values = bit(glsl::fade_footprint),
    },
    {
        .id = "roughness",
        .title = "Roughness",
        .unit = "",
        .help = "perceptual: its square is the width of the distribution of normals",
        .min = 0.03f,
        .max = 1,
        .step = 0.01f,
        .initial = 0.5f,
        .to_unit = 1,
        .member = &Numbers::roughness,
        .of = &table[shading_row],
        .values = bit(glsl::shading_ggx),
    },
    {
        .id = "metallic",
        .title = "Metal",
        .unit = "",
        .help = "0 a dielectric, 1 a metal whose colour is the texture's",
        .min = 0,
        .max = 1,
        .step = 0.01f,
        .initial = 0,
        .to_unit = 1,
        .member = &Numbers::metallic,
        .of = &table[shading_row],
        .values = bit(glsl::shading_ggx),
    },
    {
        .id = "facets",
        .title = "Facets",
        .unit = "",
        .help = "cells of the grid along a repeat",
        .min = 1,
        .max = 4096,
        .step = 1,
        .initial = 64,
        .to_unit = 1,
        .member = &Numbers::facets,
        .of = &table[shading_row],
        .values = bit(glsl::shading_gouraud) | bit(glsl::shading_flat),
    },
    {
        .id = "sheet_level",
        .title = "Sheet's level",
        .unit = "height",
        .help = "height at which the sheet lies in the relief",
        .min = 0,
        .max = 1,
        .step = 0.01f,
        .initial = 0.5f,
        .to_unit = 1,
        .member = &Numbers::sheet_level,
        .of = &table[sheet_row],
        .values = bit(glsl::sheet_polygon) | bit(glsl::sheet_relief),
    },
};

// In order of the constants that name the values (shared/draw_options.h).
static_assert(shadow_values[glsl::shadow_none].id == "none" && shadow_values[glsl::shadow_hard].id == "hard" &&
              shadow_values[glsl::shadow_soft].id == "soft" && shadow_values[glsl::shadow_tatarchuk].id == "tatarchuk" &&
              shadow_values[glsl::shadow_horizon].id == "horizon" && shadow_values[glsl::shadow_area].id == "area");
static_assert(edge_values[glsl::edge_behind_mode].id == "behind" && edge_values[glsl::edge_passed_mode].id == "passed" &&
              edge_values[glsl::edge_covered_mode].id == "covered");
static_assert(steps_values[glsl::steps_cosine].id == "cosine" && steps_values[glsl::steps_texel].id == "texel");
static_assert(scale_values[glsl::scale_cosine].id == "cosine" && scale_values[glsl::scale_power].id == "power");
static_assert(border_values[glsl::border_clip].id == "clip" && border_values[glsl::border_chart].id == "chart");
static_assert(sheet_values[glsl::sheet_polygon].id == "polygon" && sheet_values[glsl::sheet_relief].id == "relief");
static_assert(sides_values[sides_front].id == "front" && sides_values[sides_both].id == "both");
static_assert(fade_values[glsl::fade_footprint].id == "footprint");
static_assert(mip_values[glsl::mip_hit].id == "hit" && mip_values[glsl::mip_finest].id == "finest");
static_assert(shading_values[glsl::shading_blinn_phong].id == "blinn_phong" && shading_values[glsl::shading_ggx].id == "ggx" &&
              shading_values[glsl::shading_gouraud].id == "gouraud" && shading_values[glsl::shading_flat].id == "flat");

std::string plain(float value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", static_cast<double>(value));
    return text;
}

}  // namespace

DrawOptions::DrawOptions() : glsl::DrawModes{}, sides(sides_front) {
    for (const Modifier& m : table) this->*m.choice = m.usual;
    for (const ModifierNumber& n : number_table) n.set(*this, n.initial);
}

float ModifierNumber::get(const DrawOptions& options) const {
    return std::visit([&](auto m) { return static_cast<float>(options.numbers.*m); }, member) / to_unit;
}

void ModifierNumber::set(DrawOptions& options, float value) const {
    const float kept = std::clamp(value, min, max) * to_unit;
    std::visit(
        [&](auto m) {
            using T = std::remove_reference_t<decltype(options.numbers.*m)>;
            options.numbers.*m = is_integer() ? static_cast<T>(std::lround(kept)) : static_cast<T>(kept);
        },
        member);
}

float chart_of(const DrawOptions& options, float periods) {
    return options.border == glsl::border_clip ? 1.0f : options.border == glsl::border_chart ? periods : 0.0f;
}

std::span<const Modifier> modifiers() { return table; }
std::span<const ModifierNumber> modifier_numbers() { return number_table; }

const Modifier* find_modifier(std::string_view id) {
    const auto it = std::ranges::find(table, id, &Modifier::id);
    return it == std::end(table) ? nullptr : it;
}

MapFlags maps_of(const DrawOptions& options) {
    MapFlags maps;
    maps.set(index_of(Map::normal)).set(index_of(Map::colour));
    if (options.shadow == glsl::shadow_soft || options.shadow == glsl::shadow_tatarchuk) maps.set(index_of(Map::height));
    if (options.edge != glsl::edge_none || options.shading == glsl::shading_gouraud || options.shading == glsl::shading_flat ||
        options.steps == glsl::steps_texel || options.fade != glsl::fade_none)
        maps.set(index_of(Map::height));
    if (options.shadow == glsl::shadow_horizon) maps.set(index_of(Map::height)).set(index_of(Map::horizon));
    return maps;
}

int shadow_of(const Technique& technique, const DrawOptions& options) {
    return traces_shadow(options.shadow) && !technique.effects.self_shadow ? glsl::shadow_none : options.shadow;
}

std::string described(const DrawOptions& options) {
    std::string text;
    const auto add = [&](std::string_view id, const std::string& value) {
        text.append(text.empty() ? "" : " ").append(id).append("=").append(value);
    };
    for (const Modifier& m : table) {
        if (options.*m.choice != m.usual) add(m.id, std::string(m.value(options).id));
        for (const ModifierNumber& n : number_table)
            if (n.of == &m && n.counts(options)) add(n.id, plain(n.get(options)));
    }
    return text;
}

}  // namespace relievo
