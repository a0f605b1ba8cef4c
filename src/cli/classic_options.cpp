#include "cli/classic_options.h"

#include "core/error.h"
#include "core/suggest.h"

#include <CLI/CLI.hpp>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace relievo {

namespace {

constexpr double default_density = 20;  // percent of the map's texels, the denser of the thesis' two

struct LightKnob {
    std::string_view id;
    float LayersLight::*member;
    float least, most;
    std::string_view help;
};
constexpr LightKnob light_knobs[] = {
    {"ambient", &LayersLight::ambient, 0, 4, "light from everywhere"},
    {"diffuse", &LayersLight::diffuse, 0, 4, "light scattered by strands"},
    {"specular", &LayersLight::specular, 0, 4, "light mirrored by strands"},
    {"power", &LayersLight::power, 1, 1000, "how narrow the mirrored light is"},
};

struct DdsCodeEntry {
    DdsCode code;
    std::string_view id, summary;
};
constexpr DdsCodeEntry dds_codes[] = {
    {DdsCode::bc1, "bc1", "colours alone, 4 bits a texel"},
    {DdsCode::bc3, "bc3", "colours and alpha, 8 bits a texel"},
    {DdsCode::bc4, "bc4", "alpha alone, 4 bits a texel"},
};

// The entry of a table with ids.
template <class Table>
const auto& entry_of(const Table& table, std::string_view kind, const std::string& id) {
    std::vector<std::string> known;
    for (const auto& e : table) {
        if (e.id == id) return e;
        known.emplace_back(e.id);
    }
    throw UsageError(unknown_word(kind, id, known));
}

template <class Table>
std::string described(const Table& table) {
    std::string text;
    for (const auto& e : table) text += (text.empty() ? "" : "; ") + std::string(e.id) + ": " + std::string(e.summary);
    return text;
}

bool number(const std::string& text, double& value) {
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    return fault == std::errc{} && end == text.data() + text.size() && std::isfinite(value);
}

}  // namespace

void add_classic_options(CLI::App& verb, ClassicOptions& o) {
    constexpr const char* group = "Mode classic";
    verb.add_option("--map", o.map, "shape of the environment maps. " + described(map_shapes))->capture_default_str()->group(group);
    verb.add_option("--map-size", o.map_size, "edge of a face of the maps, texels: a power of two from 4 to 4096")->capture_default_str()->group(group);
    verb.add_option("--addressing", o.addressing, "direction that is looked up. " + described(addressings))->capture_default_str()->group(group);
    verb.add_option("--neighbourhood", o.neighbourhood, "where no strand grows beside another. " + described(neighbourhoods) + "; or a radius in texels")->capture_default_str()->group(group);
    verb.add_option("--seed", o.seed, "of the fur map, in mode lapped too")->capture_default_str()->group(group);
    verb.add_option("--colour-map", o.colour_map, "picture that tints the strands, as one of real fur (default: the preset's colour)")->group(group);
    verb.add_option("--fur-map", o.fur_map, "FILE.dds or FILE.png: also write the map of strands, with all its levels as DDS")->group(group);
    verb.add_option("--tinted-map", o.tinted_map, "FILE.dds or FILE.png: the same, tinted by the colour map")->group(group);
    verb.add_option("--dds-code", o.dds_code, "of the DDS files. " + described(dds_codes))->capture_default_str()->group(group);
    verb.add_flag("--mips", o.filtered, "read the maps through their mip levels, not the finest alone")->group(group);
}

