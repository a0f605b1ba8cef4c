// Our own file of a prepared mesh, to be reopened at once. Little-endian; every array begins at a multiple of 16 bytes and lies as
// it lies in memory:
//
//   byte   0  "relievo mesh" and four bytes 0
//         16  version (u32), 1
//         20  which attributes follow (u32): 1 normals, 2 uvs, 4 colours
//         24  vertices (u64)
//         32  indices (u64), three per face
//         40  bytes of the name (u32), bytes of the notes (u32; one note a line)
//         48  checksum of bytes 0..47 and of everything from byte 64 on (u64)
//         56  0 (u64)
//         64  positions 3 x f32 | normals 3 x f32 | uvs 2 x f32 | colours 3 x f32 | indices u32 | name | notes
//
// The checksum is against accidents. What a file claims is checked all the same: sizes before anything is allocated, indices and
// positions as for every other format.
#include "core/error.h"
#include "core/parallel_for.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cstring>
#include <string>

#include "assets/mesh_assembly.h"
#include "assets/mesh_formats.h"

static_assert(std::endian::native == std::endian::little, "arrays are copied as they lie in memory");

namespace relievo {

namespace {

constexpr std::string_view magic("relievo mesh\0\0\0\0", 16);
constexpr std::uint32_t version = 1;

struct Header {
    std::array<char, 16> magic{};
    std::uint32_t version = 0, attributes = 0;
    std::uint64_t vertices = 0, indices = 0;
    std::uint32_t name_bytes = 0, note_bytes = 0;
    std::uint64_t checksum = 0, reserved = 0;
};
static_assert(sizeof(Header) == 64);
constexpr std::size_t checked_header_bytes = 48;

constexpr std::uint32_t with_normals = 1, with_uvs = 2, with_colours = 4;

std::uint64_t padded(std::uint64_t bytes) { return (bytes + 15) & ~std::uint64_t{15}; }

// Where the parts begin.
struct Layout {
    std::uint64_t positions, normals, uvs, colours, indices, name, notes, end;
    explicit Layout(const Header& h) {
        positions = sizeof(Header);
        normals = positions + padded(12 * h.vertices);
        uvs = normals + (h.attributes & with_normals ? padded(12 * h.vertices) : 0);
        colours = uvs + (h.attributes & with_uvs ? padded(8 * h.vertices) : 0);
        indices = colours + (h.attributes & with_colours ? padded(12 * h.vertices) : 0);
        name = indices + padded(4 * h.indices);
        notes = name + h.name_bytes;
        end = notes + h.note_bytes;
    }
};

// Four independent lanes of multiply and rotate (after xxHash's structure), so that the multiplier's latency is hidden.
std::uint64_t checksum_of(std::string_view bytes, std::uint64_t seed) {
    constexpr std::uint64_t prime = 0x9e3779b185ebca87u;
    std::array<std::uint64_t, 4> lane = {seed + 1, seed + 2, seed + 3, seed + 4};
    std::size_t i = 0;
    for (; i + 32 <= bytes.size(); i += 32)
        for (std::size_t k = 0; k < 4; ++k) {
            std::uint64_t word = 0;
            std::memcpy(&word, bytes.data() + i + 8 * k, 8);
            lane[k] = std::rotl(lane[k] ^ (word * prime), 31) * prime;
        }
    std::uint64_t sum = bytes.size();
    for (; i < bytes.size(); ++i) sum = (sum ^ static_cast<unsigned char>(bytes[i])) * prime;
    for (const std::uint64_t l : lane) sum = std::rotl(sum ^ (l * prime), 27) * prime;
    return sum ^ (sum >> 29);
}

// Of blocks, each by any thread, and of their sums.
std::uint64_t checksum_of_blocks(std::string_view bytes, std::string_view header, int threads) {
    constexpr std::size_t block = 1 << 20;
    std::vector<std::uint64_t> sums((bytes.size() + block - 1) / block + 1);
    sums.back() = checksum_of(header, 0);
    parallel_for(static_cast<int>(sums.size()) - 1, 1, threads, [&](int begin, int end) {
        for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) sums[i] = checksum_of(bytes.substr(i * block, block), i);
    });
    return checksum_of({reinterpret_cast<const char*>(sums.data()), 8 * sums.size()}, 0);
}

template <class T>
void copy_out(std::string_view bytes, std::uint64_t at, std::uint64_t count, std::vector<T>& values) {
    const char* const from = bytes.data() + at;
    values.reserve(static_cast<std::size_t>(count));
    if (reinterpret_cast<std::uintptr_t>(from) % alignof(T) == 0) {
        // In one go: filling a vector with zeros first would take as long again.
        const T* const first = reinterpret_cast<const T*>(from);
        values.assign(first, first + count);
        return;
    }
    values.resize(static_cast<std::size_t>(count));
    std::memcpy(values.data(), from, values.size() * sizeof(T));
}

template <class T>
void copy_in(std::string& bytes, std::uint64_t at, const std::vector<T>& values) {
    if (!values.empty()) std::memcpy(bytes.data() + at, values.data(), values.size() * sizeof(T));
}

}  // namespace

bool is_mesh_cache(std::string_view bytes) { return bytes.starts_with(magic.substr(0, 12)); }

