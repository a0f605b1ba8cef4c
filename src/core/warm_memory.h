// Memory that is at hand when work begins, where the system takes its time to find some.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace relievo {

// Touches up to so many bytes of new memory, piece by piece while `idle` says that there is nothing better to do, and holds them. Once they are handed over, an allocator
// that keeps what is freed has them for whoever comes next. The programs' (src/allocator) does so as long as this lives; by itself it gives back at once what has grown
// to more than 8 MiB, which is the better way where memory is dearer than time. Nothing but touching happens where another allocator is.
class WarmMemory {
public:
    WarmMemory(std::size_t bytes, const std::function<bool()>& idle);
    ~WarmMemory();
    WarmMemory(const WarmMemory&) = delete;
    WarmMemory& operator=(const WarmMemory&) = delete;

    std::size_t bytes() const;  // that are held
    void hand_over();

private:
    std::vector<std::unique_ptr<volatile std::byte[]>> pieces_;
};

}  // namespace relievo