ClassicSettings classic_settings(const ClassicOptions& o, const FurSettings& common, double height, double density, const std::vector<std::string>& set) {
    ClassicSettings s;
    s.shape = entry_of(map_shapes, "map", o.map).shape;
    s.addressing = entry_of(addressings, "addressing", o.addressing).addressing;
    if (o.map_size < 4 || o.map_size > 4096 || !std::has_single_bit(static_cast<unsigned>(o.map_size)))
        throw UsageError("--map-size takes a power of two from 4 to 4096, not " + std::to_string(o.map_size));
    s.map = {.width = o.map_size, .height = o.map_size, .density = (density > 0 ? density : default_density) / 100, .apart = 0, .seed = o.seed};
    if (s.map.density > 1) throw UsageError("--density takes at most 100 % of the fur map's texels in mode classic");
    if (double radius = 0; number(o.neighbourhood, radius) && o.neighbourhood != "4" && o.neighbourhood != "8") {
        if (radius < 0 || radius > 64) throw UsageError("--neighbourhood takes a radius from 0 to 64 texels, not " + o.neighbourhood);
        s.map.apart = radius;
    } else {
        s.map.apart = entry_of(neighbourhoods, "neighbourhood", o.neighbourhood).texels;
    }
    s.filtered = o.filtered;
    if (height > 0) s.height = static_cast<float>(height / 100);
    if (common.layers > 0) s.layers = common.layers;
    for (const std::string& setting : set) {
        const std::size_t equals = setting.find('=');
        if (equals == std::string::npos) throw UsageError("--set takes NAME=VALUE, not \"" + setting + "\"");
        std::vector<std::string> known;
        for (const LightKnob& k : light_knobs) known.emplace_back(k.id);
        const LightKnob* knob = nullptr;
        for (const LightKnob& k : light_knobs)
            if (k.id == setting.substr(0, equals)) knob = &k;
        if (knob == nullptr) throw UsageError(unknown_word("setting of mode classic", setting.substr(0, equals), known));
        double value = 0;
        if (!number(setting.substr(equals + 1), value) || value < static_cast<double>(knob->least) || value > static_cast<double>(knob->most)) {
            char range[96];
            std::snprintf(range, sizeof range, " takes a number from %g to %g", static_cast<double>(knob->least), static_cast<double>(knob->most));
            throw UsageError(std::string(knob->id) + range + ", not \"" + setting.substr(equals + 1) + "\"");
        }
        s.light.*knob->member = static_cast<float>(value);
    }
    s.fit_light = set.empty();
    s.colour_map = o.colour_map;
    for (const std::string& file : {o.fur_map, o.tinted_map})
        if (!file.empty() && !file.ends_with(".dds") && !file.ends_with(".png")) throw UsageError("maps are written as FILE.dds or FILE.png, not as " + file);
    s.fur_map_file = o.fur_map;
    s.tinted_map_file = o.tinted_map;
    s.dds_code = entry_of(dds_codes, "code", o.dds_code).code;
    s.colour = common.coat.tip_colour;
    s.skin = common.coat.root_colour;
    s.gloss = common.coat.gloss;
    s.width_px = common.width;
    s.height_px = common.height;
    s.passes = common.passes;
    s.comb = common.growth.comb;
    s.tilt = common.coat.tilt;
    s.bend = common.coat.bend;
    s.device = common.device;
    s.measure = common.measure;
    s.reference_samples = common.reference_samples;
    s.threads = common.threads;
    return s;
}

LappedFurSettings lapped_settings(const ClassicOptions& o, const FurSettings& common) {
    LappedFurSettings s;
    s.coat = common.coat;
    s.comb = common.growth.comb;
    s.seed = o.seed;
    s.fit_light = true;
    if (common.layers > 0) s.layers = common.layers;
    s.width = common.width;
    s.height = common.height;
    s.passes = common.passes;
    s.device = common.device;
    s.measure = common.measure;
    s.reference_samples = common.reference_samples;
    s.threads = common.threads;
    return s;
}

std::string classic_knob_list() {
    std::string text = "Settings of mode classic:\n";
    for (const LightKnob& k : light_knobs) {
        char line[256];
        std::snprintf(line, sizeof line, "  %-17s %g to %g: %s\n", std::string(k.id).c_str(), static_cast<double>(k.least), static_cast<double>(k.most), std::string(k.help).c_str());
        text += line;
    }
    return text;
}

nlohmann::ordered_json classic_report(const FurPicture& p) {
    const LayersLight& l = *p.light;
    const auto rounded = [](float v) { return std::round(static_cast<double>(v) * 1e4) / 1e4; };
    return {{"ambient", rounded(l.ambient)}, {"diffuse", rounded(l.diffuse)}, {"specular", rounded(l.specular)}, {"power", rounded(l.power)}};
}

}  // namespace relievo
