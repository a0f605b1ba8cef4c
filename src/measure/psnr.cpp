#include "measure/psnr.h"

#include "core/parallel_for.h"

#include <cmath>
#include <numeric>

namespace relievo {

Measured<double> psnr_db(const ImageF& display_picture, const ImageF& display_reference, int threads) {
    assert(!display_picture.empty() && display_picture.width == display_reference.width &&
           display_picture.height == display_reference.height && display_picture.channels == display_reference.channels);
    const std::size_t row = display_picture.texels.size() / static_cast<std::size_t>(display_picture.height);
    // One sum per row, added in order: the same digits for any number of threads.
    std::vector<double> squares(static_cast<std::size_t>(display_picture.height), 0.0);
    parallel_for(display_picture.height, 32, threads, [&](int begin, int end) {
        for (std::size_t y = static_cast<std::size_t>(begin); y < static_cast<std::size_t>(end); ++y) {
            double sum = 0;
            for (std::size_t i = y * row; i < (y + 1) * row; ++i) {
                const double d = static_cast<double>(display_picture.texels[i]) - static_cast<double>(display_reference.texels[i]);
                sum += d * d;
            }
            squares[y] = sum;
        }
    });
    const double mse = std::accumulate(squares.begin(), squares.end(), 0.0) / static_cast<double>(display_picture.texels.size());
    if (mse == 0) return Measured<double>::missing("identical pictures");
    return -10 * std::log10(mse);
}

}  // namespace relievo
