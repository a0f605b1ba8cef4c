#include "sample_results.h"

#include "core/parallel_for.h"
#include "maps/map_kinds.h"
#include "report/pixels.h"
#include "scenes/scene.h"
#include "techniques/catalogue.h"

#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>

namespace relievo::test {


namespace {

constexpr double pi = 3.14159265358979323846;
constexpr int texels = 96;
constexpr float zero_level = 1;

// --- a PNG, since a browser must open it and nothing of ours below assets writes one ----------------------------------------

void put_word(std::string& out, std::uint32_t v) {
    for (int shift = 24; shift >= 0; shift -= 8) out += static_cast<char>(v >> shift & 255);
}

void chunk(std::string& out, std::string body) {  // body: type and data
    put_word(out, static_cast<std::uint32_t>(body.size() - 4));
    const uLong check = crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()));
    out += body;
    put_word(out, static_cast<std::uint32_t>(check));
}

void write_png(const std::filesystem::path& path, const Image8& image) {
    std::string raw;
    const auto row_bytes = static_cast<std::size_t>(image.width) * 3;
    for (int y = 0; y < image.height; ++y) {
        raw += '\0';
        raw.append(reinterpret_cast<const char*>(image.at(0, y)), row_bytes);
    }
    uLongf size = compressBound(static_cast<uLong>(raw.size()));
    std::string packed(size, '\0');
    compress(reinterpret_cast<Bytef*>(packed.data()), &size, reinterpret_cast<const Bytef*>(raw.data()), static_cast<uLong>(raw.size()));
    packed.resize(size);
    std::string png = "\x89PNG\r\n\x1a\n";
    std::string header = "IHDR";
    put_word(header, static_cast<std::uint32_t>(image.width));
    put_word(header, static_cast<std::uint32_t>(image.height));
    header += std::string("\x08\x02\x00\x00\x00", 5);
    chunk(png, header);
    chunk(png, "IDAT" + packed);
    chunk(png, "IEND");
    write_text(path, png);
}

// --- relief --------------------------------------------------------------------------------------------------------------

double stones(double u, double v) {
    double h = 0;
    const int cells = 4;
    for (int j = -1; j <= cells; ++j) {
        for (int i = -1; i <= cells; ++i) {
            const int a = (i + cells) % cells, b = (j + cells) % cells;
            const double cx = (i + 0.5 + 0.22 * std::sin(a * 5.1 + b * 9.7)) / cells, cy = (j + 0.5 + 0.22 * std::cos(a * 7.3 + b * 3.9)) / cells;
            const double r = (0.47 + 0.09 * std::sin(a * 2.3 + b * 4.1)) / cells;
            const double d2 = ((u - cx) * (u - cx) + (v - cy) * (v - cy)) / (r * r);
            if (d2 < 1) h = std::max(h, (0.75 + 0.25 * std::sin(a * 8.9 + b * 1.7)) * std::pow(1 - d2 * d2, 0.4));
        }
    }
    return 0.06 + 0.92 * h;
}

double spikes(double u, double v) {
    const double x = u * 8, y = v * 8;
    const double i = std::floor(x), j = std::floor(y);
    const double d = std::hypot(x - i - 0.5, y - j - 0.5);
    return 0.05 + 0.9 * (0.6 + 0.4 * std::sin(i * 3.3 + j * 7.7)) * std::max(0.0, 1 - d / 0.3);
}

struct Relief {
    const char* name;
    double (*height)(double, double);
    float height_scale;
    double colour[3];
};
constexpr Relief reliefs[] = {{"river_cobbles", stones, 0.16f, {0.62, 0.58, 0.52}}, {"thin_spikes", spikes, 0.12f, {0.55, 0.62, 0.60}}};

