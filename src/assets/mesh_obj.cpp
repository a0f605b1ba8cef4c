// Wavefront OBJ in pieces: the text is cut at line ends, every piece is parsed by whichever thread is free into lists of its own,
// and the lists are joined in the order of the text. A negative index counts back from a line whose number of vertices before it is
// known only then, so such corners are marked and resolved in the second pass.
#include "core/error.h"
#include "core/parallel_for.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <memory>
#include <string>

#include "assets/mesh_assembly.h"
#include "assets/mesh_formats.h"
#include "assets/text_number.h"

namespace relievo {

namespace {

using text::is_blank;

// Bytes per piece: small enough for two threads to finish together on a file of some megabytes, large enough for a piece's
// lists to be worth it.
constexpr std::size_t piece_bytes = 1 << 19;

enum Attribute : std::size_t { position, uv, normal };

struct Piece {
    const char* begin = nullptr;
    const char* end = nullptr;  // behind a newline

    std::vector<Vec3f> positions, normals, colours;  // colours: empty, or as long as positions
    std::vector<Vec2f> uvs;

    // Corners of all faces, one after the other; uv and normal are empty where no corner names one.
    std::array<std::vector<std::uint32_t>, 3> corners;
    std::vector<std::uint32_t> sizes;  // corners per face; empty while all are triangles
    std::size_t faces = 0;
    std::array<std::vector<std::uint32_t>, 3> relative;  // places in corners[a] that count from this piece's first element

    MeshFaults faults;
    std::size_t passed_over = 0;  // lines, points, curves and surfaces
    std::size_t vertex_count = 0, triangle_corners = 0;  // lengths, kept when the lists are given up
    const char* error_at = nullptr;
    std::string error;

    std::size_t count(std::size_t attribute) const {
        return attribute == position ? positions.size() : attribute == uv ? uvs.size() : normals.size();
    }
};

// Where lines may be cut: behind a newline that no backslash continues.
bool line_ends_at(const char* begin, const char* newline) {
    const char* p = newline;
    while (p > begin && p[-1] == '\r') --p;
    return p == begin || p[-1] != '\\';
}

class PieceParser {
public:
    explicit PieceParser(Piece& piece) : piece_(piece), p_(piece.begin), end_(piece.end) {}

    void parse() {
        const auto bytes = static_cast<std::size_t>(end_ - p_);
        // A piece mostly holds one kind of line; the other list stays short and the pages it reserved untouched.
        piece_.positions.reserve(bytes / 24);
        piece_.corners[position].reserve(bytes / 8);
        while (p_ < end_) {
            if (!line()) {
                piece_.error_at = std::min(p_, end_ - 1);
                return;
            }
        }
        for (std::size_t a : {uv, normal})
            if (!piece_.corners[a].empty()) piece_.corners[a].resize(piece_.corners[position].size(), index_missing);
        if (!piece_.colours.empty()) piece_.colours.resize(piece_.positions.size(), Vec3f(1.0f));
    }

private:
    bool fail(const char* what) {
        piece_.error = what;
        return false;
    }

    // To the next word of the line, which a backslash continues on the next one.
    void skip_blanks() {
        for (;;) {
            while (is_blank(*p_)) ++p_;
            if (*p_ != '\\') return;
            const char* q = p_ + 1;
            while (*q == '\r') ++q;
            if (*q != '\n' || q + 1 >= end_) return;
            p_ = q + 1;
        }
    }

    bool at_end() const { return *p_ == '\n' || *p_ == '#'; }

    void skip_line() { p_ = static_cast<const char*>(std::memchr(p_, '\n', static_cast<std::size_t>(end_ - p_))) + 1; }

