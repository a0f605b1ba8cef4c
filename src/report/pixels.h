// The values behind a picture, for the page's pixel inspector, and in words for those who cannot see it.
//
// A page opened from disk may not read the pixels of its own pictures, but it may load scripts; so the values travel as a script
// per picture that hands one text to the page: planes of one byte per pixel, each row stored as differences from the left, all of
// it deflated (RFC 1950) and written in base64. A picture of 640 x 360 takes some 50 to 300 kB.
#pragma once

#include "core/frame.h"

#include <string>

namespace relievo {

struct PixelSettings {
    int texels_x = 0;  // size of the height map, the unit of UV errors
    int texels_y = 0;
};

// Script of a technique's picture: verdict, offset of its hit from the true one (logarithmic, good to 5 percent; below 1/32 texel
// it reads 0) and fetches. All three of the same size.
std::string pixel_script(const Frame& picture, const Frame& reference, const RayField& rays, const PixelSettings& settings);

// Script of the reference: texture coordinate and height of the true hit, in 16 bits each.
std::string reference_pixel_script(const Frame& reference);

// "Worst in the far third, to the right." Empty when fewer than one pixel in ten thousand is wrong.
std::string where_it_is_wrong(const Frame& picture, const Frame& reference, const RayField& rays, const PixelSettings& settings);

}  // namespace relievo
