// Normal mapping (Cohen, Olano, Manocha 1998) changes the shading and nothing else: what is seen where is texture mapping's.
#include "contract/trace.h"

namespace relievo::contract {
namespace {

TEST(NormalMapping, sees_what_texture_mapping_sees) {
    const MapSet none;
    for (const SurfaceRay& ray : random_rays(200, 20, 0.1f, 0.4f, 1)) {
        const SurfaceHit plain = trace(*find_technique("texture_mapping"), none, ray, {}).hit;
        const SurfaceHit shaded = trace(*find_technique("normal_mapping"), none, ray, {}).hit;
        EXPECT_EQ(plain.uv, ray.uv);
        EXPECT_EQ(plain.height, ray.zero_level);
        EXPECT_EQ(shaded.uv, plain.uv);
        EXPECT_EQ(shaded.height, plain.height);
    }
    EXPECT_EQ(find_technique("texture_mapping")->shaded_by, ShadedBy::polygon);
    EXPECT_EQ(find_technique("normal_mapping")->shaded_by, ShadedBy::normal_map);
}

}  // namespace
}  // namespace relievo::contract