    bool line() {
        skip_blanks();
        const char first = *p_;
        if (first == '\n') {
            ++p_;
            return true;
        }
        const char second = p_[1];  // at worst the newline
        if (first == 'v') {
            if (is_blank(second)) {
                ++p_;
                return vertex();
            }
            const bool word = (second == 't' || second == 'n') && is_blank(p_[2]);
            if (word) {
                p_ += 2;
                return second == 't' ? texture_coordinate() : normal_vector();
            }
        } else if (first == 'f' && is_blank(second)) {
            ++p_;
            return face();
        } else if (first == 'l' || first == 'p' || first == 'c' || first == 's') {
            const std::string_view rest(p_, static_cast<std::size_t>(end_ - p_));
            for (const std::string_view word : {"l ", "p ", "curv", "surf"}) piece_.passed_over += rest.starts_with(word);
        }
        skip_line();
        return true;
    }

    // Up to `most` numbers; the count, or -1 where something else stands.
    int numbers(float* values, int most) {
        int n = 0;
        for (skip_blanks(); !at_end(); skip_blanks()) {
            float value = 0;
            if (!text::read_float(p_, end_, value) || !(is_blank(*p_) || *p_ == '\n' || *p_ == '#' || *p_ == '\\')) return -1;
            if (n < most) values[n] = value;
            ++n;
        }
        skip_line();
        return n;
    }

    bool vertex() {
        float value[8];
        const char* const start = p_;
        // Three numbers one blank apart and the end of the line are nearly every line; others go the general way.
        for (int k = 0; k < 3; ++k) {
            while (*p_ == ' ') ++p_;
            if (!text::read_float(p_, end_, value[k])) break;
            if (k < 2) continue;
            while (is_blank(*p_)) ++p_;
            if (*p_ != '\n') break;
            ++p_;
            piece_.positions.emplace_back(value[0], value[1], value[2]);
            return true;
        }
        p_ = start;
        const int n = numbers(value, 8);
        if (n < 3) {
            p_ = n < 0 ? p_ : start;
            return fail(n < 0 ? "a vertex has something that is no number" : "a vertex has fewer than three coordinates");
        }
        piece_.positions.emplace_back(value[0], value[1], value[2]);
        if (n >= 6) {  // three coordinates and a colour; four are homogeneous, and w is a weight of curves
            piece_.colours.resize(piece_.positions.size() - 1, Vec3f(1.0f));
            piece_.colours.emplace_back(value[3], value[4], value[5]);
        }
        return true;
    }

    bool texture_coordinate() {
        float value[3] = {0, 0, 0};
        if (numbers(value, 3) < 1) return fail("a texture coordinate has no number, or something that is none");
        piece_.uvs.emplace_back(value[0], value[1]);
        return true;
    }

    bool normal_vector() {
        float value[3];
        const int n = numbers(value, 3);
        if (n < 3) return fail("a normal has fewer than three numbers, or something that is no number");
        piece_.normals.emplace_back(value[0], value[1], value[2]);
        return true;
    }

    // The element a face names: from 1, or backwards from the last one.
    std::uint32_t resolve(std::int64_t named, Attribute attribute) {
        if (named > 0) return named <= static_cast<std::int64_t>(max_vertices) ? static_cast<std::uint32_t>(named - 1) : index_out_of_range;
        constexpr std::int64_t farthest = std::int64_t{1} << 30;
        if (named == 0 || named < -farthest) return index_out_of_range;
        piece_.relative[attribute].push_back(static_cast<std::uint32_t>(piece_.corners[attribute].size()));
        return static_cast<std::uint32_t>(static_cast<std::int32_t>(static_cast<std::int64_t>(piece_.count(attribute)) + named));
    }

    void add_corner(std::int64_t named, Attribute attribute, std::size_t place) {
        std::vector<std::uint32_t>& list = piece_.corners[attribute];
        list.resize(place, index_missing);
        const std::uint32_t index = resolve(named, attribute);
        list.push_back(index);
    }

