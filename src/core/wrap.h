// Repeat addressing of texels, for any integer index.
#pragma once

namespace relievo {

constexpr int wrap_index(int i, int size) {
    const int r = i % size;
    return r < 0 ? r + size : r;
}

}  // namespace relievo
