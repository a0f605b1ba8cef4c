#include "maps/back_side.h"

namespace relievo {

Material back_side(Material front) {
    Material back = std::move(front);
    for (float& h : back.height.texels.texels) h = 1 - h;
    if (back.normal)
        for (std::size_t i = 0; i + 2 < back.normal->texels.size(); i += 3) {
            back.normal->texels[i] = -back.normal->texels[i];
            back.normal->texels[i + 1] = -back.normal->texels[i + 1];
        }
    back.zero_level = 1 - back.zero_level;
    back.notes.push_back("seen from behind: heights are 1 - h and normals reversed");
    return back;
}

}  // namespace relievo