    // "f 1 2 3", which scans consist of: three numbers from 1 on and nothing else. False, with nothing read, for any other face.
    bool plain_triangle() {
        const char* q = p_;
        std::array<std::uint32_t, 3> index;
        for (std::uint32_t& i : index) {
            while (*q == ' ') ++q;
            const char* const start = q;
            i = 0;
            for (unsigned digit; (digit = static_cast<unsigned char>(*q - '0')) < 10; ++q) i = i * 10 + digit;
            if (q == start || q - start > 9 || i == 0) return false;
            --i;
        }
        while (is_blank(*q)) ++q;
        if (*q != '\n') return false;
        p_ = q + 1;
        piece_.corners[position].insert(piece_.corners[position].end(), index.begin(), index.end());
        if (!piece_.sizes.empty()) piece_.sizes.push_back(3);
        ++piece_.faces;
        return true;
    }

    bool face() {
        if (plain_triangle()) return true;
        std::vector<std::uint32_t>& corners = piece_.corners[position];
        const std::size_t first = corners.size();
        for (skip_blanks(); !at_end(); skip_blanks()) {
            std::int64_t named = 0;
            if (!text::read_integer(p_, named)) return fail("a face has something that is no vertex number");
            const std::size_t place = corners.size();
            const std::uint32_t index = resolve(named, position);
            corners.push_back(index);
            if (*p_ == '/') {
                ++p_;
                if (text::read_integer(p_, named)) add_corner(named, uv, place);
                if (*p_ == '/') {
                    ++p_;
                    if (text::read_integer(p_, named)) add_corner(named, normal, place);
                }
            }
            if (!(is_blank(*p_) || at_end() || *p_ == '\\')) return fail("a face has something that is no vertex number");
        }
        skip_line();
        const std::size_t n = corners.size() - first;
        if (n < 3) {
            for (std::size_t a : {position, uv, normal}) {
                piece_.corners[a].resize(std::min(piece_.corners[a].size(), first));
                while (!piece_.relative[a].empty() && piece_.relative[a].back() >= first) piece_.relative[a].pop_back();
            }
            ++piece_.faults.faces_degenerate;
            return true;
        }
        if (n != 3 && piece_.sizes.empty()) piece_.sizes.assign(piece_.faces, 3);
        if (n != 3 || !piece_.sizes.empty()) piece_.sizes.push_back(static_cast<std::uint32_t>(n));
        ++piece_.faces;
        return true;
    }

