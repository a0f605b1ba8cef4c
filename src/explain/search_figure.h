// Searches on one ray as a figure: the vertical section through the field, every step drawn, one search under the other on the
// same axes, each with a close-up of where it ended.
#pragma once

#include "core/height_field.h"
#include "explain/search.h"
#include "figure/drawing.h"

#include <span>
#include <string>

namespace relievo {

struct SearchFigure {
    std::string heading;   // what is looked at
    std::string where;     // which ray; a line under the heading
};

// Wide as a column of text on a large screen; as high as the number of searches asks for.
Drawing search_figure(const Section& section, std::span<const Search> searches, const HeightField& field, const SearchFigure& settings);

// "12 fetches (8 samples, 4 bisections); stops at height 0.613, 0.31 texels behind the first hit": the numbers of a search, in words.
std::string search_sentence(const Search& search);

}  // namespace relievo
