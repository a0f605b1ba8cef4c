#include "assets/mesh_assembly.h"

#include "core/error.h"
#include "core/parallel_for.h"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "assets/triangulate.h"

namespace relievo {

namespace {

// Elements per block: enough to outweigh the start of a block, few enough for two threads to finish together.
constexpr int block = 1 << 15;

bool finite(Vec3f p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); }

// Calls body(begin, end) for blocks of [0, count).
template <class Body>
void for_blocks(std::size_t count, int threads, const Body& body) {
    const std::size_t blocks = (count + block - 1) / block;
    parallel_for(static_cast<int>(blocks), 1, threads, [&](int first, int last) {
        body(static_cast<std::size_t>(first) * block, std::min(count, static_cast<std::size_t>(last) * block));
    });
}

template <class T>
void keep_only(std::vector<T>& values, const std::vector<std::uint32_t>& place) {
    if (values.empty()) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        if (place[i] != index_missing) values[kept++] = values[i];
    values.resize(kept);
}

void drop_non_finite_vertices(Mesh& mesh, MeshFaults& faults) {
    std::vector<std::uint32_t> place(mesh.positions.size());
    std::uint32_t next = 0;
    for (std::size_t i = 0; i < place.size(); ++i) place[i] = finite(mesh.positions[i]) ? next++ : index_missing;
    faults.vertices_non_finite += place.size() - next;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t a = place[mesh.indices[i]], b = place[mesh.indices[i + 1]], c = place[mesh.indices[i + 2]];
        if (a == index_missing || b == index_missing || c == index_missing) {
            ++faults.faces_non_finite;
            continue;
        }
        mesh.indices[kept++] = a, mesh.indices[kept++] = b, mesh.indices[kept++] = c;
    }
    mesh.indices.resize(kept);
    keep_only(mesh.positions, place);
    keep_only(mesh.normals, place);
    keep_only(mesh.uvs, place);
    keep_only(mesh.colours, place);
}

void drop_repeating_faces(Mesh& mesh, MeshFaults& faults) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
        if (a == b || b == c || c == a) continue;
        mesh.indices[kept++] = a, mesh.indices[kept++] = b, mesh.indices[kept++] = c;
    }
    faults.faces_degenerate += (mesh.indices.size() - kept) / 3;
    mesh.indices.resize(kept);
}

// Lengths within rounding of 1 stay as they are, so that files come back bit by bit; others are no promise of the format.
Vec3f unit(Vec3f n) {
    if (!finite(n)) return Vec3f(0.0f);
    const Vec3d wide(n);
    const double square = dot(wide, wide);
    if (std::abs(square - 1) < 1e-5) return n;
    return square > 0 ? Vec3f(wide / std::sqrt(square)) : Vec3f(0.0f);
}

void confine_colours(Mesh& mesh, MeshFaults& faults) {
    float brightest = 0;
    for (Vec3f& c : mesh.colours) {
        if (!finite(c)) {
            ++faults.colours_non_finite;
            c = Vec3f(-1.0f);  // white, once the scale is known
        }
        brightest = std::max({brightest, c.x, c.y, c.z});
    }
    // Some programs write bytes where the format means shares.
    const float scale = brightest > 1.0f ? 1.0f / 255.0f : 1.0f;
    if (scale != 1.0f) mesh.notes.push_back("The vertex colours reach " + std::to_string(brightest) + ": they were taken for values of 0 to 255.");
    for (Vec3f& c : mesh.colours)
        c = c.x == -1.0f && c.y == -1.0f && c.z == -1.0f ? Vec3f(1.0f)
            : Vec3f(std::clamp(c.x * scale, 0.0f, 1.0f), std::clamp(c.y * scale, 0.0f, 1.0f), std::clamp(c.z * scale, 0.0f, 1.0f));
}

std::string counted(std::size_t n, const char* one, const char* many) { return std::to_string(n) + " " + (n == 1 ? one : many); }

}  // namespace

MeshFaults& MeshFaults::operator+=(const MeshFaults& other) {
    faces_out_of_range += other.faces_out_of_range;
    faces_degenerate += other.faces_degenerate;
    faces_non_finite += other.faces_non_finite;
    polygons_unclean += other.polygons_unclean;
    attributes_missing += other.attributes_missing;
    vertices_non_finite += other.vertices_non_finite;
    colours_non_finite += other.colours_non_finite;
    return *this;
}

void MeshFaults::describe(std::vector<std::string>& notes) const {
    const auto say = [&](std::size_t n, const char* one, const char* many, const char* rest) {
        if (n > 0) notes.push_back(counted(n, one, many) + rest);
    };
    say(faces_out_of_range, "face was skipped: it names a vertex", "faces were skipped: they name vertices", " that the file does not hold.");
    say(faces_degenerate, "face was skipped: it has", "faces were skipped: they have", " fewer than three distinct vertices.");
    say(vertices_non_finite, "vertex was left out: its position is", "vertices were left out: their positions are", " not finite.");
    say(faces_non_finite, "face was skipped: it touches", "faces were skipped: they touch", " a vertex whose position is not finite.");
    say(polygons_unclean, "polygon crosses itself or has", "polygons cross themselves or have", " no area: the cut into triangles is arbitrary.");
    say(attributes_missing, "corner names", "corners name", " a normal or texture coordinate that the file does not hold: taken for none.");
    say(colours_non_finite, "vertex colour is", "vertex colours are", " not finite: taken for white.");
}

