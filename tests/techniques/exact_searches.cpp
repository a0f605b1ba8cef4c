// The claim of every row that says `exact`, put to the reference: it never misses the first hit of the declared surface, seen from the
// eye or from a light. Both are given the same float ray; the reference reads it in double. Every disagreement of more than half a
// texel along the ray is decided in double: it is a *tangency* where float rounding of that ray explains it (see `Rounding`), else
// real.
//
// A short run belongs to the tests. For a long one, also over height maps from files, with another seed if it is not the first:
//   RELIEVO_EXACT_RAYS=20000000 RELIEVO_EXACT_SIZE=1024 RELIEVO_EXACT_SEED=2 RELIEVO_EXACT_MAPS=a.png:b.png
//   test_techniques --gtest_filter='*exact_searches.never*'
#include "assets/image_file.h"
#include "core/map_set.h"
#include "core/parallel_for.h"
#include "maps/map_kinds.h"
#include "reference/cast.h"
#include "reference/cell_walk.h"
#include "techniques/adversarial_fields.h"
#include "techniques/catalogue.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <sstream>

using namespace relievo;

namespace {

std::vector<const Technique*> exact_techniques() {
    std::vector<const Technique*> all;
    for (const Technique& t : techniques())
        if (t.exact) all.push_back(&t);
    return all;
}

MapSet maps_for(const Technique& technique, const HeightField& field) {
    MapSet maps;
    maps.height = field;
    const Progress silent;
    for (const Map map : technique.maps)
        if (const auto bake = map_kind(map).bake) bake(maps, {.height_scale = 0.1f, .threads = 0, .progress = silent});
    return maps;
}

struct Tally {
    long rays = 0;
    long late = 0;        // more than half a texel behind the true first hit, without an excuse
    long early = 0;
    long tangent_late = 0;
    long tangent_early = 0;
    long out_of_steps = 0;
    double fetches = 0;
    double most_fetches = 0;
    double worst_excused = 0;    // largest penetration counted as tangency, in units of its bound
    double worst_height = 0;     // largest height error of agreeing hits
    Tally& operator+=(const Tally& o) {
        rays += o.rays, late += o.late, early += o.early, tangent_late += o.tangent_late, tangent_early += o.tangent_early;
        out_of_steps += o.out_of_steps, fetches += o.fetches, most_fetches = std::max(most_fetches, o.most_fetches);
        worst_excused = std::max(worst_excused, o.worst_excused), worst_height = std::max(worst_height, o.worst_height);
        return *this;
    }
    long real() const { return late + early; }
    long tangent() const { return tangent_late + tangent_early; }
};

// How far float rounding can move the field against the ray in a solved cell, as a height and as a distance in cells (which
// becomes a height by the cell's slopes). With u = 2^-24, half a unit in the last place below 1, U = |uv_per_height| and heights,
// gaps and positions in a cell at most 1 (2 for the twist d):
//   height: z, zero_level - z and the entry's z, u/2 each; b and c u/2 each, d 2u; the products b x and c y u/2 each, d x y 2u; the
//           four sums of the gap 4u; the discriminant acts like 2u more on the gap where it decides. Sum 13u, taken as 16u.
//   cells:  the rests of cell_position.glsl are at most (4 + U) / 4096 of a period and go through four operations: with the
//           factor `texels` 2u (4 + U) texels / 4096; putting the position together, to the cell's wall and clamping: 8u. The split
//           product of cell_hit.glsl leaves (U texels / 4096 + 1) u where the pace is below 4096 cells.
// Cells the walk chooses by its plainer position are not in the bound: what it leaves out is a corner no wider than the bound
// times the way, and counts as real where it mattered.
struct Rounding {
    double height;
    double cells;
};

Rounding rounding_of(const glsl::SurfaceRay& ray, Vec2d size) {
    constexpr double u = 0x1p-24;
    const double way = std::max(std::abs(ray.uv_per_height.x), std::abs(ray.uv_per_height.y));
    return {.height = 16 * u, .cells = 8 * u + 2 * u * (4 + way) * std::max(size.x, size.y) / 4096};
}

Vec2f uv_per_height_of(Vec3f view, float height_scale) { return Vec2f{view.x, view.y} * (height_scale / view.z); }

// Largest gap (field minus ray) on the ray between two heights, and the same weighed against the rounding bound of its cell.
struct Extreme {
    double gap;
    double in_bounds;
};

Extreme deepest(const HeightField& field, const ReferenceRay& ray, double z_from, double z_to, Rounding rounding) {
    const Vec2d size{static_cast<double>(field.width()), static_cast<double>(field.height())};
    const Vec2d start = (ray.uv + (z_from - ray.zero_level) * ray.uv_per_height) * size - Vec2d{0.5, 0.5};
    CellWalk walk(field, start, -(ray.uv_per_height * size));
    Extreme worst{-1, -1e9};
    for (;; walk.advance()) {
        const double leave = std::min(walk.leaves(), z_from - z_to);
        const CellGap g = walk.gap(z_from - walk.entered(), -1);
        const double limit = leave - walk.entered();
        double gap = std::max(g.gap, g.at(limit));
        const double vertex = -g.slope / (2 * g.bend);
        if (g.bend < 0 && vertex > 0 && vertex < limit) gap = std::max(gap, g.at(vertex));
        const Vec2i c = walk.cell();
        const auto h = field.cell(c.x, c.y);
        const double slope = std::max(std::abs(h[1] - h[0]), std::abs(h[3] - h[2])) + std::max(std::abs(h[2] - h[0]), std::abs(h[3] - h[1]));
        const double bound = rounding.height + rounding.cells * slope;
        worst.gap = std::max(worst.gap, gap);
        worst.in_bounds = std::max(worst.in_bounds, gap / bound);
        if (walk.leaves() >= z_from - z_to) return worst;
    }
}

struct RayKind {
    double low_deg = 5, high_deg = 85;
    double low_scale = 0.02, high_scale = 0.15;
    bool any_zero_level = true;
    bool lights = true;  // one ray in eight comes from a light and ends above the floor
};

Tally compare(const Technique& technique, const MapSet& maps, long rays, const RayKind& kind, unsigned seed) {
    const HeightField& field = maps.height;
    const MarchParams params = default_params(technique);
    const int block = 1 << 14;
    const int blocks = static_cast<int>((rays + block - 1) / block);
    std::vector<Tally> tallies(static_cast<std::size_t>(blocks));
    parallel_for(blocks, 1, 0, [&](int begin, int end) {
        glsl::bound_maps = declared_maps(technique, maps);
        for (int b = begin; b < end; ++b) {
            Tally& tally = tallies[static_cast<std::size_t>(b)];
            std::mt19937_64 random(seed * 1000003ull + static_cast<unsigned>(b));
            std::uniform_real_distribution<double> uniform(0, 1);
            for (int k = 0; k < block; ++k) {
                const double elevation = std::lerp(kind.low_deg, kind.high_deg, uniform(random)) * std::numbers::pi / 180;
                double azimuth = uniform(random) * 2 * std::numbers::pi;
                glsl::SurfaceRay ray{};
                ray.view = {static_cast<float>(std::cos(elevation) * std::cos(azimuth)), static_cast<float>(std::cos(elevation) * std::sin(azimuth)),
                            static_cast<float>(std::sin(elevation))};
                // One ray in sixteen runs exactly along an axis, one exactly along a diagonal, one starts exactly at a texel.
                const auto special = random() % 16;
                if (special == 0) (random() % 2 ? ray.view.x : ray.view.y) = 0;
                if (special == 1) ray.view.y = random() % 2 ? ray.view.x : -ray.view.x;
                ray.height_scale = static_cast<float>(std::lerp(kind.low_scale, kind.high_scale, uniform(random)));
                ray.zero_level = kind.any_zero_level ? static_cast<float>(random() % 3) / 2 : 1.0f;
                ray.uv_per_height = uv_per_height_of(ray.view, ray.height_scale);
                ray.uv = {static_cast<float>(uniform(random) * 2), static_cast<float>(uniform(random) * 2)};
                if (special == 2) {
                    ray.uv = {static_cast<float>((std::floor(ray.uv.x * 16) + 0.5) / field.width()), static_cast<float>((std::floor(ray.uv.y * 16) + 0.5) / field.height())};
                }
                if (special == 3) ray.uv = ray.uv + Vec2f{-6, 5};
                ray.z_start = 1;
                ray.z_end = 0;
                if (kind.lights && random() % 8 == 0) {
                    ray.z_end = static_cast<float>(uniform(random));
                    if (random() % 4 == 0) ray.z_start = static_cast<float>(1 + 0.25 * uniform(random));
                }
                glsl::fetch_count = 0;
                const glsl::SurfaceHit found = technique.heightfield(ray, params);
                const ReferenceRay same{.uv = Vec2d(ray.uv), .uv_per_height = Vec2d(ray.uv_per_height), .zero_level = ray.zero_level,
                                        .z_start = ray.z_start, .z_end = ray.z_end};
                const ReferenceHit truth = reference_cast(field, same);

                ++tally.rays;
                tally.fetches += glsl::fetch_count;
                tally.most_fetches = std::max(tally.most_fetches, static_cast<double>(glsl::fetch_count));
                if (glsl::fetch_count >= params.max_steps) ++tally.out_of_steps;
                const Vec2d size{static_cast<double>(field.width()), static_cast<double>(field.height())};
                const double speed = length(same.uv_per_height * size);
                // What was not found lies beyond the end.
                const double last = ray.z_end;
                const double z = found.found ? found.height : last;
                const double true_z = truth.found ? truth.height : last;
                const double behind = (true_z - z) * speed;
                const Rounding rounding = rounding_of(ray, size);
                if (behind > 0.5 || (!found.found && last == 0)) {
                    const Extreme e = deepest(field, same, true_z, std::max(z, last), rounding);
                    if (e.in_bounds <= 1) ++tally.tangent_late, tally.worst_excused = std::max(tally.worst_excused, e.in_bounds);
                    else {
                        if (tally.late++ == 0 && std::getenv("RELIEVO_EXACT_VERBOSE"))
                            std::printf("    late: z %.9g true %.9g behind %.3f texels, gap %.3g = %.3g bounds, view z %.4f\n", z, true_z, behind, e.gap, e.in_bounds, ray.view.z);
                    }
                } else if (behind < -0.5) {
                    // How far the ray is above the field where it was said to meet it.
                    const Extreme e = deepest(field, same, std::min(same.z_start, z + 0.25 / speed), std::max(z - 0.25 / speed, last), rounding);
                    if (e.in_bounds >= -1) ++tally.tangent_early, tally.worst_excused = std::max(tally.worst_excused, -e.in_bounds);
                    else {
                        if (tally.early++ == 0 && std::getenv("RELIEVO_EXACT_VERBOSE"))
                            std::printf("    early: z %.9g true %.9g behind %.3f texels, gap %.3g = %.3g bounds, view z %.4f\n", z, true_z, behind, e.gap, e.in_bounds, ray.view.z);
                    }
                } else {
                    tally.worst_height = std::max(tally.worst_height, std::abs(true_z - z));
                }
            }
        }
    });
    Tally sum;
    for (const Tally& t : tallies) sum += t;
    return sum;
}

void print(const std::string& name, const Tally& t) {
    std::printf("%-20s %9ld rays  real late %ld early %ld  tangent late %ld early %ld (worst %.2f of the bound)  fetches %.1f (max %.0f)  height error %.2g%s\n",
                name.c_str(), t.rays, t.late, t.early, t.tangent_late, t.tangent_early, t.worst_excused, t.fetches / static_cast<double>(t.rays), t.most_fetches,
                t.worst_height, t.out_of_steps ? "  OUT OF STEPS" : "");
    std::fflush(stdout);
}

long number(const char* variable, long otherwise) {
    const char* text = std::getenv(variable);
    return text ? std::atol(text) : otherwise;
}

HeightField first_channel(const std::string& path) {
    const ImageF image = read_image(path);
    HeightField field(image.width, image.height);
    for (int j = 0; j < image.height; ++j)
        for (int i = 0; i < image.width; ++i) field.texels(i, j) = image(i, j, 0);
    return field;
}

}  // namespace

