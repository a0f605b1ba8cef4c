#include "pipeline/render_picture.h"

#include "assets/atomic_file.h"
#include "assets/frame_file.h"
#include "core/error.h"
#include "maps/back_side.h"
#include "pipeline/map_set_bake.h"
#include "pipeline/mesh_relief_picture.h"
#include "pipeline/reference_picture.h"

#include <filesystem>

namespace relievo {

namespace {

void write_picture(const std::filesystem::path& out, const Frame& frame) {
    if (out.extension() == ".exr") {
        write_frame_exr(out, frame);
    } else {
        write_frame_png(out, frame.colour);
    }
}

double mean_fetches(const Frame& frame) {
    double sum = 0;
    int hits = 0;
    for (int y = 0; y < frame.height; ++y)
        for (int x = 0; x < frame.width; ++x)
            if (frame.coverage(x, y) != static_cast<std::uint8_t>(Coverage::background)) {
                sum += static_cast<double>(frame.fetches(x, y));
                ++hits;
            }
    return hits > 0 ? sum / hits : 0;
}

}  // namespace

RenderedPicture render_picture(const RenderSettings& settings, const Progress& progress) {
    const std::filesystem::path out = settings.out;
    if (out.extension() != ".exr" && out.extension() != ".png") throw UsageError("--out " + settings.out + ": a picture is written as .png or .exr");
    const AtomicFile probe(out);  // an unwritable target is known before the work

    if (!settings.mesh.empty()) {
        MeshReliefPicture drawn = mesh_relief_picture(settings, progress);
        write_picture(out, drawn.frame);
        return {.source = drawn.frame.source, .mean_fetches = mean_fetches(drawn.frame), .notes = std::move(drawn.notes), .mesh = drawn.facts};
    }
    report(progress, "loading", 0);
    const PictureSettings& picture = settings.picture;
    const std::size_t drawn = settings.technique != nullptr ? 1 : 0;  // the reference needs no map of a technique's or a modifier's
    const std::vector<Map> wanted = maps_to_draw(std::span(&settings.technique, drawn), std::span(&picture.options, drawn));
    Material material = load_source(settings.material);
    if (settings.view.from_behind()) material = back_side(std::move(material));
    BakeMachine machine = BakeMachine::automatic(settings.device);
    const BakedMaps baked = bake_maps(std::move(material), wanted,
                                      {.threads = settings.material.threads, .use_cache = settings.use_cache, .progress = progress, .machine = &machine});

    report(progress, "drawing", 0);
    const Stage stage = stage_for(settings.view);
    Frame frame;
    if (settings.technique != nullptr) {
        GpuRenderer gpu(settings.device, false);
        frame = gpu.draw(stage, *gpu.upload(baked.maps, baked.height_scale, baked.zero_level), *settings.technique, settings.params, picture);
    } else {
        std::vector<RayField> rays;
        for (const Vec2f offset : picture.offsets) rays.push_back(quad_rays(stage, picture.width, picture.height, Vec2d(offset)));
        frame = reference_picture(stage, baked.maps, rays,
                                  {.height_scale = baked.height_scale,
                                   .zero_level = baked.zero_level,
                                   .options = picture.options,
                                   .threads = settings.material.threads},
                                  progress);
    }
    write_picture(out, frame);
    report(progress, "drawing", 1);

    return {.source = frame.source, .mean_fetches = mean_fetches(frame), .notes = baked.notes, .mesh = {}};
}

}  // namespace relievo
