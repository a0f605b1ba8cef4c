#include "fur/darts.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace relievo {

namespace {

std::uint32_t mixed(std::uint32_t h) {
    h = (h ^ (h >> 16)) * 0x85ebca6bu;  // the finaliser of MurmurHash3
    h = (h ^ (h >> 13)) * 0xc2b2ae35u;
    return h ^ (h >> 16);
}
std::uint32_t bits_of(Vec3f p) {
    // 0 and -0 are one place.
    return std::bit_cast<std::uint32_t>(p.x + 0.0f) * 0x9e3779b1u ^ std::bit_cast<std::uint32_t>(p.y + 0.0f) * 0x85ebca77u ^
           std::bit_cast<std::uint32_t>(p.z + 0.0f) * 0xc2b2ae3du;
}

// Numbers in [0,1) of its own for each face, the same wherever the face stands in the list and with whichever corner it begins.
class FaceRandom {
public:
    FaceRandom(Vec3f a, Vec3f b, Vec3f c, std::uint32_t seed) : state_(mixed(mixed(bits_of(a)) + mixed(bits_of(b)) + mixed(bits_of(c)) + seed * 0x27d4eb2fu)) {}
    float at(std::uint32_t i) const { return static_cast<float>(mixed(state_ + i * 0x9e3779b9u) >> 8) * 0x1p-24f; }

private:
    std::uint32_t state_;
};

struct Corners {
    Vec3f a, b, c;
};

bool less(Vec3f p, Vec3f q) {
    if (p.x != q.x) return p.x < q.x;
    return p.y != q.y ? p.y < q.y : p.z < q.z;
}

// The corners in the order of their places, so that darts depend neither on the corner that a file begins with nor on the side.
Corners corners_of(const Mesh& mesh, std::uint32_t face) {
    const std::uint32_t* i = &mesh.indices[std::size_t{face} * 3];
    Corners k{mesh.positions[i[0]], mesh.positions[i[1]], mesh.positions[i[2]]};
    if (less(k.b, k.a)) std::swap(k.a, k.b);
    if (less(k.c, k.b)) std::swap(k.b, k.c);
    if (less(k.b, k.a)) std::swap(k.a, k.b);
    return k;
}

// How many darts a face gets of those it may expect, rounded up as often as its fraction says.
std::uint32_t dart_count(const FaceRandom& random, double expected) { return static_cast<std::uint32_t>(expected + random.at(0)); }

// The k-th dart of a face, even by area: Turk (1990), "Generating Random Points in Triangles".
Vec3f dart_at(const Corners& at, const FaceRandom& random, std::uint32_t k) {
    const float s = std::sqrt(random.at(2 * k + 1)), v = s * random.at(2 * k + 2), u = s - v;
    return at.a * (1 - s) + at.b * u + at.c * v;
}

// Darts `dart` to below `end_dart`, or to the face's last, of the faces `face` to below `end_face`.
struct Share {
    std::uint32_t face, end_face, dart, end_dart;
};

constexpr std::uint32_t darts_per_share = 16384;

// The faces in shares of about as many darts, large faces cut into several.
std::vector<Share> shares_of(std::span<const float> expected) {
    const auto faces = static_cast<std::uint32_t>(expected.size());
    constexpr std::uint32_t all = 0xffffffffu;
    std::vector<Share> shares;
    double sum = 0;
    std::uint32_t from = 0;
    const auto close = [&](std::uint32_t end) {
        if (end > from) shares.push_back({from, end, 0, all});
        from = end;
        sum = 0;
    };
    for (std::uint32_t f = 0; f < faces; ++f) {
        const double wanted = static_cast<double>(expected[f]);
        if (wanted > 2 * darts_per_share) {
            close(f);
            const auto most = static_cast<std::uint32_t>(wanted) + 1, step = darts_per_share;
            for (std::uint32_t d = 0; d < most; d += step) shares.push_back({f, f + 1, d, d + step < most ? d + step : all});
            from = f + 1;
            continue;
        }
        sum += wanted;
        if (sum >= darts_per_share || f + 1 - from >= 65536) close(f + 1);
    }
    close(faces);
    return shares;
}

// Numbers blocks from 0 as they come.
class BlockNumbers {
public:
    std::uint32_t operator()(std::uint64_t block) {
        if (!blocks_.empty() && block == blocks_[last_]) return last_;
        if (2 * blocks_.size() >= slots_.size()) grow();
        std::uint32_t& slot = slots_[find(block)];
        if (slot == 0) {
            blocks_.push_back(block);
            slot = static_cast<std::uint32_t>(blocks_.size());
        }
        return last_ = slot - 1;
    }
    const std::vector<std::uint64_t>& blocks() const { return blocks_; }
    void clear() {
        std::ranges::fill(slots_, 0u);
        blocks_.clear();
        last_ = 0;
    }

private:
    std::vector<std::uint64_t> blocks_;
    std::vector<std::uint32_t> slots_ = std::vector<std::uint32_t>(256);  // a number and 1; 0: none
    std::uint32_t last_ = 0;

    std::size_t find(std::uint64_t block) const {
        std::size_t at = block * 0x9e3779b97f4a7c15u >> 32 & (slots_.size() - 1);
        while (slots_[at] != 0 && blocks_[slots_[at] - 1] != block) at = (at + 1) & (slots_.size() - 1);
        return at;
    }
    void grow() {
        slots_.assign(slots_.size() * 2, 0);
        for (std::uint32_t n = 0; n < blocks_.size(); ++n) slots_[find(blocks_[n])] = n + 1;
    }
};

}  // namespace

std::vector<DartPack> throw_darts(const Mesh& mesh, std::span<const float> expected, const DartGrid& grid, std::uint32_t seed, int threads) {
    const std::vector<Share> shares = shares_of(expected);
    std::vector<DartPack> packs(shares.size());
    parallel_for(static_cast<int>(shares.size()), 1, threads, [&](int first, int last) {
        std::vector<Root> darts;
        std::vector<std::uint32_t> block, next;
        BlockNumbers numbers;
        Vec3f inside;
        for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(last); ++k) {
            std::size_t thrown = 0;
            numbers.clear();
            const Share& share = shares[k];
            for (std::uint32_t f = share.face; f < share.end_face; ++f) {
                if (!(expected[f] > 0)) continue;
                const Corners corners = corners_of(mesh, f);
                const FaceRandom random(corners.a, corners.b, corners.c, seed);
                const std::uint32_t count = std::min(dart_count(random, static_cast<double>(expected[f])), share.end_dart);
                if (darts.size() < thrown + count) {
                    darts.resize(thrown + count + darts_per_share);
                    block.resize(darts.size());
                }
                for (std::uint32_t i = share.dart; i < count; ++i, ++thrown) {
                    darts[thrown] = {dart_at(corners, random, i), f};
                    block[thrown] = numbers(block_of(grid.at(darts[thrown].position, inside)));
                }
            }
            DartPack& pack = packs[k];
            pack.blocks = numbers.blocks();
            pack.begin.assign(pack.blocks.size() + 1, 0);
            for (std::size_t i = 0; i < thrown; ++i) ++pack.begin[block[i] + 1];
            for (std::size_t b = 0; b < pack.blocks.size(); ++b) pack.begin[b + 1] += pack.begin[b];
            next.assign(pack.begin.begin(), pack.begin.end() - 1);
            pack.darts.resize(thrown);
            for (std::size_t i = 0; i < thrown; ++i) pack.darts[next[block[i]]++] = darts[i];
        }
    });
    return packs;
}

}  // namespace relievo
