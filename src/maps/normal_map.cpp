#include "maps/normal_map.h"

#include "core/parallel_for.h"

namespace relievo {

ImageF normal_map(const HeightField& field, float height_scale, int threads) {
    const int width = field.width();
    const int height = field.height();
    ImageF normals(width, height, 3);
    const float per_u = height_scale * 0.5f * static_cast<float>(width);
    const float per_v = height_scale * 0.5f * static_cast<float>(height);
    parallel_for(height, 16, threads, [&](int begin, int end) {
        for (int j = begin; j < end; ++j) {
            const float* row = field.texels.at(0, j);
            const float* below = field.texels.at(0, wrap_index(j - 1, height));
            const float* above = field.texels.at(0, wrap_index(j + 1, height));
            float* out = normals.at(0, j);
            for (int i = 0; i < width; ++i) {
                const float left = row[i > 0 ? i - 1 : width - 1];
                const float right = row[i + 1 < width ? i + 1 : 0];
                const Vec3f n = normalize(Vec3f{(left - right) * per_u, (below[i] - above[i]) * per_v, 1.0f});
                out[3 * i] = n.x;
                out[3 * i + 1] = n.y;
                out[3 * i + 2] = n.z;
            }
        }
    });
    return normals;
}

}  // namespace relievo