MapSet maps_of(const Relief& relief) {
    MapSet maps;
    maps.height = HeightField(texels, texels);
    for (int j = 0; j < texels; ++j)
        for (int i = 0; i < texels; ++i) maps.height.texels(i, j) = static_cast<float>(relief.height((i + 0.5) / texels, (j + 0.5) / texels));
    ImageF normal(texels, texels, 3);
    for (int j = 0; j < texels; ++j) {
        for (int i = 0; i < texels; ++i) {
            const float k = relief.height_scale * texels / 2;
            const Vec3f n = normalize(Vec3f{k * (maps.height.wrapped(i - 1, j) - maps.height.wrapped(i + 1, j)),
                                            k * (maps.height.wrapped(i, j - 1) - maps.height.wrapped(i, j + 1)), 1});
            normal(i, j, 0) = n.x, normal(i, j, 1) = n.y, normal(i, j, 2) = n.z;
        }
    }
    maps.normal = {normal};
    // 96 cells: padded to 128, eight levels.
    maps.max_pyramid = {texels, texels, {}};
    for (int size = 128, level = 0; size >= 1; size /= 2, ++level) {
        ImageF nodes(size, size, 1);
        for (int j = 0; j < size; ++j) {
            for (int i = 0; i < size; ++i) {
                if (level == 0) {
                    if (i < texels && j < texels) nodes(i, j) = std::ranges::max(maps.height.cell(i, j));
                } else {
                    const ImageF& below = maps.max_pyramid.levels.back();
                    nodes(i, j) = std::max({below(2 * i, 2 * j), below(2 * i + 1, 2 * j), below(2 * i, 2 * j + 1), below(2 * i + 1, 2 * j + 1)});
                }
            }
        }
        maps.max_pyramid.levels.push_back(nodes);
    }
    maps.cone = ImageF(texels, texels, 2);
    parallel_for(texels, 4, 0, [&](int begin, int end) {
        for (int j = begin; j < end; ++j) {
            for (int i = 0; i < texels; ++i) {
                const float h = maps.height.wrapped(i, j);
                // Looks only so far, and so never claims a cone that is wider.
                constexpr int radius = texels / 6;
                float ratio = static_cast<float>(radius) / texels;
                for (int y = -radius; y <= radius; ++y) {
                    for (int x = -radius; x <= radius; ++x) {
                        const float rise = maps.height.wrapped(i + x, j + y) - h;
                        if (rise > 0) ratio = std::min(ratio, std::hypot(static_cast<float>(x), static_cast<float>(y)) / texels / rise);
                    }
                }
                maps.cone(i, j, 0) = h, maps.cone(i, j, 1) = ratio;
            }
        }
    });
    // The others from the program's bakers: the table's techniques read them.
    for (const MapKind& kind : map_kinds())
        if (kind.bake != nullptr && kind.image != nullptr && (maps.*kind.image).empty())
            kind.bake(maps, {.height_scale = relief.height_scale, .threads = 0, .progress = {}});
    return maps;
}

// --- pictures ------------------------------------------------------------------------------------------------------------

Frame trace(const RayField& rays, const MapSet& maps, const Relief& relief, const Stage& stage, const Technique& technique, const MarchParams& params) {
    Frame frame(rays.width, rays.height);
    const Vec3f sun = stage.lighting.lights[0].position;
    parallel_for(rays.height, 4, 0, [&](int begin, int end) {
        glsl::bound_maps = {.maps = &maps, .readable = MapFlags().set()};
        for (int y = begin; y < end; ++y) {
            for (int x = 0; x < rays.width; ++x) {
                float light[3] = {0.02f, 0.02f, 0.024f};
                if (rays.coverage(x, y) != 0) {
                    const float vx = rays.view(x, y, 0), vy = rays.view(x, y, 1), vz = rays.view(x, y, 2);
                    const float speed = relief.height_scale / std::max(vz, 5e-4f);
                    const glsl::SurfaceRay ray{.uv = {rays.uv(x, y, 0), rays.uv(x, y, 1)}, .uv_per_height = {vx * speed, vy * speed}, .view = {vx, vy, vz},
                                               .height_scale = relief.height_scale, .zero_level = zero_level, .z_start = 1, .z_end = 0, .lod = rays.lod(x, y)};
                    glsl::fetch_count = 0;
                    const glsl::SurfaceHit hit = technique.heightfield(ray, params);
                    frame.fetches(x, y) = static_cast<float>(glsl::fetch_count);
                    frame.coverage(x, y) = static_cast<std::uint8_t>(hit.found ? Coverage::hit : Coverage::no_hit);
                    if (hit.found) {
                        frame.hit_uv(x, y, 0) = hit.uv.x, frame.hit_uv(x, y, 1) = hit.uv.y, frame.hit_height(x, y) = hit.height;
                        const glsl::vec3 n = technique.shaded_by == ShadedBy::normal_map ? glsl::normal_at(hit.uv, -8) : glsl::vec3(0, 0, 1);
                        const double h = maps.height.sample({hit.uv.x, hit.uv.y});
                        const double lit = 0.12 + 1.1 * std::max(0.0f, n.x * sun.x + n.y * sun.y + n.z * sun.z);
                        const double grain = 0.86 + 0.14 * std::sin(hit.uv.x * 61 + 3 * std::sin(hit.uv.y * 43));
                        for (int c = 0; c < 3; ++c) light[c] = static_cast<float>(lit * grain * relief.colour[c] * (0.35 + 0.65 * h));
                    }
                }
                for (int c = 0; c < 3; ++c) frame.colour(x, y, c) = light[c];
            }
        }
    });
    return frame;
}

