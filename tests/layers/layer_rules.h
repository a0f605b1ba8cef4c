// Reads the table of layers from docs/architecture.md and says what in a source tree breaks it.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace relievo::layers {

struct Rule {
    std::set<std::string> may_include;  // folders of src; "shaders/" is a member where the table says so
    std::set<std::string> libraries;    // first part of an angle-bracket path, or its name without .h
};

using Rules = std::map<std::string, Rule>;

// The rows below the heading "| folder | may include | ...": cells are comma-separated, a row may name several folders.
Rules read_table(const std::string& markdown);

// What each relievo_stage(name USES a b THIRD_PARTY ...) line links.
std::map<std::string, std::set<std::string>> read_stages(const std::string& cmake);

// One sentence per include below `src` that the rules do not allow, and per folder without a rule.
std::vector<std::string> broken_includes(const Rules& rules, const std::filesystem::path& src);

// One sentence per stage whose links differ from its row.
std::vector<std::string> broken_links(const Rules& rules, const std::map<std::string, std::set<std::string>>& stages);

}  // namespace relievo::layers
