#include "maps/box_maximum.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstring>
#include <vector>

// Windows of length 2^k double from one another; a window of any length is the larger of two that overlap.

namespace relievo {

namespace {

// Values of a line and, behind its end, as many repeated ones as a window of `length` reaches.
void repeat_behind(std::vector<float>& line, const float* from, int size, int first, int length) {
    line.resize(static_cast<std::size_t>(size + length));
    int at = ((first % size) + size) % size;
    for (std::size_t i = 0; i < line.size();) {
        const auto run = std::min(line.size() - i, static_cast<std::size_t>(size - at));
        std::memcpy(line.data() + i, from + at, run * sizeof(float));
        i += run;
        at = 0;
    }
}

void window_maximum(const float* from, float* out, int size, int reach, std::vector<float>& line) {
    const int length = 2 * reach + 1;
    repeat_behind(line, from, size, -reach, length);
    int have = 1;
    for (; 2 * have <= length; have *= 2)
        for (std::size_t i = 0; i + static_cast<std::size_t>(have) < line.size(); ++i) line[i] = std::max(line[i], line[i + static_cast<std::size_t>(have)]);
    for (int i = 0; i < size; ++i) out[i] = std::max(line[static_cast<std::size_t>(i)], line[static_cast<std::size_t>(i + length - have)]);
}

}  // namespace

ImageF box_maximum(const ImageF& in, int reach, int threads) {
    assert(in.channels == 1 && reach >= 0);
    const int width = in.width;
    const int height = in.height;
    const int reach_x = std::min(reach, width / 2);
    const int reach_y = std::min(reach, height / 2);
    ImageF rows(width, height, 1);
    parallel_for(height, 16, threads, [&](int begin, int end) {
        std::vector<float> line;
        for (int j = begin; j < end; ++j) window_maximum(in.at(0, j), rows.at(0, j), width, reach_x, line);
    });
    // Down the columns, a strip of them at a time so that it stays in the cache.
    constexpr int strip = 64;
    const int length = 2 * reach_y + 1;
    ImageF out(width, height, 1);
    parallel_for((width + strip - 1) / strip, 1, threads, [&](int begin, int end) {
        std::vector<float> block(static_cast<std::size_t>(height + length) * strip);
        for (int s = begin; s < end; ++s) {
            const int x = s * strip;
            const auto columns = static_cast<std::size_t>(std::min(strip, width - x));
            const auto row = [&](int j) { return block.data() + static_cast<std::size_t>(j) * strip; };
            for (int j = 0; j < height + length; ++j)
                std::memcpy(row(j), rows.at(x, ((j - reach_y) % height + height) % height), columns * sizeof(float));
            int have = 1;
            for (; 2 * have <= length; have *= 2)
                for (int j = 0; j + have < height + length; ++j) {
                    float* to = row(j);
                    const float* from = row(j + have);
                    for (std::size_t i = 0; i < strip; ++i) to[i] = std::max(to[i], from[i]);
                }
            for (int j = 0; j < height; ++j)
                for (std::size_t i = 0; i < columns; ++i) out.at(x, j)[i] = std::max(row(j)[i], row(j + length - have)[i]);
        }
    });
    return out;
}

}  // namespace relievo
