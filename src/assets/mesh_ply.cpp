// PLY (Turk, "The PLY polygon file format", 1994): a header that describes elements and their properties, then the elements, as
// text or as bytes of either order. What nearly every file holds, fixed-size vertices and then triangles, is read by all threads on
// the assumption that nothing unusual follows; as soon as something does, the element is read again one value after the other.
#include "core/error.h"
#include "core/parallel_for.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>

#include "assets/mesh_assembly.h"
#include "assets/mesh_formats.h"
#include "assets/ply_header.h"
#include "assets/ply_vertices.h"
#include "assets/polygon_list.h"
#include "assets/text_number.h"

namespace relievo {

namespace {

using text::is_blank;

using namespace ply;

double load(const char* at, Type type, bool swap) {
    const auto bits = [&]<class T>(T) {
        std::array<char, sizeof(T)> raw;
        std::memcpy(raw.data(), at, sizeof(T));
        if (swap) std::reverse(raw.begin(), raw.end());
        return static_cast<double>(std::bit_cast<T>(raw));
    };
    switch (type) {
        case Type::i8: return bits(std::int8_t{});
        case Type::u8: return bits(std::uint8_t{});
        case Type::i16: return bits(std::int16_t{});
        case Type::u16: return bits(std::uint16_t{});
        case Type::i32: return bits(std::int32_t{});
        case Type::u32: return bits(std::uint32_t{});
        case Type::f32: return bits(float{});
        case Type::f64: return bits(double{});
    }
    return 0;
}

float narrowed(double value) {  // the cast of a double beyond every float is undefined
    return std::abs(value) <= 0x1.fffffefp127 || !std::isfinite(value) ? static_cast<float>(value) : std::copysign(INFINITY, static_cast<float>(std::copysign(1.0, value)));
}

// Values one after the other out of binary data.
class BinarySource {
public:
    BinarySource(std::string_view bytes, std::size_t at, bool swap, const std::string& file) : bytes_(bytes), at_(at), swap_(swap), file_(file) {}

    double next(Type type) {
        const std::size_t size = size_of(type);
        if (bytes_.size() - at_ < size) throw Error("read", file_, "it ends at byte " + std::to_string(bytes_.size()) + ", in the middle of its elements");
        const double value = load(bytes_.data() + at_, type, swap_);
        at_ += size;
        return value;
    }
    void check_list(double count, Type type) const {
        if (count * static_cast<double>(size_of(type)) > static_cast<double>(bytes_.size() - at_))
            throw Error("read", file_, "byte " + std::to_string(at_) + ": a list promises " + std::to_string(static_cast<std::uint64_t>(count)) + " values, more than the file holds");
    }
    std::size_t at() const { return at_; }
    void skip_to(std::size_t at) { at_ = at; }

private:
    std::string_view bytes_;
    std::size_t at_;
    bool swap_;
    const std::string& file_;
};

// Values one after the other out of text that ends with a newline.
class TextSource {
public:
    TextSource(std::string_view bytes, std::size_t at, const std::string& file) : bytes_(bytes), p_(bytes.data() + at), end_(bytes.data() + bytes.size()), file_(file) {}

    double next(Type type) {
        while (p_ < end_ && (is_blank(*p_) || *p_ == '\n')) ++p_;
        if (p_ == end_) throw Error("read", file_, "it ends at " + line_of(bytes_, bytes_.size() - 1) + ", in the middle of its elements");
        const char* start = p_;
        std::int64_t whole = 0;
        if (type != Type::f32 && type != Type::f64 && text::read_integer(p_, whole) && ends_here()) return static_cast<double>(whole);
        p_ = start;
        float value = 0;
        if (!text::read_float(p_, end_, value) || !ends_here()) throw Error("read", file_, line_of(bytes_, static_cast<std::size_t>(start - bytes_.data())) + ": something that is no number");
        return static_cast<double>(value);
    }
    void check_list(double count, Type) const {
        if (count > static_cast<double>(end_ - p_))
            throw Error("read", file_, line_of(bytes_, static_cast<std::size_t>(p_ - bytes_.data())) + ": a list promises more values than the file holds");
    }
    std::size_t at() const { return static_cast<std::size_t>(p_ - bytes_.data()); }
    void skip_to(std::size_t at) { p_ = bytes_.data() + at; }

private:
    bool ends_here() const { return is_blank(*p_) || *p_ == '\n'; }

