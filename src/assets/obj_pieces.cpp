#include "assets/obj_pieces.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <limits>

#include "assets/text_number.h"

namespace relievo::obj {

namespace {

using text::is_blank;

// Bytes per piece: small enough for two threads to finish together on a file of some megabytes, large enough for a piece's
// lists to be worth it.
constexpr std::size_t piece_bytes = 1 << 19;

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
        // A piece mostly holds one kind of line, that of its first. There is room for the shortest lines of large meshes, and what is not needed is given back.
        if (*p_ == 'v') piece_.positions.reserve(bytes / 18);
        if (*p_ == 'f') piece_.corners[position].reserve(bytes / 5);
        while (p_ < end_) {
            if (!line()) {
                piece_.error_at = std::min(p_, end_ - 1);
                return;
            }
        }
        for (std::size_t a : {uv, normal})
            if (!piece_.corners[a].empty()) piece_.corners[a].resize(piece_.corners[position].size(), index_missing);
        if (!piece_.colours.empty()) piece_.colours.resize(piece_.positions.size(), Vec3f(1.0f));
        piece_.positions.shrink_to_fit();
        piece_.corners[position].shrink_to_fit();
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

}  // namespace

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

void parse(Piece& piece) { PieceParser(piece).parse(); }

}  // namespace relievo::obj
