// Contract 4: a technique reads the maps and knobs of its row, all of them and no others.
#include "contract/random_fields.h"
#include "contract/trace.h"

#include <cstring>
#include <set>
#include <stdexcept>

namespace relievo::contract {
namespace {

constexpr float height_scale = 0.1f;

const MapSet& rubble() {
    static const MapSet maps = baked_maps(rough_field(21), height_scale);
    return maps;
}

std::vector<SurfaceRay> some_rays() {
    std::vector<SurfaceRay> rays;
    for (const double elevation : {8.0, 30.0, 70.0})
        for (const SurfaceRay& ray : random_rays(200, elevation, height_scale, 1.0f, 22)) rays.push_back(ray);
    return rays;
}

bool same_bits(const SurfaceHit& a, const SurfaceHit& b) {
    return a.found == b.found && std::memcmp(&a.uv, &b.uv, sizeof a.uv) == 0 && std::memcmp(&a.height, &b.height, sizeof a.height) == 0;
}

class Declarations : public EveryTechnique {};

// Undeclared maps are not bound, and the accessors throw where a map is not bound.
TEST_P(Declarations, reads_no_undeclared_map) {
    for (const SurfaceRay& ray : some_rays()) ASSERT_NO_THROW(trace(technique(), rubble(), ray, defaults()));
}

TEST_P(Declarations, reads_every_declared_map) {
    for (const Map map : technique().maps) {
        glsl::BoundMaps bound = declared_maps(technique(), rubble());
        ASSERT_NE(map, Map::colour) << "no search reads colour";
        bound.readable.reset(index_of(map));
        bool read = false;
        for (const SurfaceRay& ray : some_rays()) {
            try {
                trace(technique(), bound, ray, defaults());
            } catch (const std::logic_error&) {
                read = true;
                break;
            }
        }
        EXPECT_TRUE(read) << "map number " << static_cast<int>(map) << " is declared and never read";
    }
}

TEST_P(Declarations, names_each_map_and_knob_once) {
    EXPECT_EQ(std::set<Map>(technique().maps.begin(), technique().maps.end()).size(), static_cast<std::size_t>(technique().maps.count));
    std::set<const Knob*> named;
    for (const KnobDefault& d : technique().knobs) {
        EXPECT_TRUE(named.insert(d.knob).second) << d.knob->id;
        EXPECT_GE(d.value, d.knob->min) << d.knob->id;
        EXPECT_LE(d.value, d.knob->max) << d.knob->id;
    }
}

TEST_P(Declarations, ignores_undeclared_knobs) {
    for (const Knob* knob : knobs) {
        if (std::ranges::any_of(technique().knobs, [&](const KnobDefault& d) { return d.knob == knob; })) continue;
        for (const float t : {0.0f, 0.3f, 1.0f}) {
            MarchParams params = defaults();
            knob->set(params, knob->min + t * (knob->max - knob->min));
            for (const SurfaceRay& ray : some_rays()) {
                ASSERT_TRUE(same_bits(trace(technique(), rubble(), ray, defaults()).hit, trace(technique(), rubble(), ray, params).hit)) << knob->id;
            }
        }
    }
}

TEST_P(Declarations, obeys_every_declared_knob) {
    for (const KnobDefault& d : technique().knobs) {
        MarchParams low = defaults();
        MarchParams high = defaults();
        d.knob->set(low, d.knob->min);
        d.knob->set(high, std::min(d.knob->max, 256.0f));
        int changed = 0;
        for (const SurfaceRay& ray : some_rays())
            changed += same_bits(trace(technique(), rubble(), ray, low).hit, trace(technique(), rubble(), ray, high).hit) ? 0 : 1;
        EXPECT_GT(changed, 0) << d.knob->id << " is declared and changes nothing";
    }
}

FOR_EVERY_TECHNIQUE(Declarations);

}  // namespace
}  // namespace relievo::contract
