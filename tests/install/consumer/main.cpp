// Casts one slanted ray at a flat field at height 1/4 with an installed technique and with the installed reference: both must
// meet it at 1/4 of the way up.
#include <cmath>
#include <cstdio>

#include "reference/cast.h"
#include "techniques/catalogue.h"

int main() {
    relievo::MapSet maps;
    maps.height = relievo::HeightField(8, 8, 0.25f);
    relievo::glsl::bound_maps = {.maps = &maps, .readable = relievo::MapFlags().set()};
    relievo::glsl::SurfaceRay ray{};
    ray.uv = {0.5f, 0.5f};
    ray.uv_per_height = {0.1f, 0.0f};
    ray.view = {0.7071f, 0.0f, 0.7071f};
    ray.zero_level = 1;
    ray.z_start = 1;
    const relievo::Technique* technique = relievo::find_technique("relief_mapping");
    const auto hit = technique->heightfield(ray, relievo::default_params(*technique));
    const auto truth = relievo::reference_cast(maps.height, {.uv = {0.5, 0.5}, .uv_per_height = {0.1, 0.0}});
    std::printf("relief mapping %.4f, reference %.4f\n", static_cast<double>(hit.height), truth.height);
    return hit.found && std::abs(hit.height - 0.25f) < 1e-3f && std::abs(truth.height - 0.25) < 1e-12 ? 0 : 1;
}
