// Edges of a mesh with the faces along them: what topology and repair both look at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace relievo {

// One side of a face, from corner `corner` of face `face` to the next. `low` and `high` are its two places, in increasing order.
struct FaceSide {
    std::uint32_t low, high;
    std::uint32_t face;
    std::uint8_t corner;
    bool rising;  // runs from low to high
};

// All sides of the faces for which `counts` is not 0, sorted so that the sides of one edge lie together, those of lower faces first.
// `places` holds three places a face.
std::vector<FaceSide> sorted_sides(std::span<const std::uint32_t> places, std::span<const std::uint8_t> counts);

// Calls visit(span of sides) for each edge.
template <class Visit>
void each_edge(std::span<const FaceSide> sides, const Visit& visit) {
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t j = i + 1;
        while (j < sides.size() && sides[j].low == sides[i].low && sides[j].high == sides[i].high) ++j;
        visit(sides.subspan(i, j - i));
        i = j;
    }
}

// Sets that grow together.
class Sets {
public:
    explicit Sets(std::size_t count);
    std::uint32_t find(std::uint32_t a);
    void join(std::uint32_t a, std::uint32_t b);  // the lower representative stays

private:
    std::vector<std::uint32_t> parent_;
};

}  // namespace relievo
