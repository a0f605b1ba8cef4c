#include "scenes/published_tests.h"

#include <algorithm>

namespace relievo {

namespace {

using namespace knob;

// Reliefs: tests 1, 2 and 8 share one, 3 and 4 another, 5 to 7 a third of 1024 texels. Views: large angles between ray and surface in
// 1, 3 and 5, middle ones in 2, 4 and 6, small ones in 7 and 8.
constexpr PublishedTest table[] = {
    {.id = "test_1", .scene = "bricks", .view = "steep", .colour_texels = 512, .height_texels = 256,
     .runs = {{"normal_mapping", {}, 2890}, {"parallax_mapping", {}, 2888}, {"parallax_offset_limiting", {}, 2884}, {"parallax_iterative", {{iterations, 4}}, 2900},
              {"linear_search", {{max_steps, 80}}, 1220}, {"relief_mapping", {{max_steps, 40}, {refine_steps, 10}}, 2000},
              {"parallax_occlusion_mapping", {{max_steps, 60}, {min_steps, 30}}, 2600}, {"cone_step_mapping", {{max_steps, 20}}, 2700}}},
    {.id = "test_2", .scene = "bricks", .view = "middle", .colour_texels = 512, .height_texels = 256,
     .runs = {{"normal_mapping", {}, 2893}, {"parallax_mapping", {}, 2680}, {"parallax_offset_limiting", {}, 2680}, {"parallax_iterative", {{iterations, 4}}, 2600},
              {"linear_search", {{max_steps, 90}}, 700}, {"relief_mapping", {{max_steps, 20}, {refine_steps, 6}}, 2238},
              {"parallax_occlusion_mapping", {{max_steps, 60}, {min_steps, 30}}, 2200}, {"cone_step_mapping", {{max_steps, 20}}, 2350}}},
    {.id = "test_3", .scene = "cobbles", .view = "steep", .colour_texels = 512, .height_texels = 256,
     .runs = {{"normal_mapping", {}, 2890}, {"parallax_mapping", {}, 2800}, {"parallax_offset_limiting", {}, 2804}, {"parallax_iterative", {{iterations, 6}}, 2790},
              {"linear_search", {{max_steps, 70}}, 1558}, {"relief_mapping", {{max_steps, 30}, {refine_steps, 5}}, 2516},
              {"parallax_occlusion_mapping", {{max_steps, 60}, {min_steps, 30}}, 2306}, {"cone_step_mapping", {{max_steps, 12}}, 2580}}},
    {.id = "test_4", .scene = "cobbles", .view = "middle", .colour_texels = 512, .height_texels = 256,
     .runs = {{"normal_mapping", {}, 2850}, {"parallax_mapping", {}, 2525}, {"parallax_offset_limiting", {}, 2538}, {"parallax_iterative", {{iterations, 6}}, 2522},
              {"linear_search", {{max_steps, 70}}, 1031}, {"relief_mapping", {{max_steps, 30}, {refine_steps, 5}}, 1850},
              {"parallax_occlusion_mapping", {{max_steps, 80}, {min_steps, 30}}, 1378}, {"cone_step_mapping", {{max_steps, 12}}, 2300}}},
    {.id = "test_5", .scene = "engraving", .view = "steep", .colour_texels = 1024, .height_texels = 1024,
     .runs = {{"normal_mapping", {}, 2540}, {"parallax_mapping", {}, 2510}, {"parallax_offset_limiting", {}, 2500}, {"parallax_iterative", {{iterations, 6}}, 2130},
              {"linear_search", {{max_steps, 60}}, 812}, {"relief_mapping", {{max_steps, 15}, {refine_steps, 6}}, 1839},
              {"parallax_occlusion_mapping", {{max_steps, 40}, {min_steps, 30}}, 1700}, {"cone_step_mapping", {{max_steps, 10}}, 2517}}},
    {.id = "test_6", .scene = "engraving", .view = "middle", .colour_texels = 1024, .height_texels = 1024,
     .runs = {{"normal_mapping", {}, 2550}, {"parallax_mapping", {}, 2543}, {"parallax_offset_limiting", {}, 2530}, {"parallax_iterative", {{iterations, 6}}, 1163},
              {"linear_search", {{max_steps, 64}}, 477}, {"relief_mapping", {{max_steps, 26}, {refine_steps, 6}}, 800},
              {"parallax_occlusion_mapping", {{max_steps, 60}, {min_steps, 10}}, 1000}, {"cone_step_mapping", {{max_steps, 20}}, 1200}}},
    {.id = "test_7", .scene = "engraving", .view = "grazing", .colour_texels = 1024, .height_texels = 1024,
     .runs = {{"parallax_iterative", {{iterations, 6}}, 2134}, {"relief_mapping", {{max_steps, 40}, {refine_steps, 6}}, 775},
              {"parallax_occlusion_mapping", {{max_steps, 200}, {min_steps, 50}}, 355}, {"cone_step_mapping", {{max_steps, 20}}, 1120}}},
    {.id = "test_8", .scene = "bricks", .view = "grazing", .colour_texels = 512, .height_texels = 256,
     .runs = {{"parallax_iterative", {{iterations, 6}}, 2305}, {"relief_mapping", {{max_steps, 40}, {refine_steps, 6}}, 688},
              {"parallax_occlusion_mapping", {{max_steps, 200}, {min_steps, 50}}, 507}, {"cone_step_mapping", {{max_steps, 20}}, 1400}}},
};

constexpr PublishedPlace ranking[] = {
    {"cone_step_mapping", 1}, {"parallax_occlusion_mapping", 2}, {"relief_mapping", 2},   {"parallax_iterative", 3},
    {"linear_search", 4},     {"parallax_offset_limiting", 5},   {"parallax_mapping", 6}, {"normal_mapping", 7},
};

}  // namespace

std::span<const PublishedTest> published_tests() { return table; }

const PublishedTest* find_published_test(std::string_view id) {
    const auto it = std::ranges::find(table, id, &PublishedTest::id);
    return it == std::end(table) ? nullptr : it;
}

std::span<const PublishedPlace> published_ranking() { return ranking; }

}  // namespace relievo
