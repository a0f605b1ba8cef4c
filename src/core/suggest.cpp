#include "core/suggest.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace relievo {

namespace {

std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = std::exchange(row[0], i);
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = std::exchange(row[j], std::min({replaced, row[j] + 1, row[j - 1] + 1}));
        }
    }
    return row.back();
}

}  // namespace

std::string nearest_word(std::string_view word, std::span<const std::string> candidates) {
    std::string best;
    std::size_t best_distance = std::max<std::size_t>(2, word.size() / 3) + 1;
    for (const std::string& c : candidates) {
        // A beginning of a long id is a likely slip too: "relief" for "relief_mapping".
        const std::size_t d = word.size() >= 3 && c.starts_with(word) ? 1 : edit_distance(word, c);
        if (d < best_distance) {
            best_distance = d;
            best = c;
        }
    }
    return best;
}

std::string unknown_word(std::string_view kind, std::string_view word, std::span<const std::string> candidates) {
    std::string text = "unknown " + std::string(kind) + " '" + std::string(word) + "'";
    if (const std::string near = nearest_word(word, candidates); !near.empty()) return text + "; did you mean '" + near + "'?";
    text += "; known are:";
    for (const std::string& c : candidates) text += " " + c;
    return text;
}

}  // namespace relievo