    Piece& piece_;
    const char* p_;
    const char* const end_;
};

// The text as pieces that end with a newline; a last line without one is copied into `last_line`, with one.
std::vector<Piece> pieces_of(std::string_view bytes, std::string& last_line) {
    const std::size_t last = bytes.rfind('\n');
    const std::size_t whole = last == std::string_view::npos ? 0 : last + 1;
    std::size_t tail = whole;
    // A line that a backslash continues into the last one belongs with it.
    while (tail > 0 && !line_ends_at(bytes.data(), bytes.data() + tail - 1)) {
        const std::size_t before = tail >= 2 ? bytes.rfind('\n', tail - 2) : std::string_view::npos;
        tail = before == std::string_view::npos ? 0 : before + 1;
    }
    if (whole == bytes.size()) tail = whole;
    last_line.assign(bytes.substr(tail));
    last_line += '\n';

    std::vector<Piece> pieces;
    const char* const end = bytes.data() + tail;
    for (const char* begin = bytes.data(); begin < end;) {
        const char* cut = end - begin > static_cast<std::ptrdiff_t>(piece_bytes) ? begin + piece_bytes : end - 1;
        while (cut < end - 1) {
            cut = static_cast<const char*>(std::memchr(cut, '\n', static_cast<std::size_t>(end - cut)));
            if (line_ends_at(bytes.data(), cut)) break;
            ++cut;
        }
        cut = std::min(cut, end - 1);
        Piece& piece = pieces.emplace_back();
        piece.begin = begin;
        piece.end = cut + 1;
        begin = cut + 1;
    }
    if (tail < bytes.size()) {
        Piece& piece = pieces.emplace_back();
        piece.begin = last_line.data();
        piece.end = last_line.data() + last_line.size();
    }
    return pieces;
}

// Relative indices made absolute, polygons cut into triangles, broken faces left out: afterwards the corners are three per face.
void finish_faces(Piece& piece, const std::array<std::size_t, 3>& before, const std::array<std::size_t, 3>& total, std::span<const Vec3f> positions) {
    for (const std::size_t a : {position, uv, normal}) {
        for (const std::uint32_t place : piece.relative[a]) {
            const std::int64_t index = static_cast<std::int64_t>(before[a]) + static_cast<std::int32_t>(piece.corners[a][place]);
            piece.corners[a][place] = index < 0 || index >= static_cast<std::int64_t>(total[a]) ? index_out_of_range : static_cast<std::uint32_t>(index);
        }
        piece.relative[a] = {};
        if (a == position) continue;
        for (std::uint32_t& index : piece.corners[a])
            if (index != index_missing && index >= total[a]) {
                index = index_missing;
                ++piece.faults.attributes_missing;
            }
    }

    std::vector<std::uint32_t>& corners = piece.corners[position];
    if (piece.sizes.empty() && std::all_of(corners.begin(), corners.end(), [&](std::uint32_t i) { return i < total[position]; })) {
        piece.triangle_corners = corners.size();
        return;
    }
    PolygonCutter cutter;
    std::vector<std::uint32_t> places, triangles;
    std::array<std::vector<std::uint32_t>, 3> cut;
    std::size_t first = 0;
    for (std::size_t f = 0; f < piece.faces; ++f) {
        const std::size_t n = piece.sizes.empty() ? 3 : piece.sizes[f];
        triangles.clear();
        cutter.cut({corners.data() + first, n}, positions, triangles, piece.faults);
        for (const std::size_t a : {position, uv, normal})
            if (!piece.corners[a].empty())
                for (const std::uint32_t place : triangles) cut[a].push_back(piece.corners[a][first + place]);
        first += n;
    }
    piece.corners = std::move(cut);
    piece.triangle_corners = piece.corners[position].size();
    piece.sizes = {};
}

// One vertex per combination of position, texture coordinate and normal. The first combination keeps the position's own number, so
// that the order of the file survives; further ones are found in a hash table and appended in the order of the faces.
class VertexJoiner {
public:
    VertexJoiner(Mesh& mesh) : mesh_(mesh), vertices_(mesh.positions.size()), table_(1024, index_missing) {
        for (std::uint32_t v = 0; v < vertices_.size(); ++v) vertices_[v] = {v, unused, unused};
    }

    std::uint32_t vertex(std::uint32_t v, std::uint32_t uv_index, std::uint32_t normal_index) {
        if (vertices_[v].uv == unused) vertices_[v] = {v, uv_index, normal_index};
        const Combination wanted{v, uv_index, normal_index};
        if (vertices_[v] == wanted) return v;
        for (std::size_t slot = hash(wanted) & (table_.size() - 1);; slot = (slot + 1) & (table_.size() - 1)) {
            if (table_[slot] == index_missing) return add(wanted, slot);
            if (vertices_[table_[slot]] == wanted) return table_[slot];
        }
    }

    void attributes(const std::vector<Vec2f>& uvs, const std::vector<Vec3f>& normals) {
        if (!uvs.empty()) mesh_.uvs.resize(vertices_.size());
        if (!normals.empty()) mesh_.normals.resize(vertices_.size());
        for (std::size_t v = 0; v < vertices_.size(); ++v) {
            if (vertices_[v].uv < uvs.size()) mesh_.uvs[v] = uvs[vertices_[v].uv];
            if (vertices_[v].normal < normals.size()) mesh_.normals[v] = normals[vertices_[v].normal];
        }
    }

private:
    struct Combination {
        std::uint32_t position, uv, normal;
        bool operator==(const Combination&) const = default;
    };
    static constexpr std::uint32_t unused = index_out_of_range;

