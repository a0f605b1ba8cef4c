// What a search says of where its hit lies, in terms that hold on any relief: heights of the ray, texels, and what the ray itself
// passes over. A hit that is none of this is astray.
#pragma once

namespace relievo {

// A hit is kept if the ray enters a solid within `error` of it, and everything it passed through before was thinner than `stride`;
// or if it is no farther from the first hit, in heights of the ray, than
//   unmoved * |zero level - first hit|  +  relief * (span of the surface's heights between polygon and first hit).
struct Promise {
    double error = 0;    // heights of the ray, whose whole way is 1
    double stride = 0;   // heights of the ray; 1: any crossing will do
    double texels = 0;   // along the ray, added to both
    double unmoved = 0;  // 1: no farther off than the polygon itself
    double relief = 0;   // 1: no farther off than the heights passed over differ
    bool polygon = false;  // the polygon's own error is allowed too
};

}  // namespace relievo
