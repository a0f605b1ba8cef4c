#include "assets/gltf_accessor.h"

#include "assets/json_place.h"
#include "core/error.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

#include "assets/mesh_assembly.h"

namespace relievo {

namespace {

using nlohmann::json;

std::string decode_base64(std::string_view text) {
    std::string bytes;
    bytes.reserve(text.size() / 4 * 3);
    std::uint32_t bits = 0;
    int held = 0;
    for (const char c : text) {
        int value = -1;
        if (c >= 'A' && c <= 'Z') value = c - 'A';
        if (c >= 'a' && c <= 'z') value = c - 'a' + 26;
        if (c >= '0' && c <= '9') value = c - '0' + 52;
        if (c == '+' || c == '-') value = 62;
        if (c == '/' || c == '_') value = 63;
        if (value < 0) continue;  // padding and line ends
        bits = bits << 6 | static_cast<std::uint32_t>(value);
        held += 6;
        if (held >= 8) {
            held -= 8;
            bytes += static_cast<char>(bits >> held & 0xff);
        }
    }
    return bytes;
}

std::string decode_percent(std::string_view uri) {
    const auto digit = [](char c) { return c >= '0' && c <= '9' ? c - '0' : (c | 32) >= 'a' && (c | 32) <= 'f' ? (c | 32) - 'a' + 10 : -1; };
    std::string plain;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] == '%' && i + 2 < uri.size() && digit(uri[i + 1]) >= 0 && digit(uri[i + 2]) >= 0) {
            plain += static_cast<char>(digit(uri[i + 1]) * 16 + digit(uri[i + 2]));
            i += 2;
        } else {
            plain += uri[i];
        }
    }
    return plain;
}

// glTF's numbers for component types.
enum Component : std::int64_t { i8 = 5120, u8 = 5121, i16 = 5122, u16 = 5123, u32 = 5125, f32 = 5126 };

std::size_t size_of(std::int64_t component) {
    switch (component) {
        case i8: case u8: return 1;
        case i16: case u16: return 2;
        case u32: case f32: return 4;
        default: return 0;
    }
}

template <class T>
T little(const char* at) {  // glTF is little-endian, as is every machine this runs on (mesh_cache.cpp asserts it)
    T value;
    std::memcpy(&value, at, sizeof(T));
    return value;
}

}  // namespace

struct GltfData::View {
    std::string_view bytes;
    std::uint64_t stride = 0;  // 0: elements lie close
};

struct GltfData::Accessor {
    std::int64_t index = 0;
    std::int64_t component = 0;
    std::size_t components = 0;
    std::size_t count = 0;
    bool normalised = false;
    std::string_view bytes;  // of the view from the accessor's first byte on; empty: all zero
    std::uint64_t stride = 0;
    const json* sparse = nullptr;
};

GltfData::GltfData(const json& document, std::string_view text, std::string_view bytes, std::string_view binary, const ReadUri& read_uri, const std::string& file)
    : document_(document), text_(text), bytes_(bytes), binary_(binary), reading_(&document), read_uri_(read_uri), file_(file) {
    const std::size_t n = document.contains("buffers") ? document.at("buffers").size() : 0;
    buffers_.resize(n);
    read_.resize(n);
}

GltfData::~GltfData() = default;

void GltfData::fail(const json& value, const std::string& why) const {
    const auto start = static_cast<std::size_t>(text_.data() - bytes_.data());
    throw Error("read", file_, "byte " + std::to_string(start + byte_of(text_, document_, value)) + ": " + why);
}

std::int64_t GltfData::integer(const json& value) const {
    if (!value.is_number()) fail(value, "its JSON has " + std::string(value.type_name()) + " where a number belongs");
    const double number = value.get<double>();
    // Larger sizes exist in no file, and sums of these cannot overflow.
    if (!(std::abs(number) <= 1e15)) fail(value, "its JSON has a number out of range");
    return static_cast<std::int64_t>(number);
}

std::uint64_t GltfData::number(const json& object, const char* key, std::uint64_t otherwise) const {
    const auto found = object.find(key);
    if (found == object.end()) return otherwise;
    const std::int64_t value = integer(*found);
    if (value < 0) fail(*found, std::string("its JSON has a negative \"") + key + "\"");
    return static_cast<std::uint64_t>(value);
}

