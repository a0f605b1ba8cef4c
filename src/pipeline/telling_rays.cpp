#include "pipeline/telling_rays.h"

#include <algorithm>
#include <cassert>
#include <vector>

namespace relievo {

namespace {

struct Candidate {
    Vec2i pixel;
    double late;     // texels along the ray; negative: early
    double fetches;
    double sunk;     // how far below the top the true hit lies
};

// The element at a share of the list, in the order of `key`; ties in the order of the picture.
template <class Key>
const Candidate& at_share(std::vector<Candidate>& list, double share, Key key) {
    std::ranges::stable_sort(list, {}, key);
    return list[static_cast<std::size_t>(share * static_cast<double>(list.size() - 1))];
}

}  // namespace

TellingRays telling_rays(const Frame& picture, const Frame& reference, const RayField& rays, Vec2i texels) {
    const Vec2d size{static_cast<double>(texels.x), static_cast<double>(texels.y)};
    std::vector<Candidate> all;
    for (int y = 0; y < rays.height; ++y)
        for (int x = 0; x < rays.width; ++x) {
            const auto hit = static_cast<std::uint8_t>(Coverage::hit);
            if (picture.coverage(x, y) != hit || reference.coverage(x, y) != hit) continue;
            const Vec2d off{static_cast<double>(picture.hit_uv(x, y, 0)) - static_cast<double>(reference.hit_uv(x, y, 0)),
                            static_cast<double>(picture.hit_uv(x, y, 1)) - static_cast<double>(reference.hit_uv(x, y, 1))};
            const Vec2d away{-static_cast<double>(rays.view(x, y, 0)), -static_cast<double>(rays.view(x, y, 1))};
            const double along = std::max(length(away * size), 1e-12);
            all.push_back({{x, y}, dot(off * size, away * size) / along, picture.fetches(x, y), 1.0 - static_cast<double>(reference.hit_height(x, y))});
        }
    assert(!all.empty());
    const auto kept = [](const std::vector<Candidate>& list, auto test) {
        std::vector<Candidate> some;
        std::ranges::copy_if(list, std::back_inserter(some), test);
        return some.empty() ? list : some;
    };
    std::vector<Candidate> deep = kept(all, [](const Candidate& c) { return c.sunk > 0.25; });
    std::vector<Candidate> right = kept(deep, [](const Candidate& c) { return std::abs(c.late) <= 0.5; });
    TellingRays rays_shown;
    rays_shown.typical = at_share(right, 0.5, &Candidate::fetches).pixel;
    std::vector<Candidate> missed;
    std::ranges::copy_if(all, std::back_inserter(missed), [](const Candidate& c) { return c.late > 0.5; });
    rays_shown.hard = missed.empty() ? at_share(all, 1, &Candidate::fetches).pixel : at_share(missed, 0.5, &Candidate::late).pixel;
    return rays_shown;
}

}  // namespace relievo
