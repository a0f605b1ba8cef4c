#include "measure/steepness.h"

#include <cmath>

namespace relievo {

double rms_slope(const HeightField& field, double height_scale) {
    const int width = field.width();
    const int height = field.height();
    double sum = 0;
    for (int j = 0; j < height; ++j) {
        for (int i = 0; i < width; ++i) {
            const double h = field.texels(i, j);
            const double along_u = (field.texels(i + 1 == width ? 0 : i + 1, j) - h) * width;
            const double along_v = (field.texels(i, j + 1 == height ? 0 : j + 1) - h) * height;
            sum += along_u * along_u + along_v * along_v;
        }
    }
    return height_scale * std::sqrt(sum / (static_cast<double>(width) * height));
}

}  // namespace relievo