    std::string_view bytes_;
    const char* p_;
    const char* end_;
    const std::string& file_;
};

// What a face element's list means.
enum class Corners { polygon, strip, other };

Corners corners_of(const Element& element, const Property& property) {
    if (!property.count || (property.name != "vertex_indices" && property.name != "vertex_index")) return Corners::other;
    return element.name == "face" ? Corners::polygon : element.name == "tristrips" ? Corners::strip : Corners::other;
}

// One strip after the other, -1 between them; every second triangle is turned.
void add_strip_vertex(std::int64_t index, std::vector<std::int64_t>& strip, PolygonList& polygons) {
    if (index < 0) {
        strip.clear();
        return;
    }
    strip.push_back(index);
    const std::size_t n = strip.size();
    if (n < 3) return;
    const bool turned = n % 2 == 0;
    const std::int64_t a = strip[n - 3], b = strip[n - 2];
    // Strips repeat vertices to turn corners: such triangles are meant to vanish.
    if (a == b || b == index || index == a) return;
    for (const std::int64_t corner : {turned ? b : a, turned ? a : b, index}) polygons.corners.push_back(index_from(corner));
    polygons.close(3);
}

template <class Source>
void read_element(Source& source, const Element& element, const VertexSink* sink, PolygonList& polygons) {
    std::vector<std::int64_t> strip;
    for (std::uint64_t i = 0; i < element.count; ++i) {
        for (std::size_t p = 0; p < element.properties.size(); ++p) {
            const Property& property = element.properties[p];
            if (!property.count) {
                const double value = source.next(property.type);
                if (sink) sink->put(static_cast<std::size_t>(i), p, narrowed(value));
                continue;
            }
            const double count = std::max(0.0, source.next(*property.count));
            source.check_list(count, property.type);
            const Corners corners = corners_of(element, property);
            const auto n = static_cast<std::size_t>(count);
            strip.clear();
            for (std::size_t k = 0; k < n; ++k) {
                const double value = source.next(property.type);
                if (corners == Corners::other) continue;
                const auto index = value >= -1e9 && value <= 1e10 ? static_cast<std::int64_t>(value) : std::int64_t{max_vertices};
                if (corners == Corners::strip)
                    add_strip_vertex(index, strip, polygons);
                else
                    polygons.corners.push_back(index_from(index));
            }
            if (corners == Corners::polygon) polygons.close(n);
        }
    }
}

constexpr std::size_t block = 1 << 14;

int blocks_of(std::uint64_t count) { return static_cast<int>((count + block - 1) / block); }

// Vertices of one size each, by all threads.
void read_binary_vertices(const char* data, const Element& element, const VertexSink& sink, std::vector<Vec3f>& positions, bool swap, int threads) {
    std::vector<std::size_t> offsets;
    std::size_t stride = 0;
    for (const Property& property : element.properties) {
        offsets.push_back(stride);
        stride += size_of(property.type);
    }
    bool plain = !swap && std::endian::native == std::endian::little && element.properties.size() >= 3;
    for (std::size_t p = 0; plain && p < 3; ++p) plain = element.properties[p].type == Type::f32 && sink.target(p) == static_cast<Target>(p);
    parallel_for(blocks_of(element.count), 1, threads, [&](int first, int last) {
        const std::size_t begin = static_cast<std::size_t>(first) * block, end = std::min<std::size_t>(element.count, static_cast<std::size_t>(last) * block);
        for (std::size_t i = begin; i < end; ++i) {
            const char* const at = data + i * stride;
            if (plain) std::memcpy(&positions[i], at, sizeof(Vec3f));
            for (std::size_t p = plain ? 3 : 0; p < offsets.size(); ++p)
                if (sink.target(p) != none) sink.put(i, p, narrowed(load(at + offsets[p], element.properties[p].type, swap)));
        }
    });
}

// Faces that are all triangles of 32-bit indices and one size each; false, with nothing read, where one is not.
bool read_binary_triangles(std::string_view data, const Element& element, PolygonList& polygons, bool swap, int threads) {
    std::size_t before = 0, after = 0;
    bool list = false;
    for (const Property& property : element.properties) {
        if (property.count) {
            if (list || corners_of(element, property) != Corners::polygon || size_of(*property.count) != 1 || (property.type != Type::i32 && property.type != Type::u32))
                return false;
            list = true;
        } else {
            (list ? after : before) += size_of(property.type);
        }
    }
    const std::size_t stride = before + 1 + 12 + after;
    if (!list || !polygons.corners.empty() || data.size() / stride < element.count) return false;
    polygons.corners.resize(3 * static_cast<std::size_t>(element.count));
    std::atomic<bool> triangles{true};
    parallel_for(blocks_of(element.count), 1, threads, [&](int first, int last) {
        const std::size_t begin = static_cast<std::size_t>(first) * block, end = std::min<std::size_t>(element.count, static_cast<std::size_t>(last) * block);
        bool all = triangles;
        for (std::size_t i = begin; i < end && all; ++i) {
            const char* const at = data.data() + i * stride + before;
            all = *at == 3;
            std::array<std::uint32_t, 3> corner;
            std::memcpy(corner.data(), at + 1, 12);
            for (std::uint32_t& c : corner) {
                if (swap) c = __builtin_bswap32(c);
                c = std::min(c, index_out_of_range);
            }
            std::memcpy(&polygons.corners[3 * i], corner.data(), 12);
        }
        if (!all) triangles = false;
    });
    if (!triangles) {
        polygons.corners.clear();
        return false;
    }
    polygons.faces = static_cast<std::size_t>(element.count);
    return true;
}

// A stretch of lines and what was read from them.
struct Lines {
    const char* begin;
    const char* end;
    std::size_t first = 0;  // number of the first one
    PolygonList polygons;
};

bool only_blanks(const char*& p) {
    while (is_blank(*p)) ++p;
    return *p == '\n';
}

bool read_vertex_line(const char*& p, const char* end, std::size_t vertex, std::size_t properties, const VertexSink& sink) {
    for (std::size_t k = 0; k < properties; ++k) {
        while (is_blank(*p)) ++p;
        float value = 0;
        if (!text::read_float(p, end, value) || !(is_blank(*p) || *p == '\n')) return false;
        sink.put(vertex, k, value);
    }
    return only_blanks(p);
}

bool read_face_line(const char*& p, PolygonList& polygons) {
    while (is_blank(*p)) ++p;
    std::int64_t n = 0, index = 0;
    if (!text::read_integer(p, n) || n < 0) return false;
    for (std::int64_t k = 0; k < n; ++k) {
        if (!is_blank(*p)) return false;
        while (is_blank(*p)) ++p;
        if (!text::read_integer(p, index)) return false;
        polygons.corners.push_back(index_from(index));
    }
    polygons.close(static_cast<std::size_t>(n));
    return only_blanks(p);
}

// Text with a line per vertex and then a line per face, by all threads; false where it is anything else.
bool read_text_lines(std::string_view body, const Element& vertices, const Element& faces, const VertexSink& sink, PolygonList& polygons, int threads) {
    if (vertices.has_list() || faces.properties.size() != 1 || corners_of(faces, faces.properties[0]) != Corners::polygon) return false;
    constexpr std::size_t piece_bytes = 1 << 19;
    std::vector<Lines> pieces;
    const char* const end = body.data() + body.size();
    for (const char* begin = body.data(); begin < end;) {
        const char* cut = end - begin > static_cast<std::ptrdiff_t>(piece_bytes) ? begin + piece_bytes : end - 1;
        cut = static_cast<const char*>(std::memchr(cut, '\n', static_cast<std::size_t>(end - cut)));
        pieces.push_back({begin, cut + 1, 0, {}});
        begin = cut + 1;
    }
    const auto count = static_cast<int>(pieces.size());
    std::vector<std::size_t> lines(pieces.size());
    parallel_for(count, 1, threads, [&](int first, int last) {
        for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) lines[i] = static_cast<std::size_t>(std::count(pieces[i].begin, pieces[i].end, '\n'));
    });
    std::size_t total = 0;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        pieces[i].first = total;
        total += lines[i];
    }
    const auto vertex_count = static_cast<std::size_t>(vertices.count), line_count = vertex_count + static_cast<std::size_t>(faces.count);
    if (total < line_count) return false;
    std::atomic<bool> usual{true};
    parallel_for(count, 1, threads, [&](int first, int last) {
        for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last) && usual; ++i) {
            Lines& piece = pieces[i];
            if (piece.first + lines[i] > vertex_count) piece.polygons.corners.reserve(static_cast<std::size_t>(piece.end - piece.begin) / 6);
            std::size_t number = piece.first;
            for (const char* p = piece.begin; p < piece.end && number < line_count; ++p, ++number) {
                const bool good = number < vertex_count ? read_vertex_line(p, piece.end, number, vertices.properties.size(), sink) : read_face_line(p, piece.polygons);
                if (!good) {
                    usual = false;
                    return;
                }
            }
        }
    });
    if (!usual) return false;
    std::vector<std::size_t> start(pieces.size() + 1, 0);
    for (std::size_t i = 0; i < pieces.size(); ++i) start[i + 1] = start[i] + pieces[i].polygons.corners.size();
    polygons.corners.resize(start.back());
    parallel_for(count, 1, threads, [&](int first, int last) {
        for (auto i = static_cast<std::size_t>(first); i < static_cast<std::size_t>(last); ++i) {
            std::copy(pieces[i].polygons.corners.begin(), pieces[i].polygons.corners.end(), polygons.corners.begin() + static_cast<std::ptrdiff_t>(start[i]));
            pieces[i].polygons.corners = {};
        }
    });
    for (const Lines& piece : pieces) {
        if (!polygons.sizes.empty() || !piece.polygons.sizes.empty()) {
            polygons.sizes.resize(polygons.faces, 3);
            polygons.sizes.insert(polygons.sizes.end(), piece.polygons.sizes.begin(), piece.polygons.sizes.end());
            polygons.sizes.resize(polygons.faces + piece.polygons.faces, 3);
        }
        polygons.faces += piece.polygons.faces;
    }
    return true;
}

}  // namespace

