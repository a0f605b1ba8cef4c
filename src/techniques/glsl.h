// The part of GLSL our technique files use, in C++: included around a shader file, it makes the CPU run the very function the
// GPU runs. Maps are bound per thread; every accessor counts one fetch, as on the GPU.
#pragma once

#include "core/map_set.h"
#include "core/vec.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace relievo::glsl {

using vec2 = relievo::Vec2<float>;
using vec3 = relievo::Vec3<float>;
using vec4 = relievo::Vec4<float>;
using ivec2 = relievo::Vec2<int>;

using relievo::cross;
using relievo::dot;
using relievo::length;
using relievo::normalize;

inline float abs(float x) { return std::fabs(x); }
inline float floor(float x) { return std::floor(x); }
inline float sqrt(float x) { return std::sqrt(x); }
inline float exp2(float x) { return std::exp2(x); }
inline float log2(float x) { return std::log2(x); }
inline float sin(float x) { return std::sin(x); }
inline float cos(float x) { return std::cos(x); }
inline float tan(float x) { return std::tan(x); }
inline float asin(float x) { return std::asin(x); }
inline float atan(float x) { return std::atan(x); }
inline float pow(float x, float y) { return std::pow(x, y); }
inline float fract(float x) { return x - std::floor(x); }
inline float min(float a, float b) { return b < a ? b : a; }
inline float max(float a, float b) { return a < b ? b : a; }
inline int min(int a, int b) { return b < a ? b : a; }
inline int max(int a, int b) { return a < b ? b : a; }
inline float clamp(float x, float low, float high) { return min(max(x, low), high); }
inline int clamp(int x, int low, int high) { return min(max(x, low), high); }
inline float mix(float a, float b, float t) { return a * (1.0f - t) + b * t; }
inline vec2 floor(vec2 v) { return {std::floor(v.x), std::floor(v.y)}; }
inline vec3 mix(vec3 a, vec3 b, float t) { return a * (1.0f - t) + b * t; }

#include "shared/draw_options.h"
#include "shared/heightfield.h"
#include "shared/march_params.h"
#include "shared/shaded_by.h"
#include "shared/shells.h"

// The maps the calling thread reads, and which of them the technique declared: reading another throws std::logic_error, which
// fails the contract test that tried.
struct BoundMaps {
    const MapSet* maps = nullptr;
    MapFlags readable;
};

// One fetch as it was made, for those who want to see a search at work (src/explain). Every accessor says where it read and what.
struct Fetch {
    enum class Place { unnamed, point, cell, node, volume };
    Map map{};
    Place place = Place::unnamed;
    vec2 uv{};         // point and volume: the texture coordinate, not wrapped
    float height = 0;  // volume: the height
    ivec2 index{};     // cell and node: inside one period
    int level = 0;     // node: 2^level cells along an edge
    vec4 value{};      // what was read, in the order of the accessor's result
};

extern thread_local BoundMaps bound_maps;
extern thread_local int fetch_count;
extern thread_local std::vector<Fetch>* fetch_log;  // where the calling thread's fetches are noted; null: nowhere

ivec2 height_size();
float height_at(vec2 uv);
vec4 height_cell(vec2 middle);
vec3 normal_at(vec2 uv, float lod);
vec2 cone_at(vec2 uv);
vec2 conservative_cone_at(vec2 uv);
vec2 relaxed_cone_at(vec2 uv);
vec2 conservative_cone(ivec2 texel);
vec2 relaxed_cone(ivec2 texel);
vec2 robust_cone(ivec2 texel);
float horizon_at(vec2 uv, int direction);
float distance_at(vec3 uvz);
int max_levels();
float max_at(ivec2 node, int level);
vec4 cell_cone(vec2 corner, int quadrant);

}  // namespace relievo::glsl
