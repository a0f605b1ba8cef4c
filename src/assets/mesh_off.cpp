// OFF (Geomview): a keyword whose letters say what a vertex carries, three counts, vertices, faces. Numbers may be spread over lines
// at will, but what follows a face's corners on its line is its colour, and vertices often carry colours unannounced.
#include "core/error.h"

#include <algorithm>
#include <array>
#include <string>

#include "assets/mesh_assembly.h"
#include "assets/mesh_formats.h"
#include "assets/polygon_list.h"
#include "assets/text_number.h"

namespace relievo {

namespace {

class OffParser {
public:
    // `bytes` ends with a newline.
    OffParser(std::string_view bytes, const std::string& file) : bytes_(bytes), p_(bytes.data()), end_(bytes.data() + bytes.size()), file_(file) {}

    Mesh parse(int threads) {
        keyword();
        const std::uint64_t vertices = count("vertices"), faces = count("faces");
        if (std::int64_t edges = 0; more_on_line() && !text::read_integer(p_, edges)) fail("the count of edges is no number");
        // A vertex is three digits and three separators at least, a face two of each.
        const auto room = static_cast<std::uint64_t>(end_ - p_);
        if (vertices > room / 6 + 1 || faces > room / 2 + 1)
            fail("it promises " + std::to_string(vertices) + " vertices and " + std::to_string(faces) + " faces, more than " + std::to_string(room) + " bytes hold");
        Mesh mesh;
        read_vertices(mesh, static_cast<std::size_t>(vertices));
        PolygonList polygons;
        for (std::uint64_t f = 0; f < faces; ++f) read_face(polygons);
        MeshFaults faults;
        mesh.indices = triangles_of(std::move(polygons), mesh.positions, faults, threads);
        finish_mesh(mesh, faults, bytes_.size(), file_, threads);
        return mesh;
    }

private:
    [[noreturn]] void fail(const std::string& why) const {
        throw Error("read", file_, line_of(bytes_, static_cast<std::size_t>(std::min(p_, end_ - 1) - bytes_.data())) + ": " + why);
    }

    void skip_comment() {
        while (*p_ != '\n') ++p_;
    }

    // To the next number, on this line or a later one.
    void skip_to_number() {
        for (;;) {
            while (p_ < end_ && (text::is_blank(*p_) || *p_ == '\n')) ++p_;
            if (p_ == end_) fail("it ends in the middle of its vertices or faces");
            if (*p_ != '#') return;
            skip_comment();
        }
    }

    bool more_on_line() {
        while (p_ < end_ && text::is_blank(*p_)) ++p_;
        return p_ < end_ && *p_ != '\n' && *p_ != '#';
    }

    float number() {
        skip_to_number();
        float value = 0;
        if (!text::read_float(p_, end_, value)) fail("something that is no number");
        return value;
    }

    std::int64_t integer() {
        skip_to_number();
        std::int64_t value = 0;
        if (!text::read_integer(p_, value)) fail("something that is no whole number");
        return value;
    }

    std::uint64_t count(const char* of) {
        const std::int64_t n = integer();
        if (n < 0) fail(std::string("the count of ") + of + " is negative");
        return static_cast<std::uint64_t>(n);
    }

    // [ST][C][N][4][n]OFF, or no keyword at all.
    void keyword() {
        skip_to_number();
        const char* q = p_;
        while (q < end_ && !text::is_blank(*q) && *q != '\n' && *q != '#') ++q;
        std::string_view word(p_, static_cast<std::size_t>(q - p_));
        if (!word.ends_with("OFF")) return;
        p_ = q;
        word.remove_suffix(3);
        const auto take = [&](std::string_view letters) {
            const bool there = word.starts_with(letters);
            if (there) word.remove_prefix(letters.size());
            return there;
        };
        has_uv_ = take("ST");
        has_colour_ = take("C");
        has_normal_ = take("N");
        if (!word.empty()) fail("its points have other than three dimensions (" + std::string(word) + "OFF)");
        if (more_on_line() && std::string_view(p_, static_cast<std::size_t>(end_ - p_)).starts_with("BINARY")) fail("it is the binary form of OFF, which is not read here");
    }

    void read_vertices(Mesh& mesh, std::size_t n) {
        mesh.positions.reserve(n);
        if (has_normal_) mesh.normals.reserve(n);
        for (std::size_t i = 0; i < n; ++i) {
            Vec3f p;
            p.x = number(), p.y = number(), p.z = number();
            mesh.positions.push_back(p);
            if (has_normal_) {
                Vec3f& normal = mesh.normals.emplace_back();
                normal.x = number(), normal.y = number(), normal.z = number();
            }
            // How many numbers a colour has, three or four, only the line tells; texture coordinates come last.
            std::array<float, 6> rest{};
            std::size_t given = 0;
            bool real = false;
            while (more_on_line()) {
                const char* const start = p_;
                const float value = number();
                real |= std::string_view(start, static_cast<std::size_t>(p_ - start)).find_first_of(".eE") != std::string_view::npos;
                if (given < rest.size()) rest[given] = value;
                ++given;
            }
            given = std::min(given, rest.size());
            if (has_uv_ && given >= 2) {
                mesh.uvs.resize(i);
                mesh.uvs.emplace_back(rest[given - 2], rest[given - 1]);
                given -= 2;
            }
            if (given == 3 || given == 4) {
                if (!has_colour_ && i > 0 && mesh.colours.empty()) continue;
                const Vec3f colour(rest[0], rest[1], rest[2]);
                mesh.colours.resize(i, Vec3f(1.0f));
                mesh.colours.push_back(real ? colour : colour / 255.0f);  // whole numbers go up to 255, others to 1
            }
        }
        if (!mesh.uvs.empty()) mesh.uvs.resize(n);
        if (!mesh.colours.empty()) mesh.colours.resize(n, Vec3f(1.0f));
    }

    void read_face(PolygonList& polygons) {
        const std::int64_t n = integer();
        if (n < 0 || n > end_ - p_) fail("a face promises " + std::to_string(n) + " corners");
        for (std::int64_t k = 0; k < n; ++k) polygons.corners.push_back(index_from(integer()));
        polygons.close(static_cast<std::size_t>(n));
        skip_comment();  // the colour
    }

    std::string_view bytes_;
    const char* p_;
    const char* const end_;
    const std::string& file_;
    bool has_uv_ = false, has_colour_ = false, has_normal_ = false;
};

}  // namespace

Mesh parse_off(std::string_view bytes, const std::string& file, int threads) {
    if (bytes.substr(0, 200).find("BINARY") == std::string_view::npos) refuse_binary_text(bytes, file, "OFF");
    std::string copy;
    const bool lone_returns = bytes.find('\n') == std::string_view::npos;
    if (bytes.empty() || bytes.back() != '\n' || lone_returns) {
        copy.assign(bytes);
        if (lone_returns) std::replace(copy.begin(), copy.end(), '\r', '\n');
        copy += '\n';
        bytes = copy;
    }
    return OffParser(bytes, file).parse(threads);
}

}  // namespace relievo