std::uint8_t encoded(double linear) {
    const double v = std::clamp(linear, 0.0, 1.0);
    return static_cast<std::uint8_t>(std::lround(255 * (v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055)));
}

Image8 picture_of(const Frame& frame) {
    Image8 image(frame.width, frame.height, 3);
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x)
            for (int c = 0; c < 3; ++c) image(x, y, c) = encoded(frame.colour(x, y, c));
    return image;
}

struct Stop { const char* label; std::uint8_t rgb[3]; };
constexpr Stop error_stops[] = {{"early 16", {33, 102, 172}}, {"4", {103, 169, 207}}, {"1", {209, 229, 240}}, {"0", {250, 250, 248}}, {"1", {253, 219, 199}}, {"4", {239, 138, 98}}, {"late 16", {178, 24, 43}}};
constexpr Stop fetch_stops[] = {{"0", {12, 8, 38}}, {"16", {81, 18, 124}}, {"32", {183, 55, 121}}, {"48", {252, 137, 97}}, {"64", {252, 253, 191}}};

template <std::size_t count>
void paint(Image8& image, int x, int y, const Stop (&stops)[count], double share) {
    const double at = std::clamp(share, 0.0, 1.0) * (count - 1);
    const auto i = std::min(static_cast<std::size_t>(at), count - 2);
    for (int c = 0; c < 3; ++c) image(x, y, c) = static_cast<std::uint8_t>(std::lround(stops[i].rgb[c] + (at - static_cast<double>(i)) * (stops[i + 1].rgb[c] - stops[i].rgb[c])));
}

struct Judged {
    Measurement m;
    Image8 error, fetches;
};

Judged judge(const Frame& picture, const Frame& truth, const RayField& rays) {
    Judged out{{}, Image8(rays.width, rays.height, 3, 40), Image8(rays.width, rays.height, 3, 40)};
    std::vector<double> far, high, cost;
    double missed = 0, early = 0, all = 0, colour = 0;
    for (int y = 0; y < rays.height; ++y) {
        for (int x = 0; x < rays.width; ++x) {
            if (rays.coverage(x, y) == 0 || truth.coverage(x, y) != 1) continue;
            ++all;
            double signed_error = 99;
            if (picture.coverage(x, y) == 1) {
                const double du = (picture.hit_uv(x, y, 0) - truth.hit_uv(x, y, 0)) * texels, dv = (picture.hit_uv(x, y, 1) - truth.hit_uv(x, y, 1)) * texels;
                far.push_back(std::hypot(du, dv));
                high.push_back(std::abs(picture.hit_height(x, y) - truth.hit_height(x, y)));
                signed_error = du * -rays.view(x, y, 0) + dv * -rays.view(x, y, 1) > 0 ? far.back() : -far.back();
            }
            missed += signed_error > 0.5, early += signed_error < -0.5;
            cost.push_back(picture.fetches(x, y));
            for (int c = 0; c < 3; ++c) colour += std::abs(encoded(picture.colour(x, y, c)) - encoded(truth.colour(x, y, c))) / 765.0;
            const double level = std::log2(1 + std::abs(signed_error)) / std::log2(17.0);
            paint(out.error, x, y, error_stops, 0.5 + 0.5 * std::copysign(level, signed_error));
            paint(out.fetches, x, y, fetch_stops, picture.fetches(x, y) / 64);
        }
    }
    const auto percentile = [](std::vector<double>& values, double share) {
        std::ranges::sort(values);
        return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
    };
    out.m.missed_first_hit = missed / all;
    out.m.early_hit = early / all;
    out.m.uv_error_texels = Percentiles{percentile(far, 0.5), percentile(far, 0.99), far.back()};
    out.m.height_error = Percentiles{percentile(high, 0.5), percentile(high, 0.99), high.back()};
    out.m.normal_error_deg = Percentiles{0, 90 * percentile(high, 0.99), 90 * high.back()};
    out.m.shadow_mismatch = Measured<double>::missing("shadows were switched off");
    out.m.flip = colour / all;
    out.m.ssim = 1 - colour / all;
    if (colour > 0) out.m.psnr_db = -20 * std::log10(colour / all);
    else out.m.psnr_db = Measured<double>::missing("the pictures are identical, so the ratio is infinite");
    const double mean = [&] { double sum = 0; for (const double c : cost) sum += c; return sum / all; }();
    out.m.fetches = FetchCount{mean, percentile(cost, 0.95), cost.back()};
    const double ms = 1.1 + 0.045 * mean;
    out.m.gpu_ms = TimeSpread{ms * 0.97, ms, ms * 1.2, 11};
    return out;
}

