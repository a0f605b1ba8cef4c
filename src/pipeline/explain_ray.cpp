#include "pipeline/explain_ray.h"

#include "assets/atomic_file.h"
#include "assets/image_file.h"
#include "core/error.h"
#include "explain/search_figure.h"
#include "figure/raster.h"
#include "figure/svg.h"
#include "pipeline/map_set_bake.h"
#include "pipeline/shown_picture.h"
#include "reference/cast.h"
#include "scenes/scene.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <numbers>

namespace relievo {

namespace {

RayQuestion question_of(const ExplainSettings& s, const BakedMaps& baked, std::string& which) {
    RayQuestion q{.uv = {}, .view = {}, .height_scale = baked.height_scale, .zero_level = baked.zero_level};
    char words[160];
    if (s.uv) {
        const double e = s.elevation_deg * std::numbers::pi / 180, a = s.azimuth_deg * std::numbers::pi / 180;
        q.uv = *s.uv;
        q.view = {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
        which = "A ray";
    } else {
        const Vec2i pixel = s.pixel.value_or(Vec2i{s.width / 2, s.height / 2});
        if (pixel.x < 0 || pixel.y < 0 || pixel.x >= s.width || pixel.y >= s.height)
            throw UsageError("--pixel " + std::to_string(pixel.x) + "," + std::to_string(pixel.y) + " is outside of the picture of " +
                             std::to_string(s.width) + " x " + std::to_string(s.height) + " pixels");
        const RayField rays = quad_rays(stage_for(s.view), s.width, s.height, {0, 0});
        if (rays.coverage(pixel.x, pixel.y) != static_cast<std::uint8_t>(Coverage::hit))
            throw Error("explain", "pixel " + std::to_string(pixel.x) + "," + std::to_string(pixel.y), "its ray does not meet the polygon",
                        "take a pixel farther down; the middle is " + std::to_string(s.width / 2) + "," + std::to_string(s.height / 2));
        q.uv = {rays.uv(pixel.x, pixel.y, 0), rays.uv(pixel.x, pixel.y, 1)};
        q.view = normalize(Vec3d{rays.view(pixel.x, pixel.y, 0), rays.view(pixel.x, pixel.y, 1), rays.view(pixel.x, pixel.y, 2)});
        q.lod = rays.lod(pixel.x, pixel.y);
        std::snprintf(words, sizeof words, "Pixel %d,%d of %d x %d, view %s", pixel.x, pixel.y, s.width, s.height, s.view.id.c_str());
        which = words;
    }
    const double elevation = std::asin(std::clamp(q.view.z, -1.0, 1.0)) * 180 / std::numbers::pi;
    const double azimuth = std::atan2(q.view.y, q.view.x) * 180 / std::numbers::pi;
    std::snprintf(words, sizeof words, ": meets the polygon at UV (%.4f, %.4f), seen %.1f degrees above it from azimuth %.1f.", q.uv.x, q.uv.y, elevation, azimuth);
    which += words;
    return q;
}

}  // namespace

Explained explain_ray(const ExplainSettings& settings, const Progress& progress) {
    const std::filesystem::path out = settings.out;
    const bool png = out.extension() == ".png";
    if (!out.empty() && !png && out.extension() != ".svg") throw UsageError("--out " + settings.out + ": a figure is written as .svg or .png");
    if (png && settings.paper == Paper::either) throw UsageError("--paper either is for .svg; a .png is light or dark");
    if (!out.empty()) require_writable(out);

    report(progress, "loading", 0);
    std::vector<Map> wanted{Map::height, Map::normal};
    for (const auto& asked : settings.techniques)
        for (const Map m : asked.technique->maps) wanted.push_back(m);
    Material material = load_source(settings.material);
    const std::string name = material.name;
    const BakedMaps baked = bake_maps(std::move(material), wanted, {.threads = settings.material.threads, .use_cache = settings.use_cache, .progress = progress});

    Explained result;
    const RayQuestion question = question_of(settings, baked, result.where);
    const Vec2d uv_per_height = Vec2d{question.view.x, question.view.y} * (static_cast<double>(question.height_scale) / std::max(question.view.z, 0.0005));
    const ReferenceHit truth = reference_cast(baked.maps.height, {.uv = question.uv, .uv_per_height = uv_per_height, .zero_level = question.zero_level});
    result.section = section_of(baked.maps, question, truth.uv, truth.height);
    for (const auto& asked : settings.techniques) {
        result.searches.push_back(search_along(result.section, *asked.technique, asked.params, baked.maps));
        report(progress, "searching", static_cast<double>(result.searches.size()) / static_cast<double>(settings.techniques.size()));
    }
    result.notes = baked.notes;
    if (out.empty()) return result;

    const Drawing figure = search_figure(result.section, result.searches, baked.maps.height, {.heading = name, .where = result.where});
    if (png) {
        write_png(out, raster(figure, settings.paper, settings.scale), FirstRow::top);
    } else {
        write_file_atomically(out, svg_text(figure, settings.paper));
    }
    return result;
}

}  // namespace relievo
