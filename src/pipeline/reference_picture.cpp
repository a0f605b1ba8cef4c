#include "pipeline/reference_picture.h"

#include "reference/cast.h"

namespace relievo {

// The two sides name the ways of reflecting in the same order.
static_assert(static_cast<int>(Reflection::blinn_phong) == glsl::shading_blinn_phong && static_cast<int>(Reflection::ggx) == glsl::shading_ggx &&
              static_cast<int>(Reflection::gouraud) == glsl::shading_gouraud && static_cast<int>(Reflection::flat) == glsl::shading_flat);

Frame reference_picture(const Stage& stage, const MapSet& maps, std::span<const RayField> rays, const ReferencePicture& settings,
                        const Progress& progress) {
    std::vector<RayField> finest;
    if (settings.options.mip == glsl::mip_finest) {
        finest.assign(rays.begin(), rays.end());
        for (RayField& r : finest) r.lod = ImageF(r.width, r.height, 1, -64.0f);
        rays = finest;
    }
    std::vector<RayField> unseen;
    if (stage.camera.from_behind && settings.options.sides == sides_front) {
        for (const RayField& r : rays) unseen.emplace_back(r.width, r.height);
        rays = unseen;
    }
    return reference_frame(rays, maps, stage.lighting,
                           {.height_scale = settings.height_scale,
                            .zero_level = settings.zero_level,
                            .shadow = settings.options.shadow != glsl::shadow_none,
                            .light_radius_rad = has_penumbra(settings.options.shadow) ? settings.options.numbers.light_radius : 0.0,
                            .chart = chart_of(settings.options, stage.base.periods),
                            .reflection = static_cast<Reflection>(settings.options.shading),
                            .roughness = settings.options.numbers.roughness,
                            .metallic = settings.options.numbers.metallic,
                            .sheet = settings.options.sheet == glsl::sheet_relief ? settings.options.numbers.sheet_level : -1.0,
                            .facets = settings.options.numbers.facets,
                            .uv_at_origin = Vec2d{stage.base.periods / 2.0, stage.base.periods / 2.0},
                            .threads = settings.threads},
                           progress);
}

}  // namespace relievo
