// STL, text or binary. Both may begin with "solid"; only the size of a binary file can be relied on: 84 bytes and 50 per triangle.
// Every triangle brings three vertices of its own; joining them is left to indexing. Its normal is left out: it follows from them.
#include "core/error.h"
#include "core/parallel_for.h"

#include <algorithm>
#include <bit>
#include <string>

#include "assets/mesh_assembly.h"
#include "assets/mesh_formats.h"
#include "assets/polygon_list.h"
#include "assets/text_number.h"

namespace relievo {

namespace {

constexpr std::size_t header_bytes = 84, triangle_bytes = 50;

std::uint32_t promised_triangles(std::string_view bytes) {
    // Little-endian, as the three floats of every corner are.
    std::uint32_t n = 0;
    for (std::size_t i = 4; i-- > 0;) n = n << 8 | static_cast<unsigned char>(bytes[80 + i]);
    return n;
}

float little_float(const char* at) {
    std::uint32_t bits = 0;
    for (std::size_t i = 4; i-- > 0;) bits = bits << 8 | static_cast<unsigned char>(at[i]);
    return std::bit_cast<float>(bits);
}

bool is_binary(std::string_view bytes) {
    if (bytes.size() < header_bytes) return false;
    if (bytes.size() == header_bytes + promised_triangles(bytes) * triangle_bytes) return true;
    // Cut short or followed by something: binary if it is no text.
    const std::string_view start = bytes.substr(0, 1024);
    return start.find('\0') != std::string_view::npos || start.find("facet") == std::string_view::npos;
}

Mesh parse_binary(std::string_view bytes, const std::string& file, int threads) {
    const std::uint32_t promised = promised_triangles(bytes);
    const std::size_t held = (bytes.size() - header_bytes) / triangle_bytes;
    if (promised > held)
        throw Error("read", file, "byte 80: its header promises " + std::to_string(promised) + " triangles, its " + std::to_string(bytes.size()) + " bytes hold " + std::to_string(held),
                    "copy the file again");
    Mesh mesh;
    if (bytes.size() != header_bytes + promised * triangle_bytes)
        mesh.notes.push_back(std::to_string(bytes.size() - header_bytes - promised * triangle_bytes) + " bytes behind the last triangle were passed over.");
    const std::size_t corners = std::size_t{promised} * 3;
    if (corners > max_vertices) throw Error("read", file, end_of(bytes.size()) + "it holds more than 2^32 corners");
    mesh.positions.resize(corners);
    mesh.indices.resize(corners);
    constexpr std::size_t block = 1 << 13;
    parallel_for(static_cast<int>((promised + block - 1) / block), 1, threads, [&](int first, int last) {
        for (std::size_t t = static_cast<std::size_t>(first) * block; t < std::min<std::size_t>(promised, static_cast<std::size_t>(last) * block); ++t) {
            const char* at = bytes.data() + header_bytes + t * triangle_bytes + 12;  // behind the normal
            for (std::size_t k = 3 * t; k < 3 * t + 3; ++k, at += 12) {
                mesh.positions[k] = Vec3f(little_float(at), little_float(at + 4), little_float(at + 8));
                mesh.indices[k] = static_cast<std::uint32_t>(k);
            }
        }
    });
    finish_mesh(mesh, {}, bytes.size(), file, threads);
    return mesh;
}

// `bytes` ends with a newline.
Mesh parse_text(std::string_view bytes, const std::string& file, int threads) {
    Mesh mesh;
    PolygonList polygons;
    std::size_t open = 0;  // vertices since the last loop
    const char* const end = bytes.data() + bytes.size();
    const auto fail = [&](const char* at, const std::string& why) { return Error("read", file, line_of(bytes, static_cast<std::size_t>(at - bytes.data())) + ": " + why); };
    const auto is = [&](std::string_view word, std::string_view known) {
        return std::equal(word.begin(), word.end(), known.begin(), known.end(), [](char a, char b) { return (a | 32) == b; });
    };
    for (const char* p = bytes.data(); p < end; ++p) {
        while (text::is_blank(*p)) ++p;
        const char* const start = p;
        while (!text::is_blank(*p) && *p != '\n') ++p;
        const std::string_view word(start, static_cast<std::size_t>(p - start));
        if (is(word, "vertex")) {
            Vec3f position;
            for (float* value : {&position.x, &position.y, &position.z}) {
                while (text::is_blank(*p)) ++p;
                if (!text::read_float(p, end, *value)) throw fail(p, "a vertex has fewer than three numbers, or something that is no number");
            }
            if (mesh.positions.size() >= max_vertices) throw Error("read", file, end_of(bytes.size()) + "it holds more than 2^32 corners");
            polygons.corners.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
            mesh.positions.push_back(position);
            ++open;
        } else if (is(word, "endloop")) {
            polygons.close(open);
            open = 0;
        } else if (!word.empty() && !is(word, "facet") && !is(word, "outer") && !is(word, "endfacet") && !is(word, "solid") && !is(word, "endsolid") &&
                   !is(word, "color")) {
            throw fail(start, "it begins with none of STL's words");
        }
        while (*p != '\n') ++p;
    }
    if (open > 0) throw fail(end - 1, "it ends in the middle of a triangle");
    MeshFaults faults;
    mesh.indices = triangles_of(std::move(polygons), mesh.positions, faults, threads);
    finish_mesh(mesh, faults, bytes.size(), file, threads);
    return mesh;
}

}  // namespace

Mesh parse_stl(std::string_view bytes, const std::string& file, int threads) {
    if (is_binary(bytes)) return parse_binary(bytes, file, threads);
    refuse_binary_text(bytes, file, "STL");
    std::string copy;
    if (bytes.empty() || bytes.back() != '\n' || bytes.find('\n') == bytes.size() - 1) {
        copy.assign(bytes);
        if (copy.find('\n') == std::string::npos) std::replace(copy.begin(), copy.end(), '\r', '\n');
        copy += '\n';
        bytes = copy;
    }
    return parse_text(bytes, file, threads);
}

}  // namespace relievo
