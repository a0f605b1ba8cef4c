#include "fur/roots.h"

#include "core/error.h"
#include "core/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cassert>
#include <cmath>
#include <memory>

namespace relievo {

namespace {

// Darts thrown for each root wanted. More come nearer to a sample into which no further dart fits, at a cost in proportion: with 2.4,
// the 95th percentile of the density in discs of 64 roots is 1.18 times the 5th on the bunny and the dragon, with 3 it is 1.17 times.
constexpr double darts_per_root = 2.4;

// The squared distance at which one dart in 2.4 stays, in units of area / roots: measured on the bunny and the dragon, where the count
// then comes within 3 %.
constexpr double distance_2_per_area = 0.40;

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

// A unit normal in three bytes, enough to say without the mesh at hand whether two faces look the same way, unless it is close.
struct Facing {
    std::int8_t x = 0, y = 0, z = 0;
    Facing() = default;
    explicit Facing(Vec3d n) : x(rounded(n.x)), y(rounded(n.y)), z(rounded(n.z)) {}
    // The sign of the product of the two normals, or 0 where rounding (half a step in each of six numbers) may have changed it.
    int product(Facing o) const {
        const int p = x * o.x + y * o.y + z * o.z;
        return p > 256 ? 1 : p < -256 ? -1 : 0;
    }

private:
    static std::int8_t rounded(double v) { return static_cast<std::int8_t>(static_cast<int>(v * 127 + 128.5) - 128); }
};

// Cells of three distances: a disc around a dart reaches into one or two along each axis.
constexpr float cell_width = 3;


// Buckets hold a few cells' darts; parts of each group hold the buckets that are filled together, few enough to stay in a cache.
constexpr double darts_per_bucket = 10;
constexpr std::uint32_t parts_per_group = 32;

struct Cells {
    Vec3f low;
    float per_unit;
    std::uint32_t mask;  // buckets of one group, less one

    struct Cell {
        std::uint32_t x, y, z;
    };
    // The cell that holds p, and p from its low corner, in cells.
    Cell at(Vec3f p, Vec3f& inside) const {
        const Vec3f q = (p - low) * per_unit;
        const std::int64_t x = static_cast<std::int64_t>(q.x), y = static_cast<std::int64_t>(q.y), z = static_cast<std::int64_t>(q.z);
        inside = {q.x - static_cast<float>(x), q.y - static_cast<float>(y), q.z - static_cast<float>(z)};
        return {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), static_cast<std::uint32_t>(z)};
    }
    // Buckets hold cells of one group only; neighbours along x lie near each other in memory.
    std::uint32_t bucket(Cell c) const {
        const std::uint32_t group = (c.x & 1) | (c.y & 1) << 1 | (c.z & 1) << 2;
        const std::uint32_t h = (c.x >> 1) + (c.y >> 1) * 73856093u + (c.z >> 1) * 19349663u;
        return group * (mask + 1) + (h & mask);
    }
};

bool comes_before(const Root& p, const Root& q) {
    if (p.position.x != q.position.x) return p.position.x < q.position.x;
    return p.position.y != q.position.y || p.position.z != q.position.z ? less(p.position, q.position) : p.face < q.face;
}

// Darts `dart` to below `end_dart`, or to the face's last, of the faces `face` to below `end_face`.
struct Pack {
    std::uint32_t face, end_face, dart, end_dart;
};

template <class Expected>
std::vector<Pack> packs_of(std::uint32_t faces, const Expected& expected) {
    constexpr double darts = 16384;
    constexpr std::uint32_t all = 0xffffffffu;
    std::vector<Pack> packs;
    double sum = 0;
    std::uint32_t from = 0;
    const auto close = [&](std::uint32_t end) {
        if (end > from) packs.push_back({from, end, 0, all});
        from = end;
        sum = 0;
    };
    for (std::uint32_t f = 0; f < faces; ++f) {
        const double wanted = expected(f);
        if (wanted > 2 * darts) {
            close(f);
            const auto most = static_cast<std::uint32_t>(wanted) + 1, step = static_cast<std::uint32_t>(darts);
            for (std::uint32_t d = 0; d < most; d += step) packs.push_back({f, f + 1, d, d + step < most ? d + step : all});
            from = f + 1;
            continue;
        }
        sum += wanted;
        if (sum >= darts || f + 1 - from >= 65536) close(f + 1);
    }
    close(faces);
    return packs;
}

}  // namespace

Vec3d face_vector(const Mesh& mesh, std::uint32_t face) {
    const std::uint32_t* i = &mesh.indices[std::size_t{face} * 3];
    const Vec3d a(mesh.positions[i[0]]), b(mesh.positions[i[1]]), c(mesh.positions[i[2]]);
    return cross(b - a, c - a);
}

