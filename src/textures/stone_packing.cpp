#include "textures/stone_packing.h"

#include "textures/curves.h"
#include "textures/distance.h"
#include "textures/hash.h"

#include <algorithm>

namespace relievo {

namespace {

constexpr float corner_rounding = 0.5f;  // of a cell's corners, in radii of its stone

struct Core {
    float power;    // squared distance to the core segment, less the squared radius
    float squared;  // squared distance to the core segment
    Vec2f nearest;  // nearest point of the core segment, relative to the place asked for
    Vec2f offset;   // from the stone's centre to the place
};

inline Core core_of(const Stone& s, Vec2f uv) {
    const Vec2f offset = torus_offset(s.centre, uv);
    const float along = std::clamp(dot(offset, s.half_axis) * s.per_length, -1.0f, 1.0f);
    const Vec2f nearest = s.half_axis * along - offset;
    const float squared = dot(nearest, nearest);
    return {squared - s.radius * s.radius, squared, nearest, offset};
}

// First-order distance to where two powers are equal: their difference over the length of its gradient.
float border_distance(const Core& mine, const Core& other) {
    return (other.power - mine.power) / (2 * std::max(length(other.nearest - mine.nearest), 1e-4f));
}

}  // namespace

StonePacking::StonePacking(float largest, float smallest, std::uint32_t seed) {
    Dice dice(hash(seed, 0x5704e5u));
    // Radii fall by 6 % a round. The throws are so many that a round leaves little room for its own size: stones then touch, and
    // the next rounds fill the corners between them.
    for (float radius = largest; radius >= smallest; radius *= 0.94f) {
        // Of the large ones only some, or they would leave no room for variety.
        const int wanted = radius > 0.75f * largest ? 1 : 1000;
        int laid = 0;
        for (int attempt = 0; attempt < 260 && laid < wanted; ++attempt) {
            Stone s;
            s.centre = {dice.roll(), dice.roll()};
            const Vec2f direction{dice.roll(-1, 1), dice.roll(-1, 1)};
            const float norm = std::max(length(direction), 0.1f);
            const float stretch = dice.roll(0.0f, 0.55f);
            s.half_axis = direction * (radius * stretch / norm);
            s.radius = radius * (1 - 0.45f * stretch);
            s.id = dice.bits();
            const float squared = dot(s.half_axis, s.half_axis);
            s.per_length = squared > 0 ? 1 / squared : 0;
            bool free = true;
            for (const Stone& other : stones_) {
                const Vec2f d = torus_offset(other.centre, s.centre);
                // Each stone reaches toward the other by its radius and the part of its axis that points there.
                const float distance = length(d);
                const float reach_s = s.radius + std::abs(dot(d, s.half_axis)) / std::max(distance, 1e-4f);
                const float reach_o = other.radius + std::abs(dot(d, other.half_axis)) / std::max(distance, 1e-4f);
                if (distance < 0.93f * (reach_s + reach_o)) {
                    free = false;
                    break;
                }
            }
            if (!free) continue;
            stones_.push_back(s);
            ++laid;
        }
    }

    // A stone can own a place in a bucket if its power there may be the least; bounds by the bucket's half diagonal.
    const float half_diagonal = 0.7072f / buckets;
    owners_.resize(buckets * buckets);
    for (int j = 0; j < buckets; ++j) {
        for (int i = 0; i < buckets; ++i) {
            const Vec2f middle{(static_cast<float>(i) + 0.5f) / buckets, (static_cast<float>(j) + 0.5f) / buckets};
            float least = 1e9f;
            for (const Stone& s : stones_) {
                const float far = std::sqrt(core_of(s, middle).squared) + half_diagonal;
                least = std::min(least, far * far - s.radius * s.radius);
            }
            for (std::size_t k = 0; k < stones_.size(); ++k) {
                const float close = std::max(0.0f, std::sqrt(core_of(stones_[k], middle).squared) - half_diagonal);
                if (close * close - stones_[k].radius * stones_[k].radius > least) continue;
                owners_[static_cast<std::size_t>(j * buckets + i)].push_back(static_cast<std::uint16_t>(k));
            }
        }
    }

    // The list of neighbours belongs to the stone, not to the place: blending over a list that changed from place to place would
    // leave steps on the stone. Found by looking at places closer together than any stone is wide.
    neighbours_.resize(stones_.size());
    const int looks = 72;
    for (int j = 0; j < looks; ++j) {
        for (int i = 0; i < looks; ++i) {
            const Vec2f uv{(static_cast<float>(i) + 0.5f) / looks, (static_cast<float>(j) + 0.5f) / looks};
            const std::size_t own = owner(uv);
            const Core mine = core_of(stones_[own], uv);
            const float horizon = stones_[own].radius * (1 + corner_rounding) + 1.0f / looks;
            for (std::size_t k = 0; k < stones_.size(); ++k) {
                auto& list = neighbours_[own];
                if (k == own || border_distance(mine, core_of(stones_[k], uv)) > horizon) continue;
                if (std::ranges::find(list, k) == list.end()) list.push_back(static_cast<std::uint16_t>(k));
            }
        }
    }
}

std::size_t StonePacking::owner(Vec2f uv) const {
    const int i = lattice_index(floor_index(uv.x * buckets), buckets);
    const int j = lattice_index(floor_index(uv.y * buckets), buckets);
    std::size_t own = 0;
    float least = 1e9f;
    for (const std::uint16_t k : owners_[static_cast<std::size_t>(j * buckets + i)]) {
        const float power = core_of(stones_[k], uv).power;
        if (power < least) {
            least = power;
            own = k;
        }
    }
    return own;
}

StonePlace StonePacking::at(Vec2f uv) const {
    const std::size_t own = owner(uv);
    const Stone& stone = stones_[own];
    const Core mine = core_of(stone, uv);
    const float rounding = corner_rounding * stone.radius;
    float inside = stone.radius;
    for (const std::uint16_t k : neighbours_[own]) {
        const Core other = core_of(stones_[k], uv);
        // Most neighbours are too far to count; that is seen without a root or a division.
        const Vec2f across = other.nearest - mine.nearest;
        const float rise = other.power - mine.power;
        const float horizon = 2 * (inside + rounding);
        if (rise * rise >= horizon * horizon * dot(across, across)) continue;
        inside = smooth_min(inside, border_distance(mine, other), rounding);
    }
    return {static_cast<int>(own), inside, std::sqrt(mine.squared), mine.offset};
}

}  // namespace relievo
