// The parsers behind load_mesh: bytes in memory to a Mesh. `file` is how messages name the source; `threads` 0 means all cores and
// never changes the result. All throw Error naming line or byte offset, and need memory in proportion to the bytes they are given.
#pragma once

#include "core/mesh.h"

#include <string>
#include <string_view>

namespace relievo {

// Wavefront OBJ. v (with w or colour), vt, vn, f in every form, negative indices, polygons, continued lines; all groups and
// objects become one mesh; lines, points, curves and materials are passed over.
Mesh parse_obj(std::string_view bytes, const std::string& file, int threads = 0);

}  // namespace relievo