    // Multiply and fold (Knuth, TAOCP 6.4); the odd constants are the golden ratio's and two primes' bits.
    static std::size_t hash(const Combination& c) {
        std::uint64_t h = c.position * 0x9e3779b97f4a7c15u;
        h = (h ^ (h >> 32) ^ c.uv) * 0xd6e8feb86659fd93u;
        h = (h ^ (h >> 32) ^ c.normal) * 0xa0761d6478bd642fu;
        return static_cast<std::size_t>(h ^ (h >> 32));
    }

    std::uint32_t add(const Combination& wanted, std::size_t slot) {
        const auto added = static_cast<std::uint32_t>(vertices_.size());
        mesh_.positions.push_back(mesh_.positions[wanted.position]);
        if (!mesh_.colours.empty()) mesh_.colours.push_back(mesh_.colours[wanted.position]);
        vertices_.push_back(wanted);
        table_[slot] = added;
        if (2 * ++used_ > table_.size()) {
            std::vector<std::uint32_t> larger(4 * table_.size(), index_missing);
            for (const std::uint32_t v : table_) {
                if (v == index_missing) continue;
                std::size_t place = hash(vertices_[v]) & (larger.size() - 1);
                while (larger[place] != index_missing) place = (place + 1) & (larger.size() - 1);
                larger[place] = v;
            }
            table_ = std::move(larger);
        }
        return added;
    }

    Mesh& mesh_;
    std::vector<Combination> vertices_;
    std::vector<std::uint32_t> table_;
    std::size_t used_ = 0;
};

// Whether every corner names for its texture coordinate (normal) the same number as for its position, or none.
bool follows_position(const Piece& piece, Attribute attribute) {
    const std::vector<std::uint32_t>&named = piece.corners[attribute], &positions = piece.corners[position];
    if (named.size() != positions.size()) return false;
    for (std::size_t i = 0; i < named.size(); ++i)
        if (named[i] != positions[i]) return false;
    return true;
}

// All lists of one kind, in the order of the pieces, whose lists are given up. A list is empty or `length(piece)` long; where some
// are empty and others are not, `fill` stands in.
template <class T, class ListOf, class LengthOf>
std::vector<T> joined(std::vector<Piece>& pieces, int threads, const ListOf& list_of, const LengthOf& length_of, T fill) {
    std::vector<std::size_t> start(pieces.size() + 1, 0);
    bool any = false;
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        any |= !list_of(pieces[i]).empty();
        start[i + 1] = start[i] + length_of(pieces[i]);
    }
    std::vector<T> all(any ? start.back() : 0, fill);
    if (!any) return all;
    parallel_for(static_cast<int>(pieces.size()), 1, threads, [&](int begin, int end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
            std::vector<T>& list = list_of(pieces[i]);
            std::copy(list.begin(), list.end(), all.begin() + static_cast<std::ptrdiff_t>(start[i]));
            list = {};
        }
    });
    return all;
}

}  // namespace

