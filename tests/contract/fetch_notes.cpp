// Every fetch of every technique can be noted with its place and what was read there, and noting changes nothing: figures of a
// search at work (src/explain) are made from these notes. A new accessor in techniques/glsl.cpp ends with note_point or note_node.
#include "contract/random_fields.h"
#include "contract/trace.h"

#include <cstring>

namespace relievo::contract {
namespace {

class FetchNotes : public EveryTechnique {};

TEST_P(FetchNotes, say_where_and_what) {
    constexpr float height_scale = 0.1f;
    static const MapSet maps = baked_maps(rough_field(21), height_scale);
    for (const double elevation : {8.0, 30.0, 70.0}) {
        for (const SurfaceRay& ray : random_rays(60, elevation, height_scale, 1.0f, 23)) {
            const Traced unseen = trace(technique(), maps, ray, defaults());
            std::vector<glsl::Fetch> log;
            glsl::fetch_log = &log;
            const Traced seen = trace(technique(), maps, ray, defaults());
            glsl::fetch_log = nullptr;
            EXPECT_EQ(std::memcmp(&seen.hit.uv, &unseen.hit.uv, sizeof seen.hit.uv), 0);
            EXPECT_EQ(seen.hit.height, unseen.hit.height);
            ASSERT_EQ(static_cast<int>(log.size()), seen.fetches);
            for (const glsl::Fetch& f : log) {
                ASSERT_TRUE(technique().maps.contains(f.map));
                ASSERT_NE(f.place, glsl::Fetch::Place::unnamed) << "the accessor of map number " << static_cast<int>(f.map) << " notes no place";
                if (f.map != Map::height) continue;
                // Read once more, in double.
                if (f.place == glsl::Fetch::Place::point) {
                    ASSERT_NEAR(f.value.x, maps.height.sample(Vec2d(f.uv)), 1e-4);
                } else {
                    ASSERT_EQ(f.place, glsl::Fetch::Place::cell);
                    const auto corners = maps.height.cell(f.index.x, f.index.y);
                    ASSERT_TRUE(corners[0] == f.value.x && corners[1] == f.value.y && corners[2] == f.value.z && corners[3] == f.value.w);
                }
            }
        }
    }
}

FOR_EVERY_TECHNIQUE(FetchNotes);

}  // namespace
}  // namespace relievo::contract
