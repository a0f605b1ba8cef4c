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
#include "assets/obj_pieces.h"

namespace relievo {

namespace {

using namespace obj;

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
    if (!any) return {};
    std::vector<T> all(start.back(), fill);
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
            parse(piece);
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
    if (total[position] == 0) throw Error("read", file, end_of(bytes.size()) + "it holds no vertex", "is it an OBJ file?");
    if (*std::max_element(total.begin(), total.end()) > max_vertices) throw Error("read", file, end_of(bytes.size()) + "it holds more than 2^32 vertices");

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
    if (corner_count > max_vertices) throw Error("read", file, end_of(bytes.size()) + "it holds more than 2^32 corners");
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
    finish_mesh(mesh, faults, bytes.size(), file, threads);
    return mesh;
}

}  // namespace relievo