std::string_view GltfData::buffer(std::int64_t index) {
    if (index < 0 || index >= static_cast<std::int64_t>(buffers_.size())) fail(document_, "buffer " + std::to_string(index) + " is not there");
    const auto at = static_cast<std::size_t>(index);
    const json& object = document_.at("buffers").at(at);
    read_at(object);
    if (!object.is_object()) fail(object, "buffer " + std::to_string(index) + " is no object");
    const std::uint64_t promised = number(object, "byteLength", 0);
    std::string_view bytes;
    if (!object.contains("uri")) {
        if (index != 0 || binary_.empty()) fail(object, "buffer " + std::to_string(index) + " has no uri and the file has no binary chunk for it");
        bytes = binary_;
    } else {
        if (!read_[at]) {
            const auto& uri = object.at("uri").get_ref<const std::string&>();
            const std::size_t comma = uri.find(',');
            if (uri.starts_with("data:")) {
                if (comma == std::string::npos) fail(object, "buffer " + std::to_string(index) + " has a data uri without data");
                const bool base64 = std::string_view(uri).substr(0, comma).ends_with(";base64");
                buffers_[at] = base64 ? decode_base64(std::string_view(uri).substr(comma + 1)) : decode_percent(std::string_view(uri).substr(comma + 1));
            } else {
                try {
                    buffers_[at] = read_uri_(decode_percent(uri));
                } catch (const Error& e) {
                    fail(object.at("uri"), "its buffer is missing: " + std::string(e.what()));
                }
            }
            read_[at] = true;
        }
        bytes = buffers_[at];
    }
    if (bytes.size() < promised)
        fail(object, "buffer " + std::to_string(index) + " promises " + std::to_string(promised) + " bytes and has " + std::to_string(bytes.size()));
    return bytes.substr(0, static_cast<std::size_t>(promised));
}

GltfData::View GltfData::view(std::int64_t index) {
    const json& views = document_.at("bufferViews");
    if (index < 0 || index >= static_cast<std::int64_t>(views.size())) fail(views, "bufferView " + std::to_string(index) + " is not there");
    const json& object = views.at(static_cast<std::size_t>(index));
    read_at(object);
    if (!object.is_object()) fail(object, "bufferView " + std::to_string(index) + " is no object");
    const json extensions = object.value("extensions", json::object());
    if (extensions.contains("EXT_meshopt_compression") || extensions.contains("KHR_meshopt_compression"))
        fail(object, "bufferView " + std::to_string(index) + " is compressed with meshopt, which is not read here");
    const std::string_view bytes = buffer(static_cast<std::int64_t>(number(object, "buffer", 0)));
    const std::uint64_t offset = number(object, "byteOffset", 0), length = number(object, "byteLength", 0);
    if (offset + length > bytes.size())
        fail(object, "bufferView " + std::to_string(index) + " ends at byte " + std::to_string(offset + length) + " of a buffer of " + std::to_string(bytes.size()));
    return {bytes.substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(length)), number(object, "byteStride", 0)};
}

GltfData::Accessor GltfData::accessor(std::int64_t index) {
    const json& accessors = document_.at("accessors");
    if (index < 0 || index >= static_cast<std::int64_t>(accessors.size())) fail(accessors, "accessor " + std::to_string(index) + " is not there");
    const json& object = accessors.at(static_cast<std::size_t>(index));
    read_at(object);
    if (!object.is_object()) fail(object, "accessor " + std::to_string(index) + " is no object");
    const std::string who = "accessor " + std::to_string(index);

    Accessor result;
    result.index = index;
    result.component = static_cast<std::int64_t>(number(object, "componentType", 0));
    const std::size_t size = size_of(result.component);
    if (size == 0) fail(object, who + " has the unknown component type " + std::to_string(result.component));
    const auto& type = object.at("type").get_ref<const std::string&>();
    result.components = type == "SCALAR" ? 1 : type == "VEC2" ? 2 : type == "VEC3" ? 3 : type == "VEC4" ? 4 : 0;
    if (result.components == 0) fail(object, who + " has type " + type + ", which no vertex attribute has");
    const std::uint64_t count = number(object, "count", 0);
    if (count > max_vertices) fail(object, who + " promises " + std::to_string(count) + " elements");
    result.count = static_cast<std::size_t>(count);
    result.normalised = object.contains("normalized") && object.at("normalized").get<bool>();
    const std::uint64_t element = size * result.components;
    if (object.contains("bufferView")) {
        const View from = view(static_cast<std::int64_t>(number(object, "bufferView", 0)));
        const std::uint64_t offset = number(object, "byteOffset", 0);
        result.stride = from.stride ? from.stride : element;
        const std::uint64_t end = count == 0 ? 0 : offset + (count - 1) * result.stride + element;
        // Strides are 4 to 252 bytes; shorter ones would let few bytes stand for many elements.
        if (result.stride < element || result.stride > 252) fail(object, who + " has elements " + std::to_string(result.stride) + " bytes apart");
        if (end > from.bytes.size())
            fail(object, who + " promises " + std::to_string(count) + " elements up to byte " + std::to_string(end) + " of a bufferView of " + std::to_string(from.bytes.size()));
        if (count > 0) result.bytes = from.bytes.substr(static_cast<std::size_t>(offset));
    }
    if (object.contains("sparse")) result.sparse = &object.at("sparse");
    if (result.bytes.empty() && count > 0) {
        // All zero but for what a sparse part says: nothing in the file is as large as the promise.
        constexpr std::uint64_t most_zeros = 1 << 20;
        if (!result.sparse) fail(object, who + " has no data");
        if (count > most_zeros) fail(object, who + " promises " + std::to_string(count) + " elements and has data for a few");
    }
    return result;
}

