// "Did you mean": the known word nearest to a misspelt one.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace relievo {

// The candidate with the smallest edit distance (Levenshtein 1966), if it is at most a third of the word's length (at least 2);
// empty otherwise.
std::string nearest_word(std::string_view word, std::span<const std::string> candidates);

// "unknown <kind> '<word>'", with the nearest candidate if one is near, else all of them.
std::string unknown_word(std::string_view kind, std::string_view word, std::span<const std::string> candidates);

}  // namespace relievo
