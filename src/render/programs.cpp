#include "render/programs.h"

#include <algorithm>
#include <cassert>

namespace relievo {

std::span<const std::uint32_t> program_words(std::string_view host) {
    const auto all = programs();
    const auto it = std::ranges::find(all, host, &Program::host);
    assert(it != all.end());
    return it->words;
}

}  // namespace relievo
