// The material that a two-sided surface shows from behind (Mile 2008, 3.6.8): what rises in front is sunk there.
#pragma once

#include "core/material.h"

namespace relievo {

// Heights are 1 - h and measured downward, the polygon's with them, so that front and back are the two faces of one sheet without
// thickness; texture coordinates stay where they are. In the frame (t, b, -n) of the back the relief's slopes change their sign, and so
// do x and y of its normals; z does not: the normal itself is the front's, reversed.
Material back_side(Material front);

}  // namespace relievo
