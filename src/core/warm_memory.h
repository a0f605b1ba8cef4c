// Memory that is at hand when work begins.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace relievo {

using WarmMemory = std::vector<std::unique_ptr<volatile std::byte[]>>;

// Touches up to so many bytes of new memory, piece by piece while `idle` says that there is nothing better to do. Once they are freed, an allocator that keeps what
// is freed for a while, as the programs' does (src/allocator), has them at hand for whoever comes next.
WarmMemory warm_memory(std::size_t bytes, const std::function<bool()>& idle);

}  // namespace relievo