std::string write_mesh_cache(const Mesh& mesh, int threads) {
    std::string notes;
    for (const std::string& note : mesh.notes) {
        notes += note;
        notes += '\n';
    }
    Header header;
    std::memcpy(header.magic.data(), magic.data(), magic.size());
    header.version = version;
    header.attributes = (mesh.normals.empty() ? 0 : with_normals) | (mesh.uvs.empty() ? 0 : with_uvs) | (mesh.colours.empty() ? 0 : with_colours);
    header.vertices = mesh.positions.size();
    header.indices = mesh.indices.size();
    header.name_bytes = static_cast<std::uint32_t>(mesh.name.size());
    header.note_bytes = static_cast<std::uint32_t>(notes.size());
    const Layout layout(header);
    std::string bytes(static_cast<std::size_t>(layout.end), '\0');
    copy_in(bytes, layout.positions, mesh.positions);
    copy_in(bytes, layout.normals, mesh.normals);
    copy_in(bytes, layout.uvs, mesh.uvs);
    copy_in(bytes, layout.colours, mesh.colours);
    copy_in(bytes, layout.indices, mesh.indices);
    std::copy(mesh.name.begin(), mesh.name.end(), bytes.begin() + static_cast<std::ptrdiff_t>(layout.name));
    std::copy(notes.begin(), notes.end(), bytes.begin() + static_cast<std::ptrdiff_t>(layout.notes));
    std::memcpy(bytes.data(), &header, sizeof(Header));
    seal_mesh_cache(bytes, threads);
    return bytes;
}

void seal_mesh_cache(std::string& bytes, int threads) {
    assert(bytes.size() >= sizeof(Header));
    const std::string_view all(bytes);
    const std::uint64_t checksum = checksum_of_blocks(all.substr(sizeof(Header)), all.substr(0, checked_header_bytes), threads);
    std::memcpy(bytes.data() + checked_header_bytes, &checksum, sizeof(checksum));
}

Mesh parse_mesh_cache(std::string_view bytes, const std::string& file, int threads) {
    const auto damaged = [&](const std::string& why) { return Error("read", file, why, "make it again from the mesh it was made of"); };
    Header header;
    if (bytes.size() < sizeof(Header)) throw damaged("it ends at byte " + std::to_string(bytes.size()) + ", within its header");
    std::memcpy(&header, bytes.data(), sizeof(Header));
    if (std::string_view(header.magic.data(), 16) != magic) throw damaged("byte 0: it is no mesh cache of relievo");
    if (header.version != version) throw damaged("byte 16: it is of version " + std::to_string(header.version) + ", read is version " + std::to_string(version));
    if (header.attributes > 7) throw damaged("byte 20: it holds attributes unknown to this version");
    if (header.vertices > max_vertices || header.indices > 3 * std::uint64_t{max_vertices} || header.indices % 3 != 0)
        throw damaged("byte 24: its counts of vertices and indices are absurd");
    const Layout layout(header);
    if (layout.end != bytes.size())
        throw damaged("byte 24: its header promises " + std::to_string(layout.end) + " bytes, it has " + std::to_string(bytes.size()));
    if (header.checksum != checksum_of_blocks(bytes.substr(sizeof(Header)), bytes.substr(0, checked_header_bytes), threads))
        throw damaged("byte 48: the checksum does not fit the content");

    Mesh mesh;
    // The indices are half of a scan: one thread's work, while another copies the vertices.
    bool in_range = true;
    parallel_for(2, 1, threads, [&](int begin, int end) {
        for (int part = begin; part < end; ++part) {
            if (part == 0) {
                copy_out(bytes, layout.indices, header.indices, mesh.indices);
                // Below 2^31 vertices the highest bit of a difference tells: a sum of bits, which vectors of any machine can do.
                const auto last = static_cast<std::uint32_t>(header.vertices - 1);
                std::uint32_t below = 0, too_large = 0;
                for (const std::uint32_t i : mesh.indices) {
                    below |= last - i;
                    too_large |= i;
                }
                in_range = header.vertices > 0 && ((below | too_large) >> 31) == 0;
                if (!in_range && header.vertices > (std::uint64_t{1} << 31)) in_range = std::ranges::all_of(mesh.indices, [&](std::uint32_t i) { return i < header.vertices; });
                in_range = in_range || mesh.indices.empty();
                continue;
            }
            copy_out(bytes, layout.positions, header.vertices, mesh.positions);
            if (header.attributes & with_normals) copy_out(bytes, layout.normals, header.vertices, mesh.normals);
            if (header.attributes & with_uvs) copy_out(bytes, layout.uvs, header.vertices, mesh.uvs);
            if (header.attributes & with_colours) copy_out(bytes, layout.colours, header.vertices, mesh.colours);
        }
    });
    if (!in_range) throw damaged("byte " + std::to_string(layout.indices) + " and after: an index is out of range");
    mesh.name = bytes.substr(static_cast<std::size_t>(layout.name), header.name_bytes);
    for (std::string_view notes = bytes.substr(static_cast<std::size_t>(layout.notes)); !notes.empty();) {
        const std::size_t end = std::min(notes.find('\n'), notes.size() - 1);
        mesh.notes.emplace_back(notes.substr(0, end));
        notes.remove_prefix(end + 1);
    }
    finish_mesh(mesh, {}, bytes.size(), file, threads);
    return mesh;
}

}  // namespace relievo