template <class T, class Convert>
std::vector<T> GltfData::values(const Accessor& from, const Convert& convert) {
    const std::size_t size = size_of(from.component);
    std::vector<T> all(from.count * from.components);
    if (!from.bytes.empty())
        for (std::size_t i = 0; i < from.count; ++i)
            for (std::size_t k = 0; k < from.components; ++k) all[i * from.components + k] = convert(from.bytes.data() + i * from.stride + k * size);
    if (!from.sparse) return all;

    const std::string who = "the sparse part of accessor " + std::to_string(from.index);
    const json &places = from.sparse->at("indices"), &replaced = from.sparse->at("values");
    const std::uint64_t n = number(*from.sparse, "count", 0);
    const auto component = static_cast<std::int64_t>(number(places, "componentType", 0));
    if (component != u8 && component != u16 && component != u32) fail(*from.sparse, who + " has indices of type " + std::to_string(component));
    const View index_view = view(static_cast<std::int64_t>(number(places, "bufferView", 0))), value_view = view(static_cast<std::int64_t>(number(replaced, "bufferView", 0)));
    const std::uint64_t index_at = number(places, "byteOffset", 0), value_at = number(replaced, "byteOffset", 0);
    const std::size_t index_size = size_of(component), element = size * from.components;
    if (n > max_vertices || index_at + n * index_size > index_view.bytes.size() || value_at + n * element > value_view.bytes.size())
        fail(*from.sparse, who + " promises " + std::to_string(n) + " elements, more than it has");
    for (std::size_t i = 0; i < n; ++i) {
        const char* const at = index_view.bytes.data() + index_at + i * index_size;
        const std::size_t place = component == u8 ? little<std::uint8_t>(at) : component == u16 ? little<std::uint16_t>(at) : little<std::uint32_t>(at);
        if (place >= from.count) fail(*from.sparse, who + " replaces element " + std::to_string(place) + " of " + std::to_string(from.count));
        for (std::size_t k = 0; k < from.components; ++k) all[place * from.components + k] = convert(value_view.bytes.data() + value_at + i * element + k * size);
    }
    return all;
}

std::vector<float> GltfData::floats(std::int64_t index, std::size_t& components) {
    const Accessor from = accessor(index);
    components = from.components;
    const auto share = [&](auto integer, float largest) {
        // Of signed types the most negative value stands for -1 like its neighbour (3.11).
        return from.normalised ? std::max(static_cast<float>(integer) / largest, -1.0f) : static_cast<float>(integer);
    };
    switch (from.component) {
        case i8: return values<float>(from, [&](const char* at) { return share(little<std::int8_t>(at), 127.0f); });
        case u8: return values<float>(from, [&](const char* at) { return share(little<std::uint8_t>(at), 255.0f); });
        case i16: return values<float>(from, [&](const char* at) { return share(little<std::int16_t>(at), 32767.0f); });
        case u16: return values<float>(from, [&](const char* at) { return share(little<std::uint16_t>(at), 65535.0f); });
        case u32: return values<float>(from, [&](const char* at) { return share(little<std::uint32_t>(at), 4294967295.0f); });
        default: return values<float>(from, [](const char* at) { return little<float>(at); });
    }
}

std::vector<std::uint32_t> GltfData::indices(std::int64_t index) {
    const Accessor from = accessor(index);
    const std::string who = "accessor " + std::to_string(index);
    if (from.components != 1) fail(document_.at("accessors").at(static_cast<std::size_t>(index)), who + " holds indices and is no SCALAR");
    switch (from.component) {
        case u8: return values<std::uint32_t>(from, [](const char* at) { return little<std::uint8_t>(at); });
        case u16: return values<std::uint32_t>(from, [](const char* at) { return little<std::uint16_t>(at); });
        case u32: return values<std::uint32_t>(from, [](const char* at) { return little<std::uint32_t>(at); });
        default: fail(document_.at("accessors").at(static_cast<std::size_t>(index)), who + " holds indices of component type " + std::to_string(from.component));
    }
}

std::size_t GltfData::count(std::int64_t index) { return accessor(index).count; }

}  // namespace relievo