class exact_searches : public testing::TestWithParam<const Technique*> {};

TEST_P(exact_searches, never_miss_the_first_hit) {
    const long rays = number("RELIEVO_EXACT_RAYS", 500000);
    const int size = static_cast<int>(number("RELIEVO_EXACT_SIZE", 256));
    const unsigned seed = static_cast<unsigned>(number("RELIEVO_EXACT_SEED", 1));
    std::vector<adversarial::Named> fields = adversarial::all(size, seed);
    if (const char* maps = std::getenv("RELIEVO_EXACT_MAPS")) {
        std::stringstream list(maps);
        for (std::string path; std::getline(list, path, ':');) fields.push_back({path, first_channel(path)});
    }
    Tally sum;
    for (std::size_t k = 0; k < fields.size(); ++k) {
        const Tally t = compare(*GetParam(), maps_for(*GetParam(), fields[k].field), rays / static_cast<long>(fields.size()), {}, 1000 * (seed - 1) + static_cast<unsigned>(k));
        if (std::getenv("RELIEVO_EXACT_RAYS")) print(fields[k].name, t);
        sum += t;
    }
    print(std::string(GetParam()->id), sum);
    EXPECT_EQ(sum.out_of_steps, 0);
    EXPECT_LE(static_cast<double>(sum.real()), 1e-6 * static_cast<double>(sum.rays));
    EXPECT_LE(static_cast<double>(sum.tangent()), 1e-5 * static_cast<double>(sum.rays));
}