Mesh parse_obj(std::string_view bytes, const std::string& file, int threads, const Forget& forget) {
    refuse_binary_text(bytes, file, "OBJ");
    std::string unix_lines;
    if (bytes.find('\n') == std::string_view::npos && bytes.find('\r') != std::string_view::npos) {
        unix_lines.assign(bytes);
        std::replace(unix_lines.begin(), unix_lines.end(), '\r', '\n');
        bytes = unix_lines;
    }
    if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);

    std::string last_line;
    std::vector<Piece> pieces = pieces_of(bytes, last_line);
    const auto count = static_cast<int>(pieces.size());
    parallel_for(count, 1, threads, [&](int begin, int end) {
        for (int i = begin; i < end; ++i) {
            Piece& piece = pieces[static_cast<std::size_t>(i)];
            PieceParser(piece).parse();
            // A text copied for its line ends, and a last line copied for want of one, are no part of the file.
            if (forget && unix_lines.empty() && piece.begin != last_line.data()) forget({piece.begin, static_cast<std::size_t>(piece.end - piece.begin)});
        }
    });

    std::array<std::size_t, 3> total{};
    std::vector<std::array<std::size_t, 3>> before(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        Piece& piece = pieces[i];
        piece.vertex_count = piece.positions.size();
        if (piece.error_at) {
            const bool in_last = piece.begin == last_line.data();
            const std::size_t at = in_last ? bytes.size() - (last_line.size() - 1) + static_cast<std::size_t>(piece.error_at - piece.begin)
                                           : static_cast<std::size_t>(piece.error_at - bytes.data());
            throw Error("read", file, line_of(bytes, std::min(at, bytes.size())) + ": " + piece.error);
        }
        before[i] = total;
        for (const std::size_t a : {position, uv, normal}) total[a] += piece.count(a);
    }
    if (total[position] == 0) throw Error("read", file, "it holds no vertex", "is it an OBJ file?");
    if (*std::max_element(total.begin(), total.end()) > max_vertices) throw Error("read", file, "it holds more than 2^32 vertices");

    Mesh mesh;
    const auto vertices_of = [](const Piece& piece) { return piece.vertex_count; };
    mesh.positions = joined(pieces, threads, [](Piece& p) -> auto& { return p.positions; }, vertices_of, Vec3f());
    mesh.colours = joined(pieces, threads, [](Piece& p) -> auto& { return p.colours; }, vertices_of, Vec3f(1.0f));
    parallel_for(count, 1, threads, [&](int begin, int end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) finish_faces(pieces[i], before[i], total, mesh.positions);
    });

    MeshFaults faults;
    std::size_t passed_over = 0, corner_count = 0;
    bool any_uv = false, any_normal = false;
    for (const Piece& piece : pieces) {
        any_uv |= !piece.corners[uv].empty();
        any_normal |= !piece.corners[normal].empty();
    }
    bool uv_follows = total[uv] <= total[position], normal_follows = total[normal] <= total[position];
    for (const Piece& piece : pieces) {
        faults += piece.faults;
        passed_over += piece.passed_over;
        corner_count += piece.corners[position].size();
        uv_follows = uv_follows && (!any_uv || follows_position(piece, uv));
        normal_follows = normal_follows && (!any_normal || follows_position(piece, normal));
    }
    if (corner_count > max_vertices) throw Error("read", file, "it holds more than 2^32 corners");
    if (passed_over > 0) mesh.notes.push_back(std::to_string(passed_over) + " lines, points or curves were passed over: only faces make a mesh.");

    std::array<std::vector<std::uint32_t>, 3> corners;
    for (const std::size_t a : {position, uv, normal})
        corners[a] = joined(pieces, threads, [a](Piece& p) -> auto& { return p.corners[a]; },
                            [](const Piece& p) { return p.triangle_corners; }, index_missing);
    std::vector<Vec2f> uvs;
    std::vector<Vec3f> normals;
    if (!corners[uv].empty())
        uvs = joined(pieces, threads, [](Piece& p) -> auto& { return p.uvs; }, [](const Piece& p) { return p.uvs.size(); }, Vec2f());
    if (!corners[normal].empty())
        normals = joined(pieces, threads, [](Piece& p) -> auto& { return p.normals; }, [](const Piece& p) { return p.normals.size(); }, Vec3f());
    if (uv_follows && normal_follows) {
        if (!uvs.empty()) uvs.resize(mesh.positions.size());
        if (!normals.empty()) normals.resize(mesh.positions.size());
        mesh.uvs = std::move(uvs);
        mesh.normals = std::move(normals);
    } else {
        VertexJoiner joiner(mesh);
        for (std::size_t i = 0; i < corners[position].size(); ++i)
            corners[position][i] = joiner.vertex(corners[position][i], corners[uv].empty() ? index_missing : corners[uv][i],
                                                 corners[normal].empty() ? index_missing : corners[normal][i]);
        joiner.attributes(uvs, normals);
    }
    mesh.indices = std::move(corners[position]);
    finish_mesh(mesh, faults, file, threads);
    return mesh;
}

}  // namespace relievo