Roots grow_roots(const Mesh& mesh, const RootSettings& settings) {
    assert(settings.count >= 1);
    const auto faces = static_cast<std::uint32_t>(mesh.faces());
    constexpr int grain = 4096;
    const std::uint32_t blocks = (faces + grain - 1) / grain;

    // Areas, summed block by block so that rounding does not depend on threads. Twice the area is kept.
    std::vector<double> block_area(blocks, 0.0);
    std::vector<float> areas(faces);
    std::vector<Facing> facing(faces);
    parallel_for(static_cast<int>(faces), grain, settings.threads, [&](int begin, int end) {
        double sum = 0;
        for (int f = begin; f < end; ++f) {
            const Vec3d normal = face_vector(mesh, static_cast<std::uint32_t>(f));
            const double area = length(normal);
            if (area > 0) facing[static_cast<std::size_t>(f)] = Facing(normal * (1 / area));
            areas[static_cast<std::size_t>(f)] = static_cast<float>(area);
            sum += area;
        }
        block_area[static_cast<std::size_t>(begin / grain)] = sum;
    });
    double twice_area = 0;
    for (const double a : block_area) twice_area += a;
    if (!(twice_area > 0) || !std::isfinite(twice_area)) throw Error("grow fur on", mesh.name.empty() ? "the mesh" : mesh.name, "its faces have no area", "scan or save it again: every face is a line or a point, or its size is beyond numbers");

    Roots result;
    result.area = twice_area / 2;
    result.distance = std::sqrt(distance_2_per_area * result.area / settings.count);
    const double darts_per_area = darts_per_root * settings.count / twice_area;
    const auto expected = [&](std::uint32_t f) { return areas[f] * darts_per_area; };

    Cells cells;
    cells.per_unit = static_cast<float>(1 / (cell_width * result.distance));
    cells.low = mesh.positions[mesh.indices[0]];
    for (const Vec3f& p : mesh.positions) cells.low = {std::min(cells.low.x, p.x), std::min(cells.low.y, p.y), std::min(cells.low.z, p.z)};
    cells.mask = std::bit_ceil(static_cast<std::uint32_t>(std::clamp(darts_per_root * settings.count / (darts_per_bucket * 8), double{parts_per_group}, 1e8))) - 1;
    const std::uint32_t buckets = (cells.mask + 1) * 8, parts = parts_per_group * 8, buckets_per_part = buckets / parts;

    // The faces in packs of about as many darts, large faces cut into several.
    const std::vector<Pack> packs = packs_of(faces, expected);

    // Darts pack by pack, each pack in the order of parts: what follows then stays in the processor's cache, and nothing is contended.
    struct Thrown {
        std::vector<Root> darts;
        std::vector<std::uint32_t> begin;  // of each part
    };
    std::vector<Thrown> thrown(packs.size());
    parallel_for(static_cast<int>(packs.size()), 1, settings.threads, [&](int first, int last) {
        std::vector<Root> darts;
        std::vector<std::uint16_t> part_of;
        Vec3f inside;
        for (auto k = static_cast<std::size_t>(first); k < static_cast<std::size_t>(last); ++k) {
            darts.clear();
            part_of.clear();
            for (std::uint32_t f = packs[k].face; f < packs[k].end_face; ++f) {
                const double wanted = expected(f);
                if (!(wanted > 0)) continue;
                const Corners corners = corners_of(mesh, f);
                const FaceRandom random(corners.a, corners.b, corners.c, settings.seed);
                const std::uint32_t count = std::min(dart_count(random, wanted), packs[k].end_dart);
                for (std::uint32_t i = packs[k].dart; i < count; ++i) darts.push_back({dart_at(corners, random, i), f});
            }
            Thrown& t = thrown[k];
            t.begin.assign(parts + 1, 0);
            for (const Root& dart : darts) {
                part_of.push_back(static_cast<std::uint16_t>(cells.bucket(cells.at(dart.position, inside)) / buckets_per_part));
                ++t.begin[part_of.back() + 1u];
            }
            for (std::uint32_t p = 0; p < parts; ++p) t.begin[p + 1] += t.begin[p];
            std::vector<std::uint32_t> next(t.begin.begin(), t.begin.end() - 1);
            t.darts.resize(darts.size());
            for (std::size_t i = 0; i < darts.size(); ++i) t.darts[next[part_of[i]]++] = darts[i];
        }
    });

    // All darts, bucket by bucket, in each by their place.
    struct Bucket {
        std::uint32_t first = 0, kept = 0;
    };
    std::vector<Bucket> bucket(buckets + 1);
    std::vector<std::uint32_t> part_first(parts + 1, 0);
    for (const Thrown& t : thrown)
        for (std::uint32_t p = 0; p < parts; ++p) part_first[p + 1] += t.begin[p + 1] - t.begin[p];
    for (std::uint32_t p = 0; p < parts; ++p) part_first[p + 1] += part_first[p];
    const std::uint32_t total = part_first[parts];
    bucket[buckets].first = total;
    const auto darts = std::make_unique_for_overwrite<Root[]>(total);
    parallel_for(static_cast<int>(parts), 1, settings.threads, [&](int begin, int end) {
        std::vector<std::uint32_t> number, next(buckets_per_part + 1);
        Vec3f inside;
        for (auto p = static_cast<std::uint32_t>(begin); p < static_cast<std::uint32_t>(end); ++p) {
            const auto each = [&](const auto& visit) {
                for (const Thrown& t : thrown)
                    for (std::uint32_t i = t.begin[p]; i < t.begin[p + 1]; ++i) visit(t.darts[i]);
            };
            number.clear();
            std::ranges::fill(next, 0u);
            each([&](const Root& dart) {
                number.push_back(cells.bucket(cells.at(dart.position, inside)) - p * buckets_per_part);
                ++next[number.back() + 1];
            });
            next[0] = part_first[p];
            for (std::uint32_t b = 0; b < buckets_per_part; ++b) {
                bucket[p * buckets_per_part + b].first = next[b];
                next[b + 1] += next[b];
            }
            const std::uint32_t* to = number.data();
            each([&](const Root& dart) { darts[next[*to++]++] = dart; });
            // Packs follow the file; places do not. Among darts at one place, which is what repeated faces throw, the first face's is
            // tried first.
            for (std::uint32_t b = 0, from = part_first[p]; b < buckets_per_part; from = next[b++]) std::sort(&darts[0] + from, &darts[0] + next[b], comes_before);
        }
    });
    thrown = {};

    // Kept darts stand at the front of their bucket.
    const auto near2 = static_cast<float>(result.distance * result.distance);
    const auto same_side = [&](std::uint32_t f, std::uint32_t g) {
        const int sure = facing[f].product(facing[g]);
        return sure != 0 ? sure > 0 : dot(face_vector(mesh, f), face_vector(mesh, g)) > 0;
    };
    const auto taken = [&](const Root& dart, const Bucket& b) {
        for (std::uint32_t i = b.first, last = b.first + b.kept; i < last; ++i) {
            const Vec3f gap = darts[i].position - dart.position;
            if (dot(gap, gap) < near2 && same_side(darts[i].face, dart.face)) return true;
        }
        return false;
    };
    for (std::uint32_t group = 0; group < 8; ++group) {
        const std::uint32_t from = group * (cells.mask + 1);
        parallel_for(static_cast<int>(cells.mask + 1), 512, settings.threads, [&](int begin, int end) {
            constexpr float reach = 1 / cell_width;
            Vec3f inside;
            for (std::uint32_t b = from + static_cast<std::uint32_t>(begin); b < from + static_cast<std::uint32_t>(end); ++b)
                for (std::uint32_t i = bucket[b].first; i < bucket[b + 1].first; ++i) {
                    const Root dart = darts[i];
                    const Cells::Cell c = cells.at(dart.position, inside);
                    // The own bucket first: it is the likeliest to hold a neighbour.
                    bool free = !taken(dart, bucket[b]);
                    const int dx = inside.x < reach ? -1 : inside.x > 1 - reach, dy = inside.y < reach ? -1 : inside.y > 1 - reach,
                              dz = inside.z < reach ? -1 : inside.z > 1 - reach;
                    const int way = (dx != 0) | (dy != 0) << 1 | (dz != 0) << 2;
                    for (int n = 1; n < 8 && free; ++n) {
                        if ((n & way) != n) continue;
                        const Cells::Cell cell{c.x + static_cast<std::uint32_t>(n & 1 ? dx : 0), c.y + static_cast<std::uint32_t>(n & 2 ? dy : 0),
                                               c.z + static_cast<std::uint32_t>(n & 4 ? dz : 0)};
                        free = !taken(dart, bucket[cells.bucket(cell)]);
                    }
                    if (free) darts[bucket[b].first + bucket[b].kept++] = dart;
                }
        });
    }

    result.roots.reserve(static_cast<std::size_t>(settings.count * 1.1));
    for (std::uint32_t b = 0; b < buckets; ++b)
        result.roots.insert(result.roots.end(), &darts[0] + bucket[b].first, &darts[0] + bucket[b].first + bucket[b].kept);
    return result;
}

Vec3f corner_weights(const Mesh& mesh, const Root& root) {
    const std::uint32_t* v = &mesh.indices[std::size_t{root.face} * 3];
    const Vec3d a(mesh.positions[v[0]]), e1 = Vec3d(mesh.positions[v[1]]) - a, e2 = Vec3d(mesh.positions[v[2]]) - a, d = Vec3d(root.position) - a;
    const Vec3d n = cross(e1, e2);
    const double n2 = dot(n, n);
    if (!(n2 > 0)) return {1, 0, 0};
    const double u = std::clamp(dot(cross(d, e2), n) / n2, 0.0, 1.0), w = std::clamp(dot(cross(e1, d), n) / n2, 0.0, 1.0 - u);
    return Vec3f(Vec3d(1 - u - w, u, w));
}

}  // namespace relievo