Row row_for(const Technique& technique, const Relief& relief, const View& view, const KnobValues& knobs, Measurement m) {
    Row row;
    row.technique = technique.id;
    row.material = relief.name;
    row.view = view.id;
    row.elevation_deg = view.elevation_deg;
    row.knobs = knobs;
    row.m = std::move(m);
    return row;
}

template <std::size_t count>
Legend legend_of(const char* title, const char* unit, const Stop (&stops)[count]) {
    Legend legend{.title = title, .unit = unit, .low_end = "low", .high_end = "high"};
    for (std::size_t i = 0; i < count; ++i) {
        const auto& rgb = stops[i].rgb;
        const Rgb8 colour{static_cast<std::uint8_t>(rgb[0]), static_cast<std::uint8_t>(rgb[1]), static_cast<std::uint8_t>(rgb[2])};
        legend.stops.push_back({static_cast<double>(i) / (count - 1), static_cast<double>(i), colour, std::string(stops[i].label)});
    }
    legend.keys.push_back({{128, 128, 128}, "background"});
    return legend;
}

Manifest sample_manifest() {
    Manifest m;
    m.command = "relievo compare --material river_cobbles --material \"thin <spikes>\" --view grazing --view middle --view steep --out report";
    m.version = "0.1.0";
    m.date = "2026-01-31T12:00:00Z";
    m.device = "llvmpipe (LLVM 15.0.6, 256 bits)";
    m.driver = "Mesa 22.3.6";
    m.runs = 11;
    m.samples_per_pixel = 16;
    m.shadow = "none";
    m.threads = 2;
    m.seconds = 73.4;
    m.docs = "docs/techniques";
    return m;
}

}  // namespace

void write_text(const std::filesystem::path& path, const std::string& text) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
}

Results sample_results(const std::filesystem::path& folder, const SampleSettings& settings) {
    Results results;
    results.manifest = sample_manifest();
    results.manifest.width = settings.width;
    results.manifest.height = settings.height;
    results.error_legend = legend_of("UV error along the ray", "texels", error_stops);
    results.fetches_legend = legend_of("Fetches", "per pixel", fetch_stops);
    results.maps = {{Map::height, "height", "Height", "height of the surface in [0,1]"}, {Map::normal, "normal", "Normal", "unit normal, tangent space"},
                    {Map::cone, "cone", "Cone", "widest empty cone above each texel"}, {Map::max_pyramid, "max_pyramid", "Maximum pyramid", "largest height of ever larger cells"}};
    const Technique& exact = *find_technique("max_mip_tracing");
    for (int i = 0; i < settings.materials; ++i) {
        const Relief& relief = reliefs[i];
        const MapSet maps = maps_of(relief);
        results.manifest.materials.push_back({relief.name, texels, texels, relief.height_scale, zero_level, i == 0 ? std::optional(0.6) : std::nullopt,
            i == 0 ? std::vector<std::string>{"height_scale was not given: 0.16 assumed", "the green channel points down (correlation of slope and gradient -0.94): flipped"} : std::vector<std::string>{},
            "5f3a9c27d1b04e68"});
        for (const View& view : views()) {
            const Stage stage = stage_for(view);
            const RayField rays = quad_rays(stage, settings.width, settings.height, {0, 0});
            const RayField few = quad_rays(stage, 64, 36, {0, 0});
            const Frame truth = trace(rays, maps, relief, stage, exact, default_params(exact));
            const Frame few_truth = trace(few, maps, relief, stage, exact, default_params(exact));
            const std::string place = std::string("pictures/") + relief.name + "/" + view.id + "/";
            const PixelSettings pixels{texels, texels};
            if (settings.pictures) {
                write_png(folder / (place + "reference.png"), picture_of(truth));
                write_text(folder / (place + "reference.js"), reference_pixel_script(truth));
            }
            for (const Technique& technique : techniques()) {
                const MarchParams params = default_params(technique);
                KnobValues knobs;
                for (const KnobDefault& d : technique.knobs) knobs.emplace_back(d.knob->id, static_cast<double>(d.value));
                const Frame frame = trace(rays, maps, relief, stage, technique, params);
                const Judged judged = judge(frame, truth, rays);
                Row row = row_for(technique, relief, view, knobs, judged.m);
                if (settings.pictures) {
                    const std::string base = place + std::string(technique.id);
                    row.image = base + ".png", row.error_image = base + "_wrong.png", row.fetches_image = base + "_fetches.png";
                    row.reference_image = place + "reference.png", row.pixels = base + ".js", row.reference_pixels = place + "reference.js";
                    row.where = where_it_is_wrong(frame, truth, rays, pixels);
                    write_png(folder / row.image, picture_of(frame));
                    write_png(folder / row.error_image, judged.error);
                    write_png(folder / row.fetches_image, judged.fetches);
                    write_text(folder / row.pixels, pixel_script(frame, truth, rays, pixels));
                } else {
                    row.no_picture = "pictures were switched off";
                }
                results.rows.push_back(row);
                if (technique.knobs.count == 0) continue;
                const Knob& knob = *technique.knobs.items[0].knob;
                const float value = technique.knobs.items[0].value;
                for (const float factor : {0.125f, 0.25f, 0.5f, 2.0f, 4.0f}) {
                    MarchParams p = params;
                    knob.set(p, value * factor);
                    if (knob.get(p) == value) continue;
                    knobs[0].second = knob.get(p);
                    results.sweep.push_back(row_for(technique, relief, view, knobs, judge(trace(few, maps, relief, stage, technique, p), few_truth, few).m));
                }
            }
        }
    }
    return results;
}

