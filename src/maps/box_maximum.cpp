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
void repeat_behind(std::vector<float>& line, const float* from, int size, int length) {
    line.resize(static_cast<std::size_t>(size + length));
    for (std::size_t i = 0; i < line.size(); i += static_cast<std::size_t>(size))
        std::memcpy(line.data() + i, from, std::min(line.size() - i, static_cast<std::size_t>(size)) * sizeof(float));
}

void window_maximum(const float* from, float* out, int size, int length, std::vector<float>& line) {
    repeat_behind(line, from, size, length);
    int have = 1;
    for (; 2 * have <= length; have *= 2)
        for (std::size_t i = 0; i + static_cast<std::size_t>(have) < line.size(); ++i) line[i] = std::max(line[i], line[i + static_cast<std::size_t>(have)]);
    for (int i = 0; i < size; ++i) out[i] = std::max(line[static_cast<std::size_t>(i)], line[static_cast<std::size_t>(i + length - have)]);
}

}  // namespace

ImageF box_maximum(const ImageF& in, int side, int threads) {
    assert(in.channels == 1 && side >= 1);
    const int width = in.width;
    const int height = in.height;
    const int length = std::min(side, height);
    ImageF rows(width, height, 1);
    parallel_for(height, 16, threads, [&](int begin, int end) {
        std::vector<float> line;
        for (int j = begin; j < end; ++j) window_maximum(in.at(0, j), rows.at(0, j), width, std::min(side, width), line);
    });
    // Down the columns, a strip of them at a time so that it stays in the cache.
    constexpr int strip = 64;
    ImageF out(width, height, 1);
    parallel_for((width + strip - 1) / strip, 1, threads, [&](int begin, int end) {
        std::vector<float> block(static_cast<std::size_t>(height + length) * strip);
        for (int s = begin; s < end; ++s) {
            const int x = s * strip;
            const auto columns = static_cast<std::size_t>(std::min(strip, width - x));
            const auto row = [&](int j) { return block.data() + static_cast<std::size_t>(j) * strip; };
            for (int j = 0; j < height + length; ++j)
                std::memcpy(row(j), rows.at(x, j % height), columns * sizeof(float));
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
