// The CPU caster never misses the first hit, on every instruction set this processor runs. For a long run:
//   RELIEVO_EXACT_RAYS=20000000 RELIEVO_EXACT_SIZE=1024 test_cast --gtest_filter='cast.never*'
#include "cast/first_hit_judge.h"
#include "core/error.h"
#include "core/parallel_for.h"
#include "techniques/adversarial_fields.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <numbers>
#include <random>

using namespace relievo;

namespace {

// Sixteen rays as a picture has them, or sixteen that have nothing to do with each other. Among them rays along axes and diagonals,
// rays from exactly a texel, rays far from the origin and rays that end above the floor.
void append_packet(std::mt19937_64& random, const HeightField& field, std::vector<CastRay>& rays) {
    std::uniform_real_distribution<double> uniform(0, 1);
    const bool coherent = random() % 4 != 0;
    const double spread =
        coherent ? std::exp(std::lerp(std::log(0.05), std::log(6.0), uniform(random))) : 0;  // texels between rays
    const double turn = random() % 2 ? 1e-3 : 0;                                             // perspective
    struct Way {
        double elevation, azimuth, scale, u, v, zero_level, z_start, z_end;
        unsigned special;
    };
    const auto any_way = [&] {
        const double z_end = random() % 4 ? 0 : uniform(random) * 0.9;
        return Way{std::lerp(5.0, 85.0, uniform(random)) * std::numbers::pi / 180,
                   uniform(random) * 2 * std::numbers::pi,
                   std::lerp(0.02, 0.15, uniform(random)),
                   uniform(random) * 2,
                   uniform(random) * 2,
                   static_cast<double>(random() % 3) / 2,
                   random() % 8 ? 1 : std::lerp(z_end, 1.0, uniform(random)),
                   z_end,
                   static_cast<unsigned>(random() % 16)};
    };
    Way way = any_way();
    for (int k = 0; k < 16; ++k) {
        if (!coherent) way = any_way();
        const double azimuth = way.azimuth + turn * (k % 4), elevation = way.elevation + turn * (k / 4);
        Vec2d view{std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth)};
        if (way.special == 0) (way.azimuth > 3 ? view.x : view.y) = 0;
        if (way.special == 1) view.y = way.azimuth > 3 ? view.x : -view.x;
        Vec2d uv{way.u + spread * (k % 4) / field.width(), way.v + spread * (k / 4) / field.height()};
        if (way.special == 2) uv = {(std::floor(uv.x * 16) + 0.5) / field.width(), (std::floor(uv.y * 16) + 0.5) / field.height()};
        if (way.special == 3) uv = uv + Vec2d{-6, 5};
        rays.push_back({.uv = Vec2f(uv),
                        .uv_per_height = Vec2f(view * (way.scale / std::sin(elevation))),
                        .zero_level = static_cast<float>(way.zero_level),
                        .z_start = static_cast<float>(way.z_start),
                        .z_end = static_cast<float>(way.z_end)});
    }
}

std::vector<CastHit> cast(const HeightFieldCaster& caster, const std::vector<CastRay>& rays) {
    std::vector<CastHit> hits(rays.size());
    caster.cast(rays, hits);
    return hits;
}

bool same_bits(const CastHit& a, const CastHit& b) {
    return std::memcmp(&a.uv, &b.uv, sizeof a.uv) == 0 && std::memcmp(&a.height, &b.height, sizeof a.height) == 0 &&
           a.found == b.found;
}

long number(const char* variable, long otherwise) {
    const char* text = std::getenv(variable);
    return text ? std::atol(text) : otherwise;
}

HeightField noise(int width, int height, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    return adversarial::filled(width, height, [&](int, int) { return uniform(random); });
}

}  // namespace

TEST(cast, level_fields_are_met_at_their_height) {
    for (const std::string& target : caster_targets()) {
        for (const float level : {0.0f, 0.25f, 1.0f}) {
            const HeightFieldCaster caster(HeightField(64, 48, level), {.target = target});
            const std::vector<CastRay> rays(5, {.uv = {0.5f, -0.25f}, .uv_per_height = {0.2f, -0.1f}});
            for (const CastHit& hit : cast(caster, rays)) {
                EXPECT_TRUE(hit.found);
                EXPECT_NEAR(hit.height, level, 2e-7) << target;
                EXPECT_NEAR(hit.uv.x, 0.5 + (level - 1) * 0.2, 1e-6) << target;
                EXPECT_NEAR(hit.uv.y, -0.25 - (level - 1) * 0.1, 1e-6) << target;
            }
        }
    }
}

