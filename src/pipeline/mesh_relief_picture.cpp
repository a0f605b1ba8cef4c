#include "pipeline/mesh_relief_picture.h"

#include "assets/mesh_file.h"
#include "core/error.h"
#include "measure/hits.h"
#include "mesh/bounds.h"
#include "mesh/charts.h"
#include "mesh/made_up_atlas.h"
#include "mesh/normals.h"
#include "mesh/relief_rays.h"
#include "pipeline/map_set_bake.h"
#include "reference/mesh_hits.h"
#include "render/mesh_relief.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace relievo {

namespace {

// Surfaces seen one behind another through open edges of charts. A ray that passes more of them shows what is behind the mesh.
constexpr int most_layers = 8;

Mesh mesh_of(const std::string& name, int threads) {
    if (const UnwrappedShape* shape = find_unwrapped_shape(name)) return shape->make();
    Mesh mesh = load_mesh(name, threads);
    if (mesh.uvs.empty())
        throw Error("put a relief on", name, "the mesh has no texture coordinates", "unwrap it, or take a made-up one: cube, cylinder, torus");
    if (mesh.normals.empty()) mesh.normals = continuous_normals(mesh, NormalMode::angle, threads);
    return mesh;
}

void require_supported(const DrawOptions& options) {
    const DrawOptions usual;
    for (const Modifier& m : modifiers()) {
        const int value = options.*m.choice;
        const bool known = value == usual.*m.choice || (m.choice == &DrawOptions::shadow && value == glsl::shadow_none) ||
                           (m.choice == &DrawOptions::border && value == glsl::border_chart);
        if (!known) throw UsageError("on a mesh there is no --" + std::string(m.id) + " " + std::string(m.value(options).id) + "; relief has --shadow none or hard and --border repeat or chart there");
    }
}

// The view's elevation and azimuth around the mesh, with y up.
Camera camera_for(const View& view, const Sphere& sphere, int width, int height) {
    const double e = view.elevation_deg * std::numbers::pi / 180;
    const double a = view.azimuth_deg * std::numbers::pi / 180;
    Camera camera;
    camera.up = {0, 1, 0};
    camera.target = sphere.centre;
    camera.fov_y_rad = 0.6;
    const double half = std::min(0.3, std::atan(std::tan(0.3) * width / height));  // of the narrower angle of view
    const double distance = std::max(sphere.radius, 1e-9) / std::sin(half) * 1.05 * view.distance;
    camera.eye = sphere.centre + Vec3d{std::cos(e) * std::cos(a), std::sin(e), -std::cos(e) * std::sin(a)} * distance;
    return camera;
}

// The usual lights, placed by the eye: the key from the upper left, so that every side that is seen has light and shadow.
Lighting lighting_for(const View& view, const Camera& camera) {
    Lighting lighting = stage_for(view).lighting;
    const Camera::Axes axes = camera.axes();
    lighting.lights[0].position = Vec3f(normalize(axes.back * 0.6 + axes.up * 0.7 - axes.right));
    lighting.lights[1].position = Vec3f(normalize(axes.back * 0.7 + axes.right - axes.up * 0.2));
    return lighting;
}

}  // namespace