Results many_rows(int materials, int settings_per_technique) {
    Results results;
    results.manifest = sample_manifest();
    results.manifest.width = 640;
    results.manifest.height = 360;
    for (int i = 0; i < materials; ++i) {
        const std::string name = "material_" + std::to_string(i);
        results.manifest.materials.push_back({name, 1024, 1024, 0.05, 1, std::nullopt, {"height_scale was not given: 0.05 assumed"}, "0123456789abcdef"});
        for (const View& view : views()) {
            int t = 0;
            for (const Technique& technique : techniques()) {
                ++t;
                for (int s = 0; s < (technique.knobs.count ? settings_per_technique : 1); ++s) {
                    const double wrong = technique.exact ? 0 : 0.3 / t / (s + 1) * (1 + 0.5 * std::sin(i * 1.7 + view.elevation_deg));
                    Measurement m;
                    m.missed_first_hit = wrong, m.early_hit = wrong / 7, m.astray = wrong / 2, m.astray_budget = wrong / 2 + 0.001, m.flip = wrong / 3, m.ssim = 1 - wrong, m.psnr_db = 30 / (1 + wrong);
                    m.uv_error_texels = Percentiles{wrong, wrong * 31, wrong * 77}, m.height_error = Percentiles{wrong / 9, wrong / 5, wrong};
                    m.normal_error_deg = Percentiles{wrong, wrong * 10, wrong * 90}, m.shadow_mismatch = wrong / 11;
                    m.fetches = FetchCount{4.123456 * t * (s + 1), 6.0 * t * (s + 1), 9.0 * t * (s + 1)};
                    m.gpu_ms = TimeSpread{1.01 + t * 0.2 * (s + 1), 1.12 + t * 0.2 * (s + 1), 2.0 + t * 0.2 * (s + 1), 11};
                    Row row = row_for(technique, {name.c_str(), nullptr, 0, {}}, view, {}, m);
                    for (const KnobDefault& d : technique.knobs) row.knobs.emplace_back(d.knob->id, static_cast<double>(d.value) * (s + 1));
                    if (s == 0) {
                        const std::string base = "pictures/" + name + "/" + view.id + "/" + std::string(technique.id);
                        row.image = base + ".png", row.error_image = base + "_wrong.png", row.fetches_image = base + "_fetches.png";
                        row.reference_image = "pictures/" + name + "/" + view.id + "/reference.png";
                    }
                    (s == 0 ? results.rows : results.sweep).push_back(row);
                }
            }
        }
    }
    return results;
}

}  // namespace relievo::test