// Height rises by 1/2 over half a period: h(u) = u between texel centres. A ray z = 1 - (u - u0) / r meets it at u = (1 + u0 / r) r
// / (1 + r).
TEST(cast, a_slope_is_met_where_the_lines_cross) {
    const int n = 128;
    const HeightField field = adversarial::filled(n, 8, [](int i, int) { return (i + 0.5) / n; });
    for (const std::string& target : caster_targets()) {
        const HeightFieldCaster caster(field, {.target = target});
        const double reach = 0.4, u0 = 0.2;
        const auto hits = cast(caster, std::vector<CastRay>(17, {.uv = {static_cast<float>(u0), 0.3f},
                                                                 .uv_per_height = {static_cast<float>(-reach), 0}}));
        const double u = (u0 + reach) / (1 + reach);
        for (const CastHit& hit : hits) {
            EXPECT_NEAR(hit.uv.x, u, 1e-6) << target;
            EXPECT_NEAR(hit.height, u, 1e-6) << target;
        }
    }
}

TEST(cast, never_misses_the_first_hit) {
    const long rays_in_all = number("RELIEVO_EXACT_RAYS", 400000);
    const int size = static_cast<int>(number("RELIEVO_EXACT_SIZE", 128));
    const auto fields = adversarial::all(size, 1);
    const auto targets = caster_targets();
    std::vector<Verdicts> sums(targets.size());
    for (std::size_t f = 0; f < fields.size(); ++f) {
        const HeightField& field = fields[f].field;
        std::vector<HeightFieldCaster> casters;
        for (const std::string& target : targets) casters.emplace_back(field, CasterSettings{.threads = 1, .target = target});
        const int block = 1 << 12;
        const int blocks = static_cast<int>((rays_in_all / static_cast<long>(fields.size()) + block - 1) / block);
        std::vector<std::vector<Verdicts>> tallies(static_cast<std::size_t>(blocks), std::vector<Verdicts>(targets.size()));
        parallel_for(blocks, 1, 0, [&](int begin, int end) {
            for (int b = begin; b < end; ++b) {
                std::mt19937_64 random(f * 1000003ull + static_cast<unsigned>(b));
                std::vector<CastRay> rays;
                while (rays.size() < block) append_packet(random, field, rays);
                std::vector<ReferenceHit> truth;
                for (const CastRay& r : rays) truth.push_back(reference_cast(field, in_double(r)));
                for (std::size_t t = 0; t < targets.size(); ++t) {
                    const auto hits = cast(casters[t], rays);
                    for (std::size_t k = 0; k < rays.size(); ++k)
                        judge(field, rays[k], truth[k], hits[k], tallies[static_cast<std::size_t>(b)][t]);
                }
            }
        });
        for (std::size_t t = 0; t < targets.size(); ++t) {
            Verdicts here;
            for (const auto& tally : tallies) here += tally[t];
            if (here.late + here.early + here.tangent > 0)
                std::printf("%-18s %-7s late %ld early %ld tangent %ld\n", fields[f].name.c_str(), targets[t].c_str(), here.late,
                            here.early, here.tangent);
            sums[t] += here;
        }
    }
    for (std::size_t t = 0; t < targets.size(); ++t) {
        const Verdicts& v = sums[t];
        std::printf(
            "%-7s %ld rays: late %ld, early %ld, tangent %ld (worst %.2f of the bound), height error of the others %.2g, off the "
            "ray %.2g texels\n",
            targets[t].c_str(), v.rays, v.late, v.early, v.tangent, v.worst_excused, v.worst_height, v.worst_uv_texels);
        EXPECT_LE(static_cast<double>(v.late + v.early), 1e-6 * static_cast<double>(v.rays)) << targets[t];
        EXPECT_LE(static_cast<double>(v.tangent), 1e-5 * static_cast<double>(v.rays)) << targets[t];
        EXPECT_LE(v.worst_uv_texels, 1e-3) << targets[t];  // float texture coordinates near 8, 1024 texels
    }
}

// Which rays share a vector is an accident: alone, in any number and in any order a ray has the same hit, up to rounding.
TEST(cast, a_ray_does_not_depend_on_its_neighbours) {
    const HeightField field = adversarial::cobble(96, 80, 3);
    std::mt19937_64 random(5);
    std::vector<CastRay> rays;
    while (rays.size() < 1024) append_packet(random, field, rays);
    for (const std::string& target : caster_targets()) {
        const HeightFieldCaster caster(field, {.target = target});
        const auto together = cast(caster, rays);
        for (std::size_t first = 0, count = 1; first + count <= rays.size(); first += count, count = count % 37 + 1) {
            std::vector<CastHit> few(count);
            caster.cast(std::span(rays).subspan(first, count), few);
            for (std::size_t k = 0; k < count; ++k) {
                Verdicts v;
                judge(field, rays[first + k], reference_cast(field, in_double(rays[first + k])), few[k], v);
                EXPECT_EQ(v.late + v.early, 0) << target << " ray " << first + k;
                EXPECT_NEAR(few[k].height, together[first + k].height, 1e-4) << target << " ray " << first + k;
            }
        }
    }
}

