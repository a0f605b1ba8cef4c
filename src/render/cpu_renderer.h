// The same pictures from the same shader text, run on the CPU: for debuggers, sanitizers, fetch counts and parity tests.
#pragma once

#include "core/frame.h"
#include "core/map_set.h"
#include "scenes/scene.h"
#include "techniques/modifiers.h"

namespace relievo {

// Everything of a Frame but colour, which stays black: hits, heights, normals, key-light visibility and fetches. Multi-threaded,
// the same result for any number of threads (0: all cores). The search sees the maps the technique declares and no others:
// reading another throws std::logic_error. Modifiers that change colours alone change nothing here; options.numbers.chart is the edge of
// the relief's square (chart_of), 0 where it repeats. Lights are in tangent space: its origin is UV (0,0) on the polygon, its unit one repeat.
Frame cpu_trace(const RayField& rays, const MapSet& maps, float height_scale, float zero_level, const Lighting& lighting,
                const Technique& technique, const MarchParams& params, const DrawOptions& options, int threads);

}  // namespace relievo
