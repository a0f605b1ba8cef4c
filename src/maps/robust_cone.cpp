#include "maps/robust_cone.h"

#include "core/parallel_for.h"
#include "core/wrap.h"
#include "maps/cone_map.h"

#include <algorithm>

namespace relievo {

ImageF robust_cone(const HeightField& field, int threads, const Progress& progress) {
    return robust_cone_of(cone_map(field, threads, progress), threads);
}

ImageF robust_cone_of(const ImageF& sampled_cones, int threads) {
    const int w = sampled_cones.width;
    const int h = sampled_cones.height;
    ImageF robust(w, h, 2);
    parallel_for(h, 16, threads, [&](int begin, int end) {
        for (int j = begin; j < end; ++j)
            for (int i = 0; i < w; ++i) {
                float least = 1.0f;
                for (int b = -1; b <= 1; ++b)
                    for (int a = -1; a <= 1; ++a) least = std::min(least, sampled_cones(wrap_index(i + a, w), wrap_index(j + b, h), 1));
                robust(i, j, 0) = sampled_cones(i, j, 0);
                robust(i, j, 1) = least;
            }
    });
    return robust;
}

}  // namespace relievo
