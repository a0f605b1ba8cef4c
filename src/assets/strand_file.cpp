#include "assets/strand_file.h"

#include "assets/atomic_file.h"
#include "core/error.h"
#include "core/parallel_for.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstring>
#include <string_view>

namespace relievo {

namespace {

static_assert(std::endian::native == std::endian::little, "both binary formats are written as they lie in memory");

template <class T>
void append_bytes(std::string& bytes, const T* data, std::size_t count) {
    bytes.append(reinterpret_cast<const char*>(data), count * sizeof(T));
}

void append(std::string& text, float value) {
    std::array<char, 32> digits;
    text += ' ';
    text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

// IEC 61966-2-1.
Vec3f encoded(Vec3f linear) {
    const auto one = [](float v) { return v <= 0.0031308f ? std::max(v, 0.0f) * 12.92f : 1.055f * std::pow(std::min(v, 1.0f), 1 / 2.4f) - 0.055f; };
    return {one(linear.x), one(linear.y), one(linear.z)};
}

[[maybe_unused]] bool whole(const StrandLines& lines) {
    std::size_t points = 0;
    for (const std::uint32_t p : lines.pieces) points += p + 1;
    return points == lines.points.size() && points == lines.radii.size() && points == lines.colours.size();
}

}  // namespace

std::string write_hair(const StrandLines& lines) {
    assert(whole(lines));
    constexpr std::uint32_t most_pieces = 65535;  // 16 bits
    struct Header {
        char signature[4] = {'H', 'A', 'I', 'R'};
        std::uint32_t strands = 0, points = 0;
        std::uint32_t arrays = 0b10111;  // pieces, points, thickness, no transparency, colours
        std::uint32_t pieces = 0;        // of strands without an entry of their own
        float thickness = 0, transparency = 0, colour[3] = {1, 1, 1};
        char information[88] = "strands of fur, in the units of the mesh they grow on; relievo";
    } header;
    static_assert(sizeof(Header) == 128);
    header.strands = static_cast<std::uint32_t>(lines.pieces.size());
    header.points = static_cast<std::uint32_t>(lines.points.size());
    std::vector<std::uint16_t> pieces;
    for (const std::uint32_t p : lines.pieces) {
        if (p > most_pieces) throw Error("write", "strands as .hair", "a strand has " + std::to_string(p) + " pieces, and the format ends at " + std::to_string(most_pieces));
        pieces.push_back(static_cast<std::uint16_t>(p));
    }
    std::vector<float> widths(lines.radii);
    for (float& w : widths) w *= 2;
    std::vector<Vec3f> colours(lines.colours);
    for (Vec3f& c : colours) c = encoded(c);
    std::string bytes;
    bytes.reserve(sizeof header + pieces.size() * 2 + lines.points.size() * 28);
    append_bytes(bytes, &header, 1);
    append_bytes(bytes, pieces.data(), pieces.size());
    append_bytes(bytes, lines.points.data(), lines.points.size());
    append_bytes(bytes, widths.data(), widths.size());
    append_bytes(bytes, colours.data(), colours.size());
    return bytes;
}

std::string write_strands_obj(const StrandLines& lines, int threads) {
    assert(whole(lines));
    constexpr std::size_t block = 1 << 14;
    std::string text = "# " + std::to_string(lines.pieces.size()) + " strands of " + std::to_string(lines.points.size()) + " points\n";
    std::vector<std::string> blocks((lines.points.size() + block - 1) / block);
    parallel_for(static_cast<int>(blocks.size()), 1, threads, [&](int first, int last) {
        for (auto b = static_cast<std::size_t>(first); b < static_cast<std::size_t>(last); ++b)
            for (std::size_t i = b * block; i < std::min(lines.points.size(), (b + 1) * block); ++i) {
                const Vec3f p = lines.points[i], c = encoded(lines.colours[i]);
                blocks[b] += 'v';
                for (const float v : {p.x, p.y, p.z}) append(blocks[b], v);
                // What 8 bits can tell.
                for (const float v : {c.x, c.y, c.z}) append(blocks[b], std::round(v * 1000) / 1000);
                blocks[b] += '\n';
            }
    });
    for (std::string& b : blocks) {
        text += b;
        b = {};
    }
    std::size_t point = 1;
    for (const std::uint32_t pieces : lines.pieces) {
        text += 'l';
        for (std::uint32_t k = 0; k <= pieces; ++k) text += ' ' + std::to_string(point++);
        text += '\n';
    }
    return text;
}

std::string write_strands_ply(const StrandLines& lines) {
    assert(whole(lines));
    const std::size_t edges = lines.points.size() - lines.pieces.size();
    std::string bytes = "ply\nformat binary_little_endian 1.0\ncomment strands of fur, each a row of edges from root to tip\nelement vertex " + std::to_string(lines.points.size()) +
                        "\nproperty float x\nproperty float y\nproperty float z\nproperty float radius\nproperty uchar red\nproperty uchar green\nproperty uchar blue\n"
                        "element edge " +
                        std::to_string(edges) + "\nproperty int vertex1\nproperty int vertex2\nend_header\n";
    bytes.reserve(bytes.size() + lines.points.size() * 19 + edges * 8);
    for (std::size_t i = 0; i < lines.points.size(); ++i) {
        append_bytes(bytes, &lines.points[i], 1);
        append_bytes(bytes, &lines.radii[i], 1);
        const Vec3f c = encoded(lines.colours[i]);
        for (const float v : {c.x, c.y, c.z}) bytes += static_cast<char>(static_cast<unsigned char>(std::lround(v * 255)));
    }
    std::uint32_t point = 0;
    for (const std::uint32_t pieces : lines.pieces) {
        for (std::uint32_t k = 0; k < pieces; ++k, ++point) {
            const std::uint32_t edge[] = {point, point + 1};
            append_bytes(bytes, edge, 2);
        }
        ++point;
    }
    return bytes;
}

void save_strands(const std::filesystem::path& file, const StrandLines& lines, int threads) {
    const std::filesystem::path ending = file.extension();
    if (ending == ".hair")
        write_file_atomically(file, write_hair(lines));
    else if (ending == ".obj")
        write_file_atomically(file, write_strands_obj(lines, threads));
    else if (ending == ".ply")
        write_file_atomically(file, write_strands_ply(lines));
    else
        throw Error("write strands to", file.string(), "its ending names no format of strands", "known: hair, obj, ply");
}

}  // namespace relievo
