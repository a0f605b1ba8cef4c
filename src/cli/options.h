// Words of the command line turned into entries of the tables; a misspelt one is a UsageError with a suggestion.
#pragma once

#include "scenes/view.h"
#include "techniques/modifiers.h"

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace relievo {

struct Size {
    int width;
    int height;
};

Size parse_size(const std::string& text);                                        // "640x360", each side 1 to 16384
std::vector<View> parse_views(const std::vector<std::string>& texts);            // names or degrees, commas allowed, each once
void require_front(const std::vector<View>& views, const char* verb);             // UsageError where one looks from behind
std::vector<const Technique*> parse_techniques(const std::vector<std::string>& texts);  // ids, commas allowed, each once
// `also`: other words that the option takes, for the suggestion.
const Technique& parse_technique(const std::string& id, const std::vector<std::string>& also = {});
// "knob=value" settings over the technique's defaults; an undeclared knob or a value out of range is an error that says the range.
MarchParams parse_knobs(const Technique& technique, const std::vector<std::string>& settings);

// An option for each modifier (--shadow) and each number (--light-radius), which write into `options`.
void add_modifier_options(CLI::App& verb, DrawOptions& options);

}  // namespace relievo
