#include "assets/frame_file.h"

#include "assets/image_file.h"

#include <algorithm>
#include <cassert>

namespace relievo {

void write_frame_png(const std::filesystem::path& file, const ImageF& colour) {
    assert(colour.channels == 3);
    Image8 encoded(colour.width, colour.height, 3);
    std::transform(colour.texels.begin(), colour.texels.end(), encoded.texels.begin(), srgb_from_linear);
    write_png(file, encoded, FirstRow::top);
}

void write_frame_exr(const std::filesystem::path& file, const Frame& frame) {
    ImageF mask(frame.width, frame.height, 1);
    std::copy(frame.coverage.texels.begin(), frame.coverage.texels.end(), mask.texels.begin());
    const ExrChannel channels[] = {
        {"R", &frame.colour, 0},
        {"G", &frame.colour, 1},
        {"B", &frame.colour, 2},
        {"hit.U", &frame.hit_uv, 0},
        {"hit.V", &frame.hit_uv, 1},
        {"height", &frame.hit_height, 0},
        {"normal.X", &frame.normal, 0},
        {"normal.Y", &frame.normal, 1},
        {"normal.Z", &frame.normal, 2},
        {"fetches", &frame.fetches, 0},
        {"mask", &mask, 0},
        {"shadow", &frame.shadow, 0},
    };
    write_exr(file, channels, FirstRow::top);
}

}  // namespace relievo
