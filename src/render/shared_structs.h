// The structs both sides compile (shaders/shared), with the proof that both lay them out alike: scalars of four bytes, no holes.
#pragma once

#include "techniques/glsl.h"

#include <cstddef>

namespace relievo::glsl {

#include "shared/cast.h"
#include "shared/scene.h"

static_assert(sizeof(SceneUniforms) == 28 * 4 && offsetof(SceneUniforms, scale_x) == 12 * 4 &&
              offsetof(SceneUniforms, ambient_r) == 18 * 4);
static_assert(sizeof(SceneUniforms) % 16 == 0, "uniform buffers are sized in steps of 16 bytes");
static_assert(sizeof(LightUniforms) == 12 * 4 && offsetof(LightUniforms, r) == 4 * 4);
static_assert(sizeof(ReliefUniforms) == 3 * 4);
static_assert(sizeof(MarchParams) == 6 * 4 && offsetof(MarchParams, tolerance) == 5 * 4);
static_assert(sizeof(CastRay) == 12 * 4 && offsetof(CastRay, lod) == 11 * 4);
static_assert(sizeof(CastHit) == 5 * 4 && offsetof(CastHit, fetches) == 4 * 4);

}  // namespace relievo::glsl
