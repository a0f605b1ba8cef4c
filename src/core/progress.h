// How long work reports itself and learns that it should stop. Libraries never print: the CLI supplies the function.
#pragma once

#include <functional>
#include <string_view>

namespace relievo {

// Called from one thread at a time with a share in [0,1]; may throw Cancelled to stop the work.
using Progress = std::function<void(std::string_view stage, double share)>;

inline void report(const Progress& progress, std::string_view stage, double share) {
    if (progress) progress(stage, share);
}

}  // namespace relievo