void PolygonCutter::cut(std::span<const std::uint32_t> corners, std::span<const Vec3f> positions, std::vector<std::uint32_t>& triangles,
                        MeshFaults& faults) {
    places_.clear();
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (corners[i] >= positions.size()) {
            ++faults.faces_out_of_range;
            return;
        }
        if (!places_.empty() && corners[places_.back()] == corners[i]) continue;
        places_.push_back(static_cast<std::uint32_t>(i));
    }
    while (places_.size() > 1 && corners[places_.front()] == corners[places_.back()]) places_.pop_back();
    if (places_.size() < 3) {
        ++faults.faces_degenerate;
        return;
    }
    outline_.clear();
    for (const std::uint32_t place : places_) {
        outline_.push_back(positions[corners[place]]);
        if (!finite(outline_.back())) {
            ++faults.faces_non_finite;
            return;
        }
    }
    cut_.clear();
    if (!triangulate(outline_, cut_)) ++faults.polygons_unclean;
    bool any = false;
    for (std::size_t i = 0; i < cut_.size(); i += 3) {
        const std::uint32_t a = places_[cut_[i]], b = places_[cut_[i + 1]], c = places_[cut_[i + 2]];
        // An outline may touch a vertex twice (a hole joined by a slit); a triangle may not.
        if (corners[a] == corners[b] || corners[b] == corners[c] || corners[c] == corners[a]) continue;
        triangles.insert(triangles.end(), {a, b, c});
        any = true;
    }
    if (!any) ++faults.faces_degenerate;
}

void finish_mesh(Mesh& mesh, MeshFaults faults, std::size_t bytes, const std::string& file, int threads) {
    std::atomic<bool> all_finite{true}, all_distinct{true};
    for_blocks(mesh.positions.size(), threads, [&](std::size_t begin, std::size_t end) {
        // Zero times anything finite is zero, and NaN otherwise: one sum tells for the whole block.
        float sum = 0;
        for (std::size_t i = begin; i < end; ++i) sum += (mesh.positions[i].x + mesh.positions[i].y + mesh.positions[i].z) * 0.0f;
        bool good = sum == 0;
        if (!good) good = std::all_of(mesh.positions.begin() + static_cast<std::ptrdiff_t>(begin), mesh.positions.begin() + static_cast<std::ptrdiff_t>(end), finite);
        if (!good) all_finite = false;
    });
    for_blocks(mesh.faces(), threads, [&](std::size_t begin, std::size_t end) {
        bool distinct = true;
        for (std::size_t i = 3 * begin; i < 3 * end; i += 3) {
            const std::uint32_t a = mesh.indices[i], b = mesh.indices[i + 1], c = mesh.indices[i + 2];
            distinct &= (a != b) & (b != c) & (c != a);
        }
        if (!distinct) all_distinct = false;
    });
    if (!all_finite) drop_non_finite_vertices(mesh, faults);
    if (!all_distinct) drop_repeating_faces(mesh, faults);
    for_blocks(mesh.normals.size(), threads, [&](std::size_t begin, std::size_t end) {
        // Most are unit vectors already and need neither the wider numbers nor to be written.
        for (std::size_t i = begin; i < end; ++i)
            if (!(std::abs(dot(mesh.normals[i], mesh.normals[i]) - 1.0f) < 1e-6f)) mesh.normals[i] = unit(mesh.normals[i]);
    });
    for (Vec2f& uv : mesh.uvs)
        if (!std::isfinite(uv.x) || !std::isfinite(uv.y)) uv = Vec2f(0.0f);
    confine_colours(mesh, faults);
    faults.describe(mesh.notes);

    if (mesh.indices.empty()) {
        std::string why = end_of(bytes) + "it holds " + counted(mesh.positions.size(), "vertex", "vertices") + " and no face";
        if (!mesh.notes.empty()) why += '.';
        for (const std::string& note : mesh.notes) why += ' ' + note;
        throw Error("read", file, why);
    }
}

void refuse_binary_text(std::string_view bytes, const std::string& file, const std::string& format) {
    const std::string_view start = bytes.substr(0, 4096);
    const std::size_t zero = start.find('\0');
    if (start.starts_with("\xfe\xff") || start.starts_with("\xff\xfe"))
        throw Error("read", file, "byte 0: it is text in UTF-16", "save it as UTF-8 or ASCII");
    if (zero != std::string_view::npos) throw Error("read", file, "byte " + std::to_string(zero) + " is 0: it is no " + format + " text");
}

std::string end_of(std::size_t bytes) { return "byte " + std::to_string(bytes) + ", its end: "; }

std::string line_of(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, byte);
    // A file of an old Macintosh ends its lines with carriage returns alone.
    const char end = text.find('\n') == std::string_view::npos ? '\r' : '\n';
    return "line " + std::to_string(1 + std::count(before.begin(), before.end(), end));
}

}  // namespace relievo
