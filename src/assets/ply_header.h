// What a PLY file says of itself before its data: elements and their properties, in their order.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace relievo::ply {

enum class Type : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };
enum class Format { ascii, little, big };

std::size_t size_of(Type type);

struct Property {
    std::string name;
    Type type = Type::f32;
    std::optional<Type> count;  // of a list
};

struct Element {
    std::string name;
    std::uint64_t count = 0;
    int line = 0;  // of the file
    std::vector<Property> properties;

    // Bytes an instance needs at least: text needs a digit and a separator per value.
    std::size_t least_bytes(Format format) const {
        std::size_t sum = 0;
        for (const Property& p : properties) sum += format == Format::ascii ? 2 : size_of(p.count.value_or(p.type));
        return sum;
    }
    bool has_list() const { return std::any_of(properties.begin(), properties.end(), [](const Property& p) { return p.count.has_value(); }); }
};

struct Header {
    Format format = Format::ascii;
    std::vector<Element> elements;
    std::size_t end = 0;  // where the elements begin
    int unknown_lines = 0;
};

// Throws Error, naming the line, for what is no header of PLY or promises more than `bytes` can hold.
Header read_header(std::string_view bytes, const std::string& file);

}  // namespace relievo::ply
