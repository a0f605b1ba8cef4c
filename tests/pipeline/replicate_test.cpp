// The published tests as a table, and the ranking computed from measurements.
#include "pipeline/replicate.h"
#include "scenes/scene.h"
#include "scenes/view.h"
#include "techniques/catalogue.h"
#include "textures/procedural.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

namespace relievo {
namespace {

TEST(PublishedTests, NameWhatExists) {
    ASSERT_EQ(published_tests().size(), 8u);
    double fps = 0;
    for (const PublishedTest& test : published_tests()) {
        SCOPED_TRACE(test.id);
        EXPECT_EQ(find_published_test(test.id), &test);
        EXPECT_NE(find_scene(test.scene), nullptr);
        EXPECT_NE(find_procedural_material(test.scene), nullptr);
        EXPECT_TRUE(parse_view(test.view).has_value());
        std::set<std::string_view> seen;
        for (const PublishedRun& run : test.runs) {
            EXPECT_TRUE(seen.insert(run.technique).second) << run.technique;
            const Technique* technique = find_technique(run.technique);
            ASSERT_NE(technique, nullptr) << run.technique;
            for (const KnobDefault& k : run.knobs) {
                EXPECT_TRUE(std::ranges::any_of(technique->knobs, [&](const KnobDefault& d) { return d.knob == k.knob; })) << run.technique << " " << k.knob->id;
                EXPECT_GE(k.value, k.knob->min);
                EXPECT_LE(k.value, k.knob->max);
            }
            fps += run.frames_per_second;
        }
    }
    // Sums over tables 4.2 and 4.3, a sum per printed column.
    EXPECT_EQ(fps, 20082 + 18341 + 20244 + 16994 + 16548 + 12263 + 4384 + 4900);
    for (const PublishedPlace& p : published_ranking()) EXPECT_NE(find_technique(p.technique), nullptr) << p.technique;
    EXPECT_EQ(find_published_test("test_9"), nullptr);
}

std::vector<int> places_of(const std::vector<Ranked>& list, const std::vector<const Technique*>& order) {
    std::vector<int> places;
    for (const Technique* t : order) places.push_back(std::ranges::find(list, t, &Ranked::technique)->place);
    return places;
}

TEST(Ranking, ErrorFirstTimeSecond) {
    std::vector<const Technique*> t;
    for (const Technique& one : techniques()) t.push_back(&one);
    ASSERT_GE(t.size(), 5u);
    const auto entry = [&](std::size_t i, double wrong, double time) { return Ranked{.technique = t[i], .wrong = wrong, .time_ratio = time}; };
    // 0.10 and 0.12 are within a quarter: the faster is before. 0.20 is not, however fast. 0 and 0.0009 differ by nothing that counts.
    const auto list = ranked({entry(0, 0.10, 3), entry(1, 0.12, 2), entry(2, 0.20, 1), entry(3, 0, 9), entry(4, 0.0009, 8)});
    EXPECT_EQ(places_of(list, {t[0], t[1], t[2], t[3], t[4]}), (std::vector<int>{4, 3, 5, 2, 1}));
    EXPECT_EQ(list[0].error_class, 1);
    EXPECT_EQ(list[1].error_class, 1);
    EXPECT_EQ(list[2].error_class, 2);
    EXPECT_EQ(list[4].error_class, 3);
    // The order in which they come does not matter.
    const auto turned = ranked({entry(4, 0.0009, 8), entry(2, 0.20, 1), entry(1, 0.12, 2), entry(3, 0, 9), entry(0, 0.10, 3)});
    for (std::size_t i = 0; i < list.size(); ++i) EXPECT_EQ(turned[i].technique, list[i].technique);
    EXPECT_TRUE(ranked({}).empty());
}

}  // namespace
}  // namespace relievo
