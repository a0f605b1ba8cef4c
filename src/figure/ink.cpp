#include "figure/ink.h"

#include <array>

namespace relievo {

namespace {

// Hues after Okabe and Ito (Color Universal Design, 2008), told apart by every kind of colour vision; lighter ones on dark paper, so
// that each stands out against its paper by at least 3 : 1 where it carries meaning.
constexpr std::array<InkColour, ink_count> table{{
    {"paper", {255, 255, 255}, {22, 24, 29}},
    {"text", {31, 35, 40}, {230, 232, 235}},
    {"muted", {91, 99, 110}, {160, 170, 181}},
    {"grid", {222, 226, 231}, {52, 58, 66}},
    {"ground", {214, 204, 188}, {66, 60, 51}},
    {"surface", {94, 82, 66}, {201, 189, 166}},
    {"ray", {31, 35, 40}, {230, 232, 235}},
    {"above", {0, 100, 165}, {96, 184, 242}},
    {"below", {200, 84, 0}, {255, 146, 72}},
    {"cone", {0, 140, 104}, {64, 208, 164}},
    {"node", {86, 130, 190}, {120, 160, 214}},
    {"opened", {150, 108, 20}, {222, 178, 86}},
    {"cell", {176, 58, 140}, {236, 140, 206}},
    {"secant", {134, 58, 170}, {205, 150, 240}},
    {"sphere", {0, 140, 104}, {64, 208, 164}},
    {"normal", {94, 82, 66}, {201, 189, 166}},
    {"found", {196, 20, 84}, {255, 116, 160}},
    {"truth", {31, 35, 40}, {230, 232, 235}},
}};
static_assert(static_cast<int>(Ink::truth) + 1 == ink_count, "one row an ink, in the order of enum Ink");

}  // namespace

const InkColour& ink_colour(Ink ink) { return table[static_cast<std::size_t>(ink)]; }

}  // namespace relievo
