#include "assets/map_names.h"

#include <gtest/gtest.h>

#include <cctype>
#include <set>
#include <string>

namespace relievo::test {

TEST(MapNames, FilesOfKnownSites) {
    struct Case {
        const char* stem;
        MapRole role;
        const char* meaning = "";
    };
    using enum MapRole;
    const Case cases[] = {
        // plain
        {"color", colour},
        {"colour", colour},
        {"height", height},
        {"normal", normal},
        {"opacity", ignored},
        // Poly Haven
        {"brick_wall_006_diff_2k", colour},
        {"brick_wall_006_disp_2k", height},
        {"brick_wall_006_nor_gl_2k", normal, "up"},
        {"brick_wall_006_nor_dx_2k", normal, "down"},
        {"brick_wall_006_arm_2k", ignored},
        {"rocks_ground_col_04_col_1k", colour},
        // ambientCG
        {"Rock023_1K_Color", colour},
        {"Rock023_1K_Displacement", height},
        {"Rock023_1K-PNG_NormalGL", normal, "up"},
        {"Rock023_1K-JPG_NormalDX", normal, "down"},
        {"Rock023_1K_Roughness", ignored},
        {"Rock023_1K_AmbientOcclusion", ignored},
        // 3dtextures.me, freepbr, textures.com
        {"Door_Wood_001_basecolor", colour},
        {"Door_Wood_001_ambientOcclusion", ignored},
        {"Door_Wood_001_height", height},
        {"Wood_plank_COLOR", colour},
        {"Wood_plank_DISP", height},
        {"Wood_plank_NORM", normal},
        {"rustediron2_normal", normal},
        {"Brick_Normal-ogl", normal, "up"},
        {"metal-plate_Height2", height},
        {"TexturesCom_Brick_albedo", colour},
        // games
        {"castell_wall_gk_v01_cc", colour},
        {"castell_wall_gk_v01_hm", height},
        {"castell_wall_gk_v01_nm", normal},
        {"layingrock-c", colour},
        {"layingrock-h", height},
        {"layingrock-n", normal},
        {"parallax-d", colour},
        {"logo_H", height},
        {"lion_bump", height},
        {"lion_ddn", normal},
        {"wool_depth", height, "depth"},
        {"rock023_nrm_rgh", normal},
        {"rock023_alb_ht", colour},
        {"wall_local_h", height},
        {"wall_s", ignored},
        // joined, with other endings after them
        {"bricks_height_map", height},
        {"bricks_normal_map", normal},
        {"bumpMap", height},
        {"BaseColor", colour},
        {"bricks_normal_tex", normal},
        {"rough_wood_disp_4k", height},
        {"metal_grid_nrm", normal},
        {"normal_road_height", height},
        {"depth.v2", height, "depth"},
    };
    for (const Case& c : cases) {
        const MapName* name = find_map_name(c.stem);
        ASSERT_NE(name, nullptr) << c.stem;
        EXPECT_EQ(name->role, c.role) << c.stem;
        EXPECT_EQ(name->meaning, c.meaning) << c.stem;
    }
    for (const char* stem : {"", "photo", "n", "h", "c_wall", "12", "___", "hn", "texture"})
        EXPECT_EQ(find_map_name(stem), nullptr) << stem;
}

TEST(MapNames, EveryWordIsFoundInEverySpelling) {
    std::set<std::string_view> seen;
    for (const MapName& entry : map_names()) {
        EXPECT_TRUE(seen.insert(entry.word).second) << entry.word << " stands twice";
        std::string upper(entry.word);
        for (char& c : upper) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        for (const std::string& stem : {"rock_" + std::string(entry.word), "Rock-" + upper, "rock." + std::string(entry.word)})
            EXPECT_EQ(find_map_name(stem), &entry) << stem;
        if (entry.word.size() == 1) continue;
        EXPECT_EQ(find_map_name(entry.word), &entry) << entry.word;
        EXPECT_EQ(find_map_name("rock_" + std::string(entry.word) + "_2k"), &entry) << entry.word;
    }
}

}  // namespace relievo::test
