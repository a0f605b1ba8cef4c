#include "assets/material_sidecar.h"

#include "assets/atomic_file.h"
#include "core/error.h"

#include <toml++/toml.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <numeric>
#include <span>
#include <sstream>
#include <string_view>
#include <type_traits>
#include <vector>

namespace relievo {

namespace {

constexpr std::string_view top_keys[] = {"height_scale", "physical_size_m", "zero_level", "white_is_high", "normal_y", "files"};
constexpr std::string_view file_keys[] = {"colour", "height", "normal"};

// Levenshtein's distance: insertions, deletions and replacements that turn one word into the other.
std::size_t edits_between(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const std::size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = std::min({row[j] + 1, row[j - 1] + 1, replaced});
        }
    }
    return row[b.size()];
}

class Reader {
public:
    explicit Reader(const std::filesystem::path& file) : file_(file) {}

    void known_keys(const toml::table& table, std::span<const std::string_view> keys, const std::string& where) const {
        for (const auto& [key, value] : table) {
            const std::string_view name = key.str();
            if (std::find(keys.begin(), keys.end(), name) != keys.end()) continue;
            const auto nearest = std::min_element(keys.begin(), keys.end(), [&](std::string_view a, std::string_view b) {
                return edits_between(a, name) < edits_between(b, name);
            });
            std::string advice;
            if (edits_between(*nearest, name) <= std::max<std::size_t>(2, nearest->size() / 3))
                advice = "did you mean \"" + std::string(*nearest) + "\"? ";
            advice += "Known" + where + " are";
            for (const std::string_view& k : keys) advice += (&k == &keys.front() ? " " : ", ") + std::string(k);
            fail(value, "unknown key \"" + std::string(name) + "\"", advice);
        }
    }

    template <class T>
    std::optional<T> get(const toml::table& table, std::string_view key, const char* expected) const {
        const toml::node* node = table.get(key);
        if (!node) return std::nullopt;
        // value_exact would refuse 1 for 1.0; value would take true for 1.
        const bool matches = std::is_same_v<T, double> ? node->is_number()
                             : std::is_same_v<T, bool> ? node->is_boolean()
                                                       : node->is_string();
        if (!matches) fail(*node, std::string(key) + " must be " + expected, {});
        return *node->value<T>();
    }

    // A number in (low, high], or [low, high] with `closed`.
    std::optional<float> number(const toml::table& table, std::string_view key, double low, double high, bool closed) const {
        const std::optional<double> x = get<double>(table, key, "a number");
        if (!x) return std::nullopt;
        if (!std::isfinite(*x) || *x > high || *x < low || (!closed && *x <= low)) {
            std::ostringstream range;
            range << key << " = " << *x << " is out of range: it must be " << (closed ? "at least " : "greater than ") << low;
            if (std::isfinite(high)) range << " and at most " << high;
            fail(*table.get(key), range.str(), {});
        }
        return static_cast<float>(*x);
    }

    [[noreturn]] void fail(const toml::node& node, const std::string& reason, const std::string& advice) const {
        throw Error("read material description", file_.string() + ", line " + std::to_string(node.source().begin.line), reason,
                    advice);
    }

private:
    std::filesystem::path file_;
};

// Shortest decimal text that reads back as the same float.
std::string text_of(float x) {
    char text[32];
    for (int digits = 6; digits <= 9; ++digits) {
        std::snprintf(text, sizeof text, "%.*g", digits, static_cast<double>(x));
        if (std::strtof(text, nullptr) == x) break;
    }
    std::string result = text;
    return result.find_first_of(".e") == std::string::npos ? result + ".0" : result;
}

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        char escape[8];
        if (c == '"' || c == '\\') {
            result += '\\', result += c;
        } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            std::snprintf(escape, sizeof escape, "\\u%04x", static_cast<unsigned>(c));
            result += escape;
        } else {
            result += c;
        }
    }
    return result + '"';
}

}  // namespace

MaterialSidecar read_sidecar(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    if (!std::filesystem::is_regular_file(file) || !in || !(in.peek() == std::ifstream::traits_type::eof() || text << in.rdbuf()))
        throw Error("read material description", file.string(), "it cannot be opened",
                    "check that it is there and its permissions");
    toml::table table;
    try {
        table = toml::parse(text.str(), file.string());
    } catch (const toml::parse_error& e) {
        throw Error("read material description", file.string() + ", line " + std::to_string(e.source().begin.line),
                    std::string(e.description()));
    }
    const Reader reader(file);
    reader.known_keys(table, top_keys, " keys");
    constexpr double no_limit = std::numeric_limits<double>::infinity();
    MaterialSidecar sidecar;
    sidecar.height_scale = reader.number(table, "height_scale", 0, 1, false);
    sidecar.physical_size_m = reader.number(table, "physical_size_m", 0, no_limit, false);
    sidecar.zero_level = reader.number(table, "zero_level", 0, 1, true);
    sidecar.white_is_high = reader.get<bool>(table, "white_is_high", "true or false");
    if (const auto y = reader.get<std::string>(table, "normal_y", "\"up\" or \"down\"")) {
        if (*y != "up" && *y != "down")
            reader.fail(*table.get("normal_y"), "normal_y must be \"up\" or \"down\", not \"" + *y + "\"", {});
        sidecar.normal_y_up = *y == "up";
    }
    if (const toml::node* node = table.get("files")) {
        if (!node->is_table()) reader.fail(*node, "files must be a table: [files]", {});
        const toml::table& files = *node->as_table();
        reader.known_keys(files, file_keys, " files");
        sidecar.colour = reader.get<std::string>(files, "colour", "a file name in quotes");
        sidecar.height = reader.get<std::string>(files, "height", "a file name in quotes");
        sidecar.normal = reader.get<std::string>(files, "normal", "a file name in quotes");
    }
    return sidecar;
}

void write_sidecar(const std::filesystem::path& file, const MaterialSidecar& sidecar) {
    std::string text;
    const auto line = [&](const char* key, const std::string& value) { text += std::string(key) + " = " + value + "\n"; };
    if (sidecar.height_scale) line("height_scale", text_of(*sidecar.height_scale));
    if (sidecar.physical_size_m) line("physical_size_m", text_of(*sidecar.physical_size_m));
    if (sidecar.zero_level) line("zero_level", text_of(*sidecar.zero_level));
    if (sidecar.white_is_high) line("white_is_high", *sidecar.white_is_high ? "true" : "false");
    if (sidecar.normal_y_up) line("normal_y", *sidecar.normal_y_up ? "\"up\"" : "\"down\"");
    if (sidecar.colour || sidecar.height || sidecar.normal) text += std::string(text.empty() ? "" : "\n") + "[files]\n";
    if (sidecar.colour) line("colour", quoted(*sidecar.colour));
    if (sidecar.height) line("height", quoted(*sidecar.height));
    if (sidecar.normal) line("normal", quoted(*sidecar.normal));
    write_file_atomically(file, text);
}

}  // namespace relievo
