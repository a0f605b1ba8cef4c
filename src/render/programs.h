// The GPU programs compiled into this binary, one per host and technique (cmake/shaders.cmake).
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace relievo {

struct Program {
    std::string_view host;       // file name in shaders/hosts/heightfield, or with its folder in shaders/hosts
    std::string_view technique;  // id, or empty for a host that runs none
    std::span<const std::uint32_t> words;
};

std::span<const Program> programs();

// Of a host that runs no technique.
std::span<const std::uint32_t> program_words(std::string_view host);

}  // namespace relievo
