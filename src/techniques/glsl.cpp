#include "techniques/glsl.h"

#include "core/wrap.h"

#include <stdexcept>

namespace relievo::glsl {

thread_local BoundMaps bound_maps;
thread_local int fetch_count = 0;
thread_local std::vector<Fetch>* fetch_log = nullptr;

namespace {

// The maps, if the technique may use this one.
const MapSet& declared(Map map, const char* name) {
    if (!bound_maps.readable[index_of(map)])
        throw std::logic_error(std::string("technique reads the ") + name + " map, which its catalogue entry does not declare");
    return *bound_maps.maps;
}

// The same for one fetch.
const MapSet& fetched(Map map, const char* name) {
    const MapSet& maps = declared(map, name);
    ++fetch_count;
    if (fetch_log != nullptr) fetch_log->push_back({.map = map});
    return maps;
}

// Completes the note of the fetch just made: where it was, what was read.
void note_point(vec2 uv, vec4 value) {
    if (fetch_log == nullptr) return;
    fetch_log->back() = {.map = fetch_log->back().map, .place = Fetch::Place::point, .uv = uv, .value = value};
}
void note_node(Fetch::Place place, ivec2 index, int level, vec4 value) {
    if (fetch_log == nullptr) return;
    fetch_log->back() = {.map = fetch_log->back().map, .place = place, .index = index, .level = level, .value = value};
}

// The sampler's rule: bilinear between texel centres, repeat.
void sample_bilinear(const ImageF& image, vec2 uv, float* out) {
    const float x = uv.x * static_cast<float>(image.width) - 0.5f;
    const float y = uv.y * static_cast<float>(image.height) - 0.5f;
    const float x0 = std::floor(x);
    const float y0 = std::floor(y);
    const float fx = x - x0;
    const float fy = y - y0;
    const int i0 = wrap_index(static_cast<int>(x0), image.width);
    const int j0 = wrap_index(static_cast<int>(y0), image.height);
    const int i1 = i0 + 1 == image.width ? 0 : i0 + 1;
    const int j1 = j0 + 1 == image.height ? 0 : j0 + 1;
    for (int c = 0; c < image.channels; ++c) {
        const float low = image(i0, j0, c) + fx * (image(i1, j0, c) - image(i0, j0, c));
        const float high = image(i0, j1, c) + fx * (image(i1, j1, c) - image(i0, j1, c));
        out[c] = low + fy * (high - low);
    }
}

vec2 sampled_pair(const ImageF& image, vec2 uv) {
    float out[2];
    sample_bilinear(image, uv, out);
    note_point(uv, {out[0], out[1], 0, 0});
    return {out[0], out[1]};
}

vec2 texel_pair(const ImageF& image, ivec2 texel) {
    const float* pair = image.at(wrap_index(texel.x, image.width), wrap_index(texel.y, image.height));
    const vec2 size(static_cast<float>(image.width), static_cast<float>(image.height));
    note_point((vec2(texel) + vec2(0.5f)) / size, {pair[0], pair[1], 0, 0});
    return {pair[0], pair[1]};
}

}  // namespace

ivec2 height_size() { return {bound_maps.maps->height.width(), bound_maps.maps->height.height()}; }

float height_at(vec2 uv) {
    float h = 0;
    sample_bilinear(fetched(Map::height, "height").height.texels, uv, &h);
    note_point(uv, {h, 0, 0, 0});
    return h;
}

vec4 height_cell(vec2 middle) {
    const HeightField& field = fetched(Map::height, "height").height;
    const ivec2 cell{wrap_index(static_cast<int>(std::floor(middle.x * static_cast<float>(field.width()) - 0.5f)), field.width()),
                     wrap_index(static_cast<int>(std::floor(middle.y * static_cast<float>(field.height()) - 0.5f)), field.height())};
    const auto c = field.cell(cell.x, cell.y);
    note_node(Fetch::Place::cell, cell, 0, {c[0], c[1], c[2], c[3]});
    return {c[0], c[1], c[2], c[3]};
}

vec3 normal_at(vec2 uv, float lod) {
    const auto& chain = fetched(Map::normal, "normal").normal;
    const float size = static_cast<float>(std::max(chain[0].width, chain[0].height));
    const float level = clamp(lod + std::log2(size), 0.0f, static_cast<float>(chain.size() - 1));
    const auto fine = static_cast<std::size_t>(level);
    const auto coarse = std::min(fine + 1, chain.size() - 1);
    float a[3];
    float b[3];
    sample_bilinear(chain[fine], uv, a);
    sample_bilinear(chain[coarse], uv, b);
    const vec3 normal = normalize(mix(vec3(a[0], a[1], a[2]), vec3(b[0], b[1], b[2]), level - static_cast<float>(fine)));
    note_point(uv, {normal, 0});
    return normal;
}

vec2 cone_at(vec2 uv) { return sampled_pair(fetched(Map::cone, "cone").cone, uv); }

vec2 conservative_cone_at(vec2 uv) { return sampled_pair(fetched(Map::conservative_cone, "conservative_cone").conservative_cone, uv); }

vec2 relaxed_cone_at(vec2 uv) { return sampled_pair(fetched(Map::relaxed_cone, "relaxed_cone").relaxed_cone, uv); }

vec2 conservative_cone(ivec2 texel) { return texel_pair(fetched(Map::conservative_cone, "conservative_cone").conservative_cone, texel); }

vec2 relaxed_cone(ivec2 texel) { return texel_pair(fetched(Map::relaxed_cone, "relaxed_cone").relaxed_cone, texel); }

vec2 robust_cone(ivec2 texel) { return texel_pair(fetched(Map::robust_cone, "robust_cone").robust_cone, texel); }

float horizon_at(vec2 uv, int direction) {
    const ImageF& map = fetched(Map::horizon, "horizon").horizon;
    const float x = uv.x * static_cast<float>(map.width) - 0.5f;
    const float y = uv.y * static_cast<float>(map.height) - 0.5f;
    const float fx = x - std::floor(x);
    const float fy = y - std::floor(y);
    const int i0 = wrap_index(static_cast<int>(std::floor(x)), map.width);
    const int j0 = wrap_index(static_cast<int>(std::floor(y)), map.height);
    const int i1 = i0 + 1 == map.width ? 0 : i0 + 1;
    const int j1 = j0 + 1 == map.height ? 0 : j0 + 1;
    const float horizon = mix(mix(map(i0, j0, direction), map(i1, j0, direction), fx), mix(map(i0, j1, direction), map(i1, j1, direction), fx), fy);
    note_point(uv, {horizon, 0, 0, 0});
    return horizon;
}

float distance_at(vec3 uvz) {
    const ImageF& map = fetched(Map::distance, "distance").distance;
    const int rows = map.height / distance_slices;
    const float z = clamp(uvz.z, 0.0f, 1.0f) * static_cast<float>(distance_slices - 1);
    const int below = std::min(static_cast<int>(z), distance_slices - 2);
    const float x = uvz.x * static_cast<float>(map.width) - 0.5f;
    const float y = uvz.y * static_cast<float>(rows) - 0.5f;
    const int i0 = wrap_index(static_cast<int>(std::floor(x)), map.width);
    const int j0 = wrap_index(static_cast<int>(std::floor(y)), rows);
    const int i1 = i0 + 1 == map.width ? 0 : i0 + 1;
    const int j1 = j0 + 1 == rows ? 0 : j0 + 1;
    const auto slice = [&](int k) {
        const float low = mix(map(i0, k * rows + j0), map(i1, k * rows + j0), x - std::floor(x));
        const float high = mix(map(i0, k * rows + j1), map(i1, k * rows + j1), x - std::floor(x));
        return mix(low, high, y - std::floor(y));
    };
    const float distance = mix(slice(below), slice(below + 1), z - static_cast<float>(below));
    if (fetch_log != nullptr)
        fetch_log->back() = {.map = Map::distance, .place = Fetch::Place::volume, .uv = {uvz.x, uvz.y}, .height = uvz.z, .value = {distance, 0, 0, 0}};
    return distance;
}

int max_levels() { return static_cast<int>(declared(Map::max_pyramid, "max_pyramid").max_pyramid.levels.size()); }

float max_at(ivec2 node, int level) {
    const float top = fetched(Map::max_pyramid, "max_pyramid").max_pyramid.levels[static_cast<std::size_t>(level)](node.x, node.y);
    note_node(Fetch::Place::node, node, level, {top, 0, 0, 0});
    return top;
}

vec4 cell_cone(vec2 corner, int quadrant) {
    const MapSet& maps = fetched(Map::cell_cone, "cell_cone");
    const int width = maps.height.width();
    const int height = maps.height.height();
    const ivec2 wrapped{wrap_index(static_cast<int>(std::floor(corner.x * static_cast<float>(width))), width),
                        wrap_index(static_cast<int>(std::floor(corner.y * static_cast<float>(height))), height)};
    const float* t = maps.cell_cone.at(wrapped.x, quadrant * height + wrapped.y);
    const vec4 over{t[0], t[1], t[2], t[3]};
    note_node(Fetch::Place::node, wrapped, 0, over);
    return over;
}

#include "surface/maps.glsl"  // for its constants: the declarations in it are not for C++
static_assert(horizon_directions == relievo::horizon_directions, "the shadow looks up what the map was baked for");
static_assert(near_roof_reach == relievo::near_roof_reach && middle_roof_reach == relievo::middle_roof_reach && far_roof_reach == relievo::far_roof_reach,
              "the walk goes as far as the map was baked for");

}  // namespace relievo::glsl