TEST(cast, threads_change_no_bit) {
    const HeightField field = adversarial::fbm(256, 256, 2);
    std::mt19937_64 random(6);
    std::vector<CastRay> rays;
    while (rays.size() < 40000) append_packet(random, field, rays);
    const auto one = cast(HeightFieldCaster(field, {.threads = 1}), rays);
    for (const int threads : {2, 3, 0}) {
        const auto more = cast(HeightFieldCaster(field, {.threads = threads}), rays);
        for (std::size_t k = 0; k < rays.size(); ++k) ASSERT_TRUE(same_bits(one[k], more[k])) << threads << " threads, ray " << k;
    }
}

TEST(cast, says_where_a_ray_ended_that_met_nothing) {
    const HeightFieldCaster caster(HeightField(32, 32, 0.25f));
    const auto hits = cast(caster, {{.uv = {0.5f, 0.5f}, .uv_per_height = {0.1f, 0.2f}, .z_end = 0.5f},
                                    {.uv = {0.5f, 0.5f}, .uv_per_height = {0, 0}, .z_start = 0.5f, .z_end = 0.5f}});
    EXPECT_FALSE(hits[0].found);
    EXPECT_FLOAT_EQ(hits[0].height, 0.5f);
    EXPECT_FLOAT_EQ(hits[0].uv.x, 0.45f);
    EXPECT_FLOAT_EQ(hits[0].uv.y, 0.4f);
    EXPECT_FALSE(hits[1].found);
    EXPECT_TRUE(cast(caster, {}).empty());
}

TEST(cast, a_ray_that_starts_below_the_surface_has_met_it) {
    const HeightFieldCaster caster(HeightField(32, 32, 0.75f));
    const auto hits = cast(caster, std::vector<CastRay>(16, {.uv = {0.5f, 0.5f}, .uv_per_height = {0.1f, 0.2f}, .z_start = 0.5f}));
    for (const CastHit& hit : hits) {
        EXPECT_TRUE(hit.found);
        EXPECT_FLOAT_EQ(hit.height, 0.5f);
    }
}

// Nothing is promised about rays that are no rays, except that the walk ends and the others are not disturbed.
TEST(cast, a_ray_without_numbers_harms_no_other) {
    const HeightField field = noise(64, 64, 1);
    const float nan = std::nanf(""), infinity = INFINITY;
    for (const std::string& target : caster_targets()) {
        const HeightFieldCaster caster(field, {.target = target});
        const CastRay good{.uv = {0.3f, 0.6f}, .uv_per_height = {0.2f, 0.1f}};
        for (const CastRay& bad :
             {CastRay{.uv = {nan, 0}, .uv_per_height = {0.1f, 0.1f}}, CastRay{.uv = {0, 0}, .uv_per_height = {infinity, 0}},
              CastRay{.uv = {0, infinity}, .uv_per_height = {0, nan}},
              CastRay{.uv = {0, 0}, .uv_per_height = {0, 0}, .z_start = nan},
              CastRay{.uv = {0, 0}, .uv_per_height = {1e20f, 1e20f}}}) {
            const auto hits = cast(caster, {good, bad, good});
            EXPECT_NEAR(hits[0].height, reference_cast(field, in_double(good)).height, 1e-6) << target;
            EXPECT_TRUE(same_bits(hits[0], hits[2]));
        }
    }
}

TEST(cast, refuses_what_is_no_height_field) {
    EXPECT_THROW(HeightFieldCaster(HeightField{}), Error);
    for (const float bad : {-0.01f, 1.01f, std::nanf(""), INFINITY}) {
        HeightField field(16, 16, 0.5f);
        field.texels(3, 15) = bad;
        EXPECT_THROW(HeightFieldCaster{field}, Error) << bad;
    }
    try {
        HeightFieldCaster(HeightField(4, 4, 0.5f), {.target = "abacus"});
        FAIL();
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("abacus"), std::string::npos);
        EXPECT_NE(std::string(e.what()).find("scalar"), std::string::npos) << "it names those there are";
    }
    for (const std::string& target : caster_targets())
        EXPECT_EQ(HeightFieldCaster(HeightField(4, 4, 0.5f), {.target = target}).target(), target);
}
