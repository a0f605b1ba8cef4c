#include "maps/planes_above.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <limits>

namespace relievo {

namespace {

// Of blocks of size x size texels: the slope of least squares, raised above all texels.
ImageF leaf_planes(const ImageF& texels, int size, int threads) {
    ImageF planes((texels.width + size - 1) / size, (texels.height + size - 1) / size, 3);
    parallel_for(planes.height, 16, threads, [&](int begin, int end) {
        for (int j = begin; j < end; ++j)
            for (int i = 0; i < planes.width; ++i) {
                const int w = std::min(size, texels.width - i * size);
                const int h = std::min(size, texels.height - j * size);
                const float middle_x = 0.5f * static_cast<float>(w - 1);
                const float middle_y = 0.5f * static_cast<float>(h - 1);
                float sum_x = 0, sum_y = 0, sum_x2 = 0, sum_y2 = 0;
                for (int y = 0; y < h; ++y)
                    for (int x = 0; x < w; ++x) {
                        const float height = texels(i * size + x, j * size + y);
                        const float dx = static_cast<float>(x) - middle_x;
                        const float dy = static_cast<float>(y) - middle_y;
                        sum_x += dx * height;
                        sum_y += dy * height;
                        sum_x2 += dx * dx;
                        sum_y2 += dy * dy;
                    }
                float* plane = planes.at(i, j);
                plane[1] = w > 1 ? sum_x / sum_x2 : 0.0f;
                plane[2] = h > 1 ? sum_y / sum_y2 : 0.0f;
                plane[0] = -std::numeric_limits<float>::infinity();
                for (int y = 0; y < h; ++y)
                    for (int x = 0; x < w; ++x)
                        plane[0] = std::max(plane[0], texels(i * size + x, j * size + y) - plane[1] * static_cast<float>(x) -
                                                          plane[2] * static_cast<float>(y));
            }
    });
    return planes;
}

// The planes of blocks of 2 x 2 of those below, `size` texels a side each.
ImageF joined(const ImageF& below, const ImageF& texels, int size, int threads) {
    ImageF planes((below.width + 1) / 2, (below.height + 1) / 2, 3);
    parallel_for(planes.height, 64, threads, [&](int begin, int end) {
        for (int j = begin; j < end; ++j)
            for (int i = 0; i < planes.width; ++i) {
                const int count_x = std::min(2, below.width - 2 * i);
                const int count_y = std::min(2, below.height - 2 * j);
                struct Part {
                    const float* plane;
                    float width, height, middle;  // texels from its first to its last one; height there, half way
                } parts[2][2];
                float step_x = 0, step_y = 0, wide = 0, high = 0;  // parts of a single column or row know of no step
                for (int b = 0; b < count_y; ++b)
                    for (int a = 0; a < count_x; ++a) {
                        const int x = 2 * i + a;
                        const int y = 2 * j + b;
                        Part& part = parts[b][a];
                        part.plane = below.at(x, y);
                        part.width = static_cast<float>(std::min(size, texels.width - x * size) - 1);
                        part.height = static_cast<float>(std::min(size, texels.height - y * size) - 1);
                        part.middle = part.plane[0] + 0.5f * (part.plane[1] * part.width + part.plane[2] * part.height);
                        step_x += part.plane[1];
                        step_y += part.plane[2];
                        wide += part.width > 0 ? 1.0f : 0.0f;
                        high += part.height > 0 ? 1.0f : 0.0f;
                    }
                if (wide > 0) step_x /= wide;
                if (high > 0) step_y /= high;
                // Least squares weigh the step between two halves three times as much as those within.
                if (count_x == 2) {
                    float between = 0;
                    for (int b = 0; b < count_y; ++b)
                        between += (parts[b][1].middle - parts[b][0].middle) /
                                   (static_cast<float>(size) + 0.5f * (parts[b][1].width - parts[b][0].width));
                    between /= static_cast<float>(count_y);
                    step_x = wide > 0 ? 0.25f * step_x + 0.75f * between : between;
                }
                if (count_y == 2) {
                    float between = 0;
                    for (int a = 0; a < count_x; ++a)
                        between += (parts[1][a].middle - parts[0][a].middle) /
                                   (static_cast<float>(size) + 0.5f * (parts[1][a].height - parts[0][a].height));
                    between /= static_cast<float>(count_x);
                    step_y = high > 0 ? 0.25f * step_y + 0.75f * between : between;
                }
                float* plane = planes.at(i, j);
                plane[0] = -std::numeric_limits<float>::infinity();
                plane[1] = step_x;
                plane[2] = step_y;
                for (int b = 0; b < count_y; ++b)
                    for (int a = 0; a < count_x; ++a) {
                        const Part& part = parts[b][a];
                        const float first =
                            part.plane[0] - step_x * static_cast<float>(a * size) - step_y * static_cast<float>(b * size);
                        plane[0] = std::max(plane[0], first + std::max(0.0f, (part.plane[1] - step_x) * part.width) +
                                                          std::max(0.0f, (part.plane[2] - step_y) * part.height));
                    }
            }
    });
    return planes;
}

}  // namespace

std::vector<ImageF> planes_above(const ImageF& texels, int first_level, int last_level, int threads) {
    std::vector<ImageF> planes{leaf_planes(texels, 1 << first_level, threads)};
    for (int level = first_level; level < last_level; ++level) planes.push_back(joined(planes.back(), texels, 1 << level, threads));
    return planes;
}

}  // namespace relievo
