#include "pipeline/vary_modifier.h"

#include "assets/frame_file.h"
#include "assets/image_file.h"
#include "core/error.h"
#include "maps/back_side.h"
#include "measure/display_values.h"
#include "measure/flip.h"
#include "measure/psnr.h"
#include "pipeline/compare.h"
#include "pipeline/map_set_bake.h"
#include "pipeline/picture_sheet.h"
#include "pipeline/reference_picture.h"
#include "render/gpu_renderer.h"
#include "techniques/catalogue.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>

namespace relievo {

namespace {

namespace fs = std::filesystem;

// The picture under many samples, a few fields of rays at a time: those of hundreds of samples would not fit into memory at once.
Frame sampled_truth(GpuRenderer& gpu, const Stage& stage, const GpuMaterial& material, const MapSet& maps, int width, int height,
                    std::span<const Vec2f> offsets, const ReferencePicture& settings, const Progress& progress) {
    constexpr std::size_t at_once = 16;
    Frame truth;
    for (std::size_t begin = 0; begin < offsets.size(); begin += at_once) {
        const auto part = offsets.subspan(begin, std::min(at_once, offsets.size() - begin));
        std::vector<RayField> rays;
        for (const Vec2f offset : part) rays.push_back(gpu.rays(stage, material, width, height, offset));
        Frame frame = reference_picture(stage, maps, rays, settings);
        const float share = static_cast<float>(part.size()) / static_cast<float>(offsets.size());
        for (float& c : frame.colour.texels) c *= share;
        if (begin == 0) {
            truth = std::move(frame);
        } else {
            for (std::size_t i = 0; i < truth.colour.texels.size(); ++i) truth.colour.texels[i] += frame.colour.texels[i];
        }
        report(progress, "reference", static_cast<double>(begin + part.size()) / static_cast<double>(offsets.size()));
    }
    return truth;
}

double shadow_error(const Frame& picture, const Frame& truth) {
    double sum = 0;
    int pixels = 0;
    constexpr auto hit = static_cast<std::uint8_t>(Coverage::hit);
    for (std::size_t i = 0; i < truth.coverage.texels.size(); ++i) {
        if (picture.coverage.texels[i] != hit || truth.coverage.texels[i] != hit) continue;
        sum += std::abs(picture.shadow.texels[i] - truth.shadow.texels[i]);
        ++pixels;
    }
    return pixels > 0 ? sum / pixels : 0;
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values.empty() ? 0 : values[values.size() / 2];
}

}  // namespace

VarySettings example_of(const Modifier& modifier) {
    VarySettings s{.modifier = &modifier, .materials = {{.folder = "cobbles"}}, .views = {*parse_view("middle")}};
    s.width = 300;
    s.height = 170;
    s.runs = 1;
    s.samples = 9;
    s.options.numbers.light_radius = 0.1f;
    s.options.numbers.facets = 24;
    s.options.numbers.metallic = 1;
    s.options.numbers.roughness = 0.35f;
    if (modifier.id == "sides") {
        s.materials = {{.folder = "engraving"}};
        s.views = {*parse_view("35"), *parse_view("-35")};
    }
    if (modifier.id == "edge") {  // as a pixel without further samples shows it
        s.samples = 1;
        s.truth_samples = 81;
        s.width = 120;
        s.height = 68;
        s.magnified = 4;
        s.options.border = glsl::border_chart;
        s.views = {*parse_view("20@0.3")};
    } else if (modifier.id == "mip" || modifier.id == "fade") {  // far enough for a pixel to cover many texels
        s.samples = 1;
        s.truth_samples = 81;
        s.views = {*parse_view("grazing@4")};
    } else if (modifier.id == "border") {  // one repeat and a fifth, so that the texture's end and the polygon's differ and both show
        s.views = {*parse_view("20@0.4")};
    } else if (modifier.id != "shadow" && modifier.id != "shading" && modifier.id != "sides") {
        s.views = {*parse_view("grazing")};
    }
    if (modifier.id == "steps") s.technique = find_technique("relief_mapping");
    return s;
}

Varied vary_modifier(const VarySettings& settings, const Progress& progress) {
    for (const MaterialSource& source : settings.materials) check_source(source);
    const Modifier& modifier = *settings.modifier;
    const Technique* exact = nullptr;
    for (const Technique& t : techniques())
        if (t.exact && exact == nullptr) exact = &t;
    const Technique& technique = settings.technique != nullptr ? *settings.technique : *exact;
    std::vector<View> shown = settings.views;
    if (shown.empty()) shown.assign(views().begin(), views().end());

    std::vector<GpuRenderer::Timed> timed;
    std::vector<DrawOptions> all;
    for (std::size_t i = 0; i < modifier.values.size(); ++i) {
        DrawOptions options = settings.options;
        options.*modifier.choice = static_cast<int>(i);
        all.push_back(options);
        timed.push_back({&technique, default_params(technique), options});
    }
    const auto truth_of = [&](std::size_t value) {
        DrawOptions options = settings.options;
        options.*modifier.choice = modifier.truth >= 0 ? modifier.truth : static_cast<int>(value);
        return options;
    };

    GpuRenderer gpu(settings.device, false);
    Varied result{.device = gpu.device_name(), .truth = modifier.truth >= 0 ? described(truth_of(0)) : "each value's own", .rows = {}};
    if (!settings.pictures.empty()) fs::create_directories(settings.pictures);
    const std::vector<Vec2f> offsets = sample_offsets(settings.samples);
    const std::vector<Vec2f> truth_offsets = settings.truth_samples > 0 ? sample_offsets(settings.truth_samples) : offsets;
    const Technique* const drawn[] = {&technique};
    for (const MaterialSource& source : settings.materials) {
        const Material material = load_source(source);
        const std::string name = material.name;
        BakedMaps baked;
        std::shared_ptr<const GpuMaterial> uploaded;
        std::optional<bool> back;  // the side that these are of
        std::vector<Image8> panels;
        for (const View& view : shown) {
            if (back != view.from_behind()) {
                back = view.from_behind();
                baked = bake_maps(*back ? back_side(material) : material, maps_to_draw(drawn, all), {.threads = settings.threads, .progress = progress});
                uploaded = gpu.upload(baked.maps, baked.height_scale, baked.zero_level);
            }
            const Stage stage = stage_for(view);
            const PictureSettings picture{.width = settings.width, .height = settings.height, .options = {}, .offsets = offsets};
            const std::vector<Frame> frames = gpu.draw_timed(stage, *uploaded, timed, picture, settings.runs, progress);
            Frame truth;
            for (std::size_t i = 0; i < frames.size(); ++i) {
                if (i == 0 || modifier.truth < 0)
                    truth = sampled_truth(gpu, stage, *uploaded, baked.maps, settings.width, settings.height, truth_offsets,
                                          {.height_scale = baked.height_scale,
                                           .zero_level = baked.zero_level,
                                           .options = truth_of(i),
                                           .threads = settings.threads},
                                          progress);
                const ImageF shown_truth = display_values(truth.colour, "truth", settings.threads);
                const ImageF shown_picture = display_values(frames[i].colour, "picture", settings.threads);
                const std::string value(modifier.values[i].id);
                result.rows.push_back({.material = name,
                                       .view = view.id,
                                       .value = value,
                                       .flip = flip(frames[i].colour, truth.colour, {.threads = settings.threads}).mean,
                                       .psnr_db = psnr_db(shown_picture, shown_truth, settings.threads).value.value_or(99),
                                       .shadow_error = shadow_error(frames[i], truth),
                                       .gpu_ms = median(frames[i].gpu_ms)});
                panels.push_back(magnified(srgb_picture(frames[i].colour), settings.magnified));
                if (i + 1 == frames.size() || modifier.truth < 0) panels.push_back(magnified(srgb_picture(truth.colour), settings.magnified));
                if (settings.pictures.empty()) continue;
                const std::string prefix = name + "-" + view.id + "-" + std::string(modifier.id) + "-";
                write_frame_png(fs::path(settings.pictures) / (prefix + value + ".png"), frames[i].colour);
                if (i == 0 || modifier.truth < 0)
                    write_frame_png(fs::path(settings.pictures) / (prefix + (modifier.truth < 0 ? value + "-" : "") + "truth.png"), truth.colour);
            }
            // Each view begins a row of its own.
            const int abreast = modifier.truth < 0 ? 2 : 3;
            while (panels.size() % static_cast<std::size_t>(abreast) != 0)
                panels.emplace_back(panels.front().width, panels.front().height, 3, std::uint8_t{255});
            if (!settings.sheet.empty() && &view == &shown.back() && &source == &settings.materials.front())
                write_png(settings.sheet, in_rows(std::move(panels), abreast), FirstRow::top);
        }
    }
    return result;
}

}  // namespace relievo