Mesh parse_ply(std::string_view bytes, const std::string& file, int threads) {
    const Header header = read_header(bytes, file);
    std::string copy;
    if (header.format == Format::ascii && bytes.back() != '\n') {
        copy.assign(bytes);
        copy += '\n';
        bytes = copy;
    }
    const bool swap = header.format == (std::endian::native == std::endian::little ? Format::big : Format::little);
    BinarySource binary(bytes, header.end, swap, file);
    TextSource text(bytes, header.end, file);
    const bool ascii = header.format == Format::ascii;

    Mesh mesh;
    if (header.unknown_lines > 0) mesh.notes.push_back(std::to_string(header.unknown_lines) + " lines of the header begin with no word of PLY: passed over.");
    MeshFaults faults;
    PolygonList polygons;
    bool has_vertices = false;
    for (std::size_t e = 0; e < header.elements.size(); ++e) {
        const Element& element = header.elements[e];
        if (element.properties.empty()) continue;
        const std::size_t at = ascii ? text.at() : binary.at();
        const std::uint64_t room = bytes.size() - at + ascii, least = element.least_bytes(header.format);
        if (element.count > room / least)
            throw Error("read", file, "line " + std::to_string(element.line) + ": its header promises " + std::to_string(element.count) + " elements \"" + element.name + "\", the " + std::to_string(room) +
                        " bytes from byte " + std::to_string(at) + " on hold at most " + std::to_string(room / least), "copy the file again");
        std::optional<VertexSink> sink;
        if (element.name == "vertex" && !has_vertices) {
            has_vertices = true;
            if (element.count > max_vertices) throw Error("read", file, end_of(bytes.size()) + "it holds more than 2^32 vertices");
            sink.emplace(element, mesh);
            if (!sink->complete()) throw Error("read", file, "line " + std::to_string(element.line) + ": its vertices have no x, y and z");
            if (ascii && e == 0 && header.elements.size() == 2 &&
                read_text_lines(bytes.substr(at), element, header.elements[1], *sink, polygons, threads))
                break;
            if (!ascii && !element.has_list()) {
                read_binary_vertices(bytes.data() + at, element, *sink, mesh.positions, swap, threads);
                binary.skip_to(at + static_cast<std::size_t>(element.count * least));
                continue;
            }
        }
        if (!ascii && read_binary_triangles(bytes.substr(at), element, polygons, swap, threads)) {
            binary.skip_to(at + static_cast<std::size_t>(element.count * (least + 12)));
            continue;
        }
        if (ascii)
            read_element(text, element, sink ? &*sink : nullptr, polygons);
        else
            read_element(binary, element, sink ? &*sink : nullptr, polygons);
    }
    for (const Element& element : header.elements)
        for (const Property& property : element.properties)
            if (property.count && property.name == "texcoord") mesh.notes.push_back("Texture coordinates per corner were passed over: they are read per vertex only.");
    mesh.indices = triangles_of(std::move(polygons), mesh.positions, faults, threads);
    finish_mesh(mesh, faults, bytes.size(), file, threads);
    return mesh;
}

}  // namespace relievo
