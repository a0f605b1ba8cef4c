#include "pipeline/reference_picture.h"

#include "reference/cast.h"

namespace relievo {

Frame reference_picture(const Stage& stage, const MapSet& maps, std::span<const RayField> rays, const ReferencePicture& settings,
                        const Progress& progress) {
    return reference_frame(rays, maps, stage.lighting,
                           {.height_scale = settings.height_scale,
                            .zero_level = settings.zero_level,
                            .shadow = settings.shadow,
                            .uv_at_origin = Vec2d{stage.base.periods / 2.0, stage.base.periods / 2.0},
                            .threads = settings.threads},
                           progress);
}

}  // namespace relievo
