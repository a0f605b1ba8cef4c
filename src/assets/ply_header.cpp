#include "assets/ply_header.h"

#include "core/error.h"

#include <array>
#include <utility>

#include "assets/mesh_assembly.h"
#include "assets/text_number.h"

namespace relievo::ply {

namespace {

using text::is_blank;

std::optional<Type> type_named(std::string_view name) {
    constexpr std::array<std::pair<std::string_view, Type>, 16> names = {{{"char", Type::i8}, {"int8", Type::i8}, {"uchar", Type::u8}, {"uint8", Type::u8},
        {"short", Type::i16}, {"int16", Type::i16}, {"ushort", Type::u16}, {"uint16", Type::u16}, {"int", Type::i32}, {"int32", Type::i32},
        {"uint", Type::u32}, {"uint32", Type::u32}, {"float", Type::f32}, {"float32", Type::f32}, {"double", Type::f64}, {"float64", Type::f64}}};
    for (const auto& [known, type] : names)
        if (known == name) return type;
    return std::nullopt;
}

std::vector<std::string_view> words_of(std::string_view line) {
    std::vector<std::string_view> words;
    for (std::size_t i = 0; i < line.size();) {
        while (i < line.size() && is_blank(line[i])) ++i;
        const std::size_t start = i;
        while (i < line.size() && !is_blank(line[i])) ++i;
        if (i > start) words.push_back(line.substr(start, i - start));
    }
    return words;
}

}  // namespace

std::size_t size_of(Type type) {
    constexpr std::array<std::size_t, 8> sizes = {1, 1, 2, 2, 4, 4, 4, 8};
    return sizes[static_cast<std::size_t>(type)];
}

Header read_header(std::string_view bytes, const std::string& file) {
    // Lines end with "\n", "\r\n" or "\r"; a file keeps to one of them, and the first byte of binary data may look like another.
    const std::size_t first_end = bytes.find_first_of("\r\n");
    const bool lone_return = first_end != std::string_view::npos && bytes[first_end] == '\r' && bytes.substr(first_end, 2) != "\r\n";
    const char end_of_line = lone_return ? '\r' : '\n';

    Header header;
    bool has_format = false;
    int line_number = 0;
    std::size_t at = 0;
    for (;;) {
        ++line_number;
        const auto fail = [&](const std::string& why) -> Error { return Error("read", file, "line " + std::to_string(line_number) + " of the header: " + why); };
        const std::size_t end = bytes.find(end_of_line, at);
        if (end == std::string_view::npos) throw fail("the header is not ended by end_header");
        const std::vector<std::string_view> words = words_of(bytes.substr(at, end - at));
        at = end + 1;
        if (line_number == 1 || words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
        if (words[0] == "end_header") {
            header.end = at;
            break;
        }
        if (words[0] == "format") {
            if (words.size() < 2) throw fail("the format has no name");
            if (words[1] == "ascii")
                header.format = Format::ascii;
            else if (words[1] == "binary_little_endian")
                header.format = Format::little;
            else if (words[1] == "binary_big_endian")
                header.format = Format::big;
            else
                throw fail("the format is none of ascii, binary_little_endian, binary_big_endian");
            has_format = true;
        } else if (words[0] == "element") {
            if (words.size() != 3) throw fail("an element is \"element NAME COUNT\"");
            Element& element = header.elements.emplace_back();
            element.name = words[1];
            element.line = line_number;
            for (const char c : words[2]) {
                if (!text::is_digit(c)) throw fail("the count of an element is no number");
                element.count = element.count * 10 + static_cast<std::uint64_t>(c - '0');
                if (element.count > (std::uint64_t{1} << 40)) throw fail("the count of an element is absurd");
            }
        } else if (words[0] == "property") {
            const bool list = words.size() == 5 && words[1] == "list";
            if (!list && words.size() != 3) throw fail("a property is \"property TYPE NAME\" or \"property list COUNT_TYPE TYPE NAME\"");
            if (header.elements.empty()) throw fail("a property comes before any element");
            Property property;
            property.name = words.back();
            const std::optional<Type> type = type_named(words[list ? 3 : 1]);
            if (list) property.count = type_named(words[2]);
            if (!type || (list && !property.count)) throw fail("a property has an unknown type");
            if (list && (*property.count == Type::f32 || *property.count == Type::f64)) throw fail("the count of a list is not a whole number");
            property.type = *type;
            header.elements.back().properties.push_back(std::move(property));
        } else {
            ++header.unknown_lines;  // some exporters forget the word "comment"
        }
    }
    if (!has_format) throw Error("read", file, "line " + std::to_string(line_number) + ": the header names no format");
    if (header.elements.empty()) throw Error("read", file, "line " + std::to_string(line_number) + ": the header names no element: there is nothing to read");
    return header;
}

}  // namespace relievo::ply
