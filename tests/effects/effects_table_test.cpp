// The table of effects: what was published stands beside what is measured, and every difference has its reason.
#include "effects/effects_table.h"
#include "techniques/catalogue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace relievo {
namespace {

const EffectsTable& whole_table() {
    static const EffectsTable table = [] {
        std::vector<const Technique*> all;
        for (const Technique& t : techniques()) all.push_back(&t);
        return effects_table(all, 0);
    }();
    return table;
}

std::size_t index_of_kind(std::string_view id) {
    return static_cast<std::size_t>(std::ranges::find(effect_kinds(), id, &EffectKind::id) - effect_kinds().begin());
}

TEST(EffectsTable, EveryDifferenceHasItsReasonAndEveryReasonItsDifference) {
    std::set<std::pair<std::string_view, std::string_view>> found, explained;
    for (const EffectRow& row : whole_table().rows)
        for (std::size_t k = 0; k < effect_count; ++k)
            if (row.cells[k].differs()) found.insert({row.technique->id, effect_kinds()[k].id});
    for (const EffectDifference& d : known_differences()) {
        EXPECT_TRUE(explained.insert({d.technique, d.effect}).second);
        EXPECT_GT(d.reason.size(), 40u);
    }
    EXPECT_EQ(found, explained);
}

TEST(EffectsTable, HasARowForEveryTechniqueAndForgetsNothingPublished) {
    const EffectsTable& table = whole_table();
    ASSERT_EQ(table.rows.size(), techniques().size());
    for (std::size_t i = 0; i < table.rows.size(); ++i) EXPECT_EQ(table.rows[i].technique, &techniques()[i]);
    std::size_t with_published = 0;
    for (const EffectRow& row : table.rows) with_published += row.cells[0].published ? 1 : 0;
    EXPECT_EQ(with_published + table.not_measured.size(), published_effects().size());
}

// Spot checks of what was copied from the paper.
TEST(EffectsTable, PublishedRowsAreThePapers) {
    EXPECT_EQ(published_effects().size(), 16u);
    int parallax = 0, occlusion = 0, shadow = 0, silhouette = 0;
    for (const PublishedEffects& p : published_effects()) {
        parallax += p.effects.motion_parallax, occlusion += p.effects.self_occlusion;
        shadow += p.effects.self_shadow, silhouette += p.effects.silhouette;
    }
    EXPECT_EQ(parallax, 14);
    EXPECT_EQ(occlusion, 10);
    EXPECT_EQ(shadow, 7);
    EXPECT_EQ(silhouette, 3);
}

// What is known without measuring: a flat polygon shows nothing, an exact search everything but silhouettes.
TEST(EffectsTable, TheTwoEndsOfTheScale) {
    for (const EffectRow& row : whole_table().rows) {
        const auto share = [&](std::string_view id) { return row.cells[index_of_kind(id)].share; };
        if (row.technique->maps.count == 0) {
            for (const EffectCell& cell : row.cells) EXPECT_LE(cell.share, 0.0) << row.technique->id;
        } else if (row.technique->exact) {
            EXPECT_NEAR(share("motion_parallax"), 1, 1e-4) << row.technique->id;
            EXPECT_EQ(share("self_occlusion"), 1) << row.technique->id;
            EXPECT_EQ(share("self_shadow"), 1) << row.technique->id;
        }
    }
}

// Measured and published at odds, as the text shows it.
TEST(EffectsTable, TextMarksWhatDiffers) {
    const Technique* binary = find_technique("binary_search");
    const EffectsTable table = effects_table({&binary, 1}, 1);
    const std::string text = effects_text(table, false);
    EXPECT_NE(text.find("no  0.5"), std::string::npos) << text;
    EXPECT_NE(text.find("# yes"), std::string::npos) << text;
    EXPECT_NE(text.find("binary_search, self_occlusion (published yes"), std::string::npos) << text;
    const std::string page = effects_text(table, true);
    EXPECT_NE(page.find("published yes [1]"), std::string::npos) << page;
    EXPECT_NE(page.find("\n2. binary_search, self_shadow"), std::string::npos) << page;
    const Technique* flat = find_technique("normal_mapping");
    EXPECT_EQ(effects_text(effects_table({&flat, 1}, 1), false).find("Not as published"), std::string::npos);
}

TEST(EffectsTable, DoesNotDependOnThreads) {
    std::vector<const Technique*> all;
    for (const Technique& t : techniques()) all.push_back(&t);
    EXPECT_EQ(effects_text(effects_table(all, 1), true), effects_text(whole_table(), true));
}

}  // namespace
}  // namespace relievo
