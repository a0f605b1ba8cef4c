#include "layers/layer_rules.h"

#include <algorithm>
#include <fstream>
#include <regex>
#include <sstream>

namespace relievo::layers {

namespace {

std::string trimmed(std::string text) {
    std::erase(text, '`');
    const auto first = text.find_first_not_of(" \t\r");
    return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::set<std::string> split(const std::string& text, char separator) {
    std::set<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, separator);)
        if (!trimmed(part).empty()) parts.insert(trimmed(part));
    return parts;
}

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// The folder of src that a quoted include reaches, or "shaders/".
std::string folder_of(const std::string& include) {
    if (include == "heightfield_functions.h") return "techniques";  // written by CMake
    const std::string first = include.substr(0, include.find('/'));
    return first == "shared" || first == "surface" || first == "shading" || first == "hosts" ? "shaders/" : first;
}

// The library of an angle-bracket include, or empty for the standard library (no dot, no slash) and POSIX.
std::string library_of(const std::string& include) {
    static const std::set<std::string> posix{"unistd.h", "fcntl.h", "pthread.h", "sched.h", "signal.h", "poll.h", "sys"};
    const auto slash = include.find('/');
    const auto dot = include.find('.');
    if (slash == std::string::npos && dot == std::string::npos) return {};
    const std::string first = include.substr(0, slash);
    if (posix.contains(first)) return {};
    return slash != std::string::npos ? first : include.substr(0, dot);
}

}  // namespace

Rules read_table(const std::string& markdown) {
    Rules rules;
    std::istringstream in(markdown);
    bool inside = false;
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with("| folder | may include |")) {
            inside = true;
        } else if (inside && line.starts_with("|---")) {
        } else if (inside && line.starts_with("|")) {
            std::vector<std::string> cells;
            std::istringstream row(line.substr(1));
            for (std::string cell; std::getline(row, cell, '|');) cells.push_back(cell);
            cells.resize(3);
            for (const std::string& folder : split(cells[0], ',')) rules[folder] = {split(cells[1], ','), split(cells[2], ',')};
        } else {
            inside = false;
        }
    }
    return rules;
}

std::map<std::string, std::set<std::string>> read_stages(const std::string& cmake) {
    std::map<std::string, std::set<std::string>> stages;
    static const std::regex stage(R"(relievo_stage\(\s*(\w+)([^)]*)\))");
    for (std::sregex_iterator it(cmake.begin(), cmake.end(), stage), end; it != end; ++it) {
        std::istringstream words((*it)[2]);
        std::set<std::string>& uses = stages[(*it)[1]];
        bool listing = false;
        for (std::string word; words >> word;) {
            if (word == "USES" || word == "THIRD_PARTY") {
                listing = word == "USES";
            } else if (listing) {
                uses.insert(word);
            }
        }
    }
    return stages;
}

std::vector<std::string> broken_includes(const Rules& rules, const std::filesystem::path& src) {
    std::vector<std::string> broken;
    static const std::regex include(R"(^[ \t]*#[ \t]*include[ \t]*(["<])([^">]+)[">])", std::regex::multiline);
    for (const auto& entry : std::filesystem::recursive_directory_iterator(src)) {
        const std::string extension = entry.path().extension().string();
        if (!entry.is_regular_file() || (extension != ".h" && extension != ".cpp" && extension != ".in")) continue;
        const std::filesystem::path place = entry.path().lexically_relative(src);
        const std::string folder = place.begin()->string();
        const auto rule = rules.find(folder);
        if (rule == rules.end()) {
            broken.push_back(place.string() + ": the folder " + folder + " has no row in the table of layers");
            continue;
        }
        const std::string text = text_of(entry.path());
        for (std::sregex_iterator it(text.begin(), text.end(), include), end; it != end; ++it) {
            const bool quoted = (*it)[1] == "\"";
            const std::string path = (*it)[2];
            const std::string reached = quoted ? folder_of(path) : library_of(path);
            if (quoted ? reached == folder || rule->second.may_include.contains(reached)
                       : reached.empty() || rule->second.libraries.contains(reached))
                continue;
            broken.push_back(place.string() + " includes " + path + ", but " + folder + " may not see " + reached);
        }
    }
    std::ranges::sort(broken);
    return broken;
}

std::vector<std::string> broken_links(const Rules& rules, const std::map<std::string, std::set<std::string>>& stages) {
    std::vector<std::string> broken;
    for (const auto& [folder, uses] : stages) {
        const auto rule = rules.find(folder);
        if (rule == rules.end()) {
            broken.push_back("CMakeLists.txt builds " + folder + ", which has no row in the table of layers");
            continue;
        }
        std::set<std::string> allowed = rule->second.may_include;
        allowed.erase("shaders/");
        for (const std::string& one : uses)
            if (!allowed.contains(one)) broken.push_back("CMakeLists.txt links " + folder + " with " + one + ", which the table does not allow");
        for (const std::string& one : allowed)
            if (!uses.contains(one)) broken.push_back("the table lets " + folder + " include " + one + ", with which CMakeLists.txt does not link it");
    }
    for (const auto& [folder, rule] : rules)
        if (!stages.contains(folder)) broken.push_back("the table has a row " + folder + ", which CMakeLists.txt does not build");
    return broken;
}

}  // namespace relievo::layers