INSTANTIATE_TEST_SUITE_P(all, exact_searches, testing::ValuesIn(exact_techniques()), [](const auto& row) { return std::string(row.param->id); });

struct FetchBound {
    const char* technique;
    const char* field;
    std::array<double, 3> most;  // at 60, 30 and 15 degrees: what was measured and a tenth; a change that costs more should be noticed
};
constexpr FetchBound fetch_bounds[] = {
    {"max_mip_tracing", "fbm", {10, 14.5, 20}},
    {"max_mip_tracing", "cobble", {13.4, 19.9, 25.4}},
    {"max_mip_tracing", "spikes", {22.2, 53.6, 96}},
    {"cell_cone_tracing", "fbm", {5.7, 10, 14.8}},
    {"cell_cone_tracing", "cobble", {8.7, 13.3, 16.9}},
    {"cell_cone_tracing", "spikes", {14, 30.3, 51}},
};

// Fetches per ray of a 1024^2 field at height_scale 0.1.
TEST(exact_search_costs, fetches_stay_few) {
    const adversarial::Named fields[] = {{"fbm", adversarial::fbm(1024, 1024, 1)}, {"cobble", adversarial::cobble(1024, 1024, 1)}, {"spikes", adversarial::spikes(1024, 1024, 1)}};
    for (const FetchBound& bound : fetch_bounds) {
        const auto& field = *std::ranges::find(fields, bound.field, &adversarial::Named::name);
        const MapSet maps = maps_for(*find_technique(bound.technique), field.field);
        for (std::size_t k = 0; k < 3; ++k) {
            const double degrees = std::array{60.0, 30.0, 15.0}[k];
            const Tally t = compare(*find_technique(bound.technique), maps, 16000, {degrees, degrees, 0.1, 0.1, false, false}, 7);
            const double mean = t.fetches / static_cast<double>(t.rays);
            RecordProperty(std::string(bound.technique) + "_" + bound.field + "_" + std::to_string(static_cast<int>(degrees)), std::to_string(mean));
            EXPECT_LE(mean, bound.most[k]) << bound.technique << " on " << bound.field << " at " << degrees << " degrees";
        }
    }
}

TEST(exact_search_costs, are_bounded_for_every_exact_technique) {
    for (const Technique* t : exact_techniques()) EXPECT_TRUE(std::ranges::find(fetch_bounds, t->id, &FetchBound::technique) != std::end(fetch_bounds)) << t->id;
}
