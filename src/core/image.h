// A rectangle of texels in memory, channels interleaved, rows contiguous.
#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace relievo {

// Row order is the owner's: maps keep row 0 at v = 0 (the bottom of the picture), frames keep row 0 at the top of the screen.
template <class T>
struct Image {
    int width = 0;
    int height = 0;
    int channels = 0;
    std::vector<T> texels;

    Image() = default;
    Image(int width_, int height_, int channels_, T fill = T{})
        : width(width_), height(height_), channels(channels_),
          texels(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_) * static_cast<std::size_t>(channels_), fill) {}

    bool empty() const { return texels.empty(); }
    std::size_t index(int x, int y) const {
        assert(x >= 0 && x < width && y >= 0 && y < height);
        return (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * static_cast<std::size_t>(channels);
    }
    T* at(int x, int y) { return texels.data() + index(x, y); }
    const T* at(int x, int y) const { return texels.data() + index(x, y); }
    T& operator()(int x, int y, int c = 0) { return at(x, y)[c]; }
    const T& operator()(int x, int y, int c = 0) const { return at(x, y)[c]; }
};

using ImageF = Image<float>;
using Image8 = Image<std::uint8_t>;

}  // namespace relievo
