// What the catalogue and the table of knobs say, put into words for captions and sentences.
#pragma once

#include "report/results.h"

#include <string>
#include <string_view>

namespace relievo {

struct Technique;

// The technique's title, or its id where the catalogue does not know it (results of another version).
std::string technique_title(std::string_view id);

// "30 steps, 6 refinements"; empty without knobs.
std::string setting_text(const KnobValues& values);

// The text with its first letter small, to stand inside a sentence.
std::string inside_sentence(std::string text);

// "river_cobbles" -> "river cobbles": names of materials are mostly names of folders.
std::string readable_name(std::string name);

// Two significant digits, with "0.0004", never "4e-04".
std::string short_number(double value);

// A share in [0,1] as "4.1 %", with a space at which no line breaks.
std::string percent(double share);

// What the row of the catalogue promises of where a hit lies, at its default knobs, and of how many hits: two sentences.
std::string promise_text(const Technique& technique);

}  // namespace relievo
