// What every procedural material promises, whatever it shows.
#include "core/error.h"
#include "textures/procedural.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace relievo {
namespace {

class EachMaterial : public testing::TestWithParam<ProceduralMaterial> {};

}  // namespace
void PrintTo(const ProceduralMaterial& material, std::ostream* out) { *out << material.id; }
namespace {

TEST_P(EachMaterial, is_the_same_for_any_number_of_threads_and_another_for_another_seed) {
    const Material one = procedural_material(GetParam().id, 64, 7, 1);
    const Material two = procedural_material(GetParam().id, 64, 7, 2);
    EXPECT_EQ(one.height.texels.texels, two.height.texels.texels);
    EXPECT_EQ(one.colour->texels, two.colour->texels);
    const Material other = procedural_material(GetParam().id, 64, 8, 2);
    EXPECT_NE(one.height.texels.texels, other.height.texels.texels);
    EXPECT_NE(one.colour->texels, other.colour->texels);
}

TEST_P(EachMaterial, has_heights_of_16_bits_that_fill_the_range) {
    const Material m = procedural_material(GetParam().id, 512, 1, 2);
    float low = 1;
    float high = 0;
    for (const float h : m.height.texels.texels) {
        ASSERT_EQ(h, std::round(h * 65535) / 65535);
        low = std::min(low, h);
        high = std::max(high, h);
    }
    EXPECT_EQ(low, 0);
    EXPECT_EQ(high, 1);
}

TEST_P(EachMaterial, comes_in_any_size) {
    for (const int size : {1, 7, 64, 630}) {
        const Material m = procedural_material(GetParam().id, size, 3, 2);
        EXPECT_EQ(m.height.width(), size);
        EXPECT_EQ(m.height.height(), size);
        ASSERT_TRUE(m.colour);
        EXPECT_EQ(m.colour->width, size);
        EXPECT_EQ(m.colour->channels, 4);
        EXPECT_FALSE(m.normal);
        for (const float h : m.height.texels.texels) ASSERT_TRUE(h >= 0 && h <= 1);
    }
}

INSTANTIATE_TEST_SUITE_P(textures, EachMaterial, testing::ValuesIn(procedural_materials().begin(), procedural_materials().end()),
                         [](const auto& material) { return std::string(material.param.id); });

TEST(procedural_material, names_the_nearest_one_when_it_does_not_know_the_id) {
    try {
        procedural_material("cobles", 16, 1, 1);
        FAIL();
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("did you mean 'cobbles'"), std::string::npos) << e.what();
    }
    EXPECT_THROW(procedural_material("", 16, 1, 1), Error);
    EXPECT_EQ(find_procedural_material("marble"), nullptr);
    EXPECT_EQ(find_procedural_material("dunes")->title, "Dunes");
}

TEST(procedural_material, refuses_sizes_that_no_map_has) {
    for (const int size : {0, -1, 16385}) EXPECT_THROW(procedural_material("bricks", size, 1, 1), Error) << size;
}

}  // namespace
}  // namespace relievo