MeshReliefPicture mesh_relief_picture(const RenderSettings& settings, const Progress& progress) {
    require_supported(settings.picture.options);
    report(progress, "loading", 0);
    const Mesh mesh = mesh_of(settings.mesh, settings.material.threads);
    const Charts charts = find_charts(mesh);

    const std::size_t drawn = settings.technique != nullptr ? 1 : 0;
    const BakedMaps baked = bake_maps(load_source(settings.material), maps_to_draw(std::span(&settings.technique, drawn), {}),
                                      {.threads = settings.material.threads, .use_cache = settings.use_cache, .progress = progress});
    const PictureSettings& picture = settings.picture;
    const Camera camera = camera_for(settings.view, bounding_sphere(mesh.positions), picture.width, picture.height);
    const Lighting lighting = lighting_for(settings.view, camera);
    const bool ends = picture.options.border == glsl::border_chart;
    const bool shadow = picture.options.shadow != glsl::shadow_none;
    const ShadedBy shaded_by = settings.technique != nullptr ? settings.technique->shaded_by : ShadedBy::normal_map;

    MeshReliefPicture result{.frame = Frame(picture.width, picture.height), .facts = {}, .notes = baked.notes};
    MeshFacts& facts = result.facts;
    facts.faces = mesh.faces();
    facts.charts = charts.count;
    result.notes.insert(result.notes.begin(), mesh.notes.begin(), mesh.notes.end());
    const double steps = static_cast<double>(picture.offsets.size());
    ImageF sum(picture.width, picture.height, 3);
    for (std::size_t sample = 0; sample < picture.offsets.size(); ++sample) {
        report(progress, "drawing", static_cast<double>(sample) / steps);
        Frame seen(picture.width, picture.height);
        for (float& c : seen.colour.texels) c = 0;
        ImageF beyond(picture.width, picture.height, 1);
        for (int layer = 0; layer < most_layers; ++layer) {
            const MeshRays rays = relief_rays(mesh, charts, camera,
                                              {.width = picture.width,
                                               .height = picture.height,
                                               .offset = Vec2d(picture.offsets[sample]),
                                               .repeats = settings.repeats,
                                               .height_scale = static_cast<double>(baked.height_scale),
                                               .zero_level = static_cast<double>(baked.zero_level),
                                               .ends_with_chart = ends,
                                               .beyond = layer > 0 ? &beyond : nullptr,
                                               .threads = settings.material.threads});
            ChartShare on_chart;
            if (ends)
                on_chart = [&](int x, int y, Vec2d first, Vec2d way) {
                    const std::uint32_t face = rays.face[static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x)];
                    const Vec2d from = Vec2d{rays.rays.uv(x, y, 0), rays.rays.uv(x, y, 1)} * (1 / settings.repeats);
                    const ChartWalk there = walk_chart(mesh, charts, face, from, first * (1 / settings.repeats));
                    return walk_chart(mesh, charts, there.face, from + first * (1 / settings.repeats), way * (1 / settings.repeats)).share;
                };
            const MeshReliefSettings relief{.zero_level = baked.zero_level, .material_scale = baked.height_scale, .shadow = shadow, .on_chart = on_chart, .threads = settings.material.threads};
            const bool judged = sample == 0 && layer == 0;
            Frame exact;
            if (judged || settings.technique == nullptr) {
                exact = reference_mesh_hits(rays, baked.maps.height, lighting,
                                            {.zero_level = static_cast<double>(baked.zero_level), .shadow = shadow, .on_chart = on_chart, .threads = settings.material.threads});
                shade_mesh(exact, rays, baked.maps, shaded_by, lighting, relief);
            }
            Frame hits = exact;
            if (settings.technique != nullptr) {
                hits = trace_mesh(rays, baked.maps, *settings.technique, settings.params, lighting, relief);
                shade_mesh(hits, rays, baked.maps, shaded_by, lighting, relief);
            }
            if (judged) {
                const HitMetrics m = hit_metrics(hits, exact, rays.rays, {baked.maps.height.width(), baked.maps.height.height()}, settings.material.threads);
                facts.missed_first_hit = m.missed_first_hit;
                facts.early_hit = m.early_hit;
                facts.uv_error_texels = m.uv_error_texels;
                for (std::size_t i = 0; i < exact.coverage.texels.size(); ++i) {
                    const auto c = static_cast<Coverage>(exact.coverage.texels[i]);
                    facts.judged += c == Coverage::hit ? 1 : 0;
                    facts.holes += c == Coverage::no_hit ? 1 : 0;
                    facts.holes_filled += c == Coverage::no_hit && static_cast<Coverage>(hits.coverage.texels[i]) == Coverage::hit ? 1 : 0;
                }
            }
            bool open = false;
            for (int y = 0; y < picture.height; ++y) {
                for (int x = 0; x < picture.width; ++x) {
                    const auto c = static_cast<Coverage>(hits.coverage(x, y));
                    if (c == Coverage::no_hit) {
                        beyond(x, y) = rays.distance(x, y) * (1 + 1e-6f);
                        open = true;
                        continue;
                    }
                    beyond(x, y) = 1e30f;
                    if (c == Coverage::background) continue;
                    const auto copy = [&](ImageF Frame::*plane) {
                        std::copy_n((hits.*plane).at(x, y), (hits.*plane).channels, (seen.*plane).at(x, y));
                    };
                    for (const auto plane : {&Frame::colour, &Frame::hit_uv, &Frame::hit_height, &Frame::normal, &Frame::shadow, &Frame::fetches}) copy(plane);
                    seen.coverage(x, y) = hits.coverage(x, y);
                }
            }
            seen.source = hits.source;
            if (!open) break;
        }
        for (int y = 0; y < picture.height; ++y)
            for (int x = 0; x < picture.width; ++x) {
                const bool hit = seen.coverage(x, y) == static_cast<std::uint8_t>(Coverage::hit);
                const float background[3] = {lighting.background.x, lighting.background.y, lighting.background.z};
                for (int c = 0; c < 3; ++c) sum(x, y, c) += (hit ? seen.colour(x, y, c) : background[c]) / static_cast<float>(steps);
            }
        if (sample == 0) result.frame = std::move(seen);
    }
    result.frame.colour = std::move(sum);
    report(progress, "drawing", 1);
    return result;
}

}  // namespace relievo
