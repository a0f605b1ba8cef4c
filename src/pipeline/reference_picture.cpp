#include "pipeline/reference_picture.h"

#include "reference/cast.h"

namespace relievo {

Frame reference_picture(const Stage& stage, const MapSet& maps, std::span<const RayField> rays, const ReferencePicture& settings,
                        const Progress& progress) {
    return reference_frame(rays, maps, stage.lighting,
                           {.height_scale = settings.height_scale,
                            .zero_level = settings.zero_level,
                            .shadow = settings.options.shadow != glsl::shadow_none,
                            .light_radius_rad = has_penumbra(settings.options.shadow) ? settings.options.numbers.light_radius : 0.0,
                            .uv_at_origin = Vec2d{stage.base.periods / 2.0, stage.base.periods / 2.0},
                            .threads = settings.threads},
                           progress);
}

}  // namespace relievo
