// The eight tests of a published comparison, with its step counts and its frames per second: G. Nobrega de Lima, "Mapeamento de
// Geometrias a partir de Texturas em Tempo Real", Universidade Federal do ABC, 2011, chapter 4 (GeForce GTX 275, Render Monkey).
#pragma once

#include "techniques/technique.h"

#include <span>
#include <string_view>

namespace relievo {

// One technique in one test.
struct PublishedRun {
    std::string_view technique;     // id in the catalogue
    Few<KnobDefault, 2> knobs;      // as published; none: it has none, or none are given
    double frames_per_second = 0;   // tables 4.2 and 4.3
};

// One quad, one relief, one view. Its colour, height and normal maps are named by their sizes only, and its views by words; the scene
// and the view that stand in for them here are ours.
struct PublishedTest {
    std::string_view id;
    std::string_view scene;  // id in the table of scenes
    std::string_view view;   // id in the table of views
    int colour_texels = 0;
    int height_texels = 0;   // of heights and normals
    Few<PublishedRun, 8> runs;  // the first is what the others' frame rates are set against
};

std::span<const PublishedTest> published_tests();
const PublishedTest* find_published_test(std::string_view id);

// Table 4.4, best first; equal places share a number. It was drawn up by eye: quality before frames per second.
struct PublishedPlace {
    std::string_view technique;
    int place;
};
std::span<const PublishedPlace> published_ranking();
inline constexpr std::string_view published_tests_source = "Nobrega de Lima 2011, chapter 4, GeForce GTX 275";

}  // namespace relievo
