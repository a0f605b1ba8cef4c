#include "pipeline/shown_picture.h"

#include "assets/atomic_file.h"
#include "assets/image_file.h"

namespace relievo {

Image8 shown_picture(const ImageF& linear_rgb) {
    Image8 shown(linear_rgb.width, linear_rgb.height, 4, 255);
    for (int y = 0; y < shown.height; ++y)
        for (int x = 0; x < shown.width; ++x)
            for (int c = 0; c < 3; ++c) shown(x, y, c) = srgb_from_linear(linear_rgb(x, y, c));
    return shown;
}

void require_writable(const std::filesystem::path& file) { const AtomicFile probe(file); }

void write_shown_picture(const std::filesystem::path& file, const Image8& picture) { write_png(file, picture, FirstRow::top); }

}  // namespace relievo
