// Memory for large arrays with fewer interruptions.
#pragma once

#include <cstddef>
#include <vector>

namespace relievo {

// Asks the system to back so much memory, as far as nothing has been written there, with large pages: the first touch of each page of
// 4 KiB costs as much as copying it does. Only a hint: does nothing where there are none.
void prefer_large_pages(void* data, std::size_t bytes);

// values.reserve(count) in such memory. To be called before anything is put in.
template <class T>
void reserve_large(std::vector<T>& values, std::size_t count) {
    values.reserve(count);
    prefer_large_pages(values.data(), count * sizeof(T));
}

}  // namespace relievo
