#include "mesh/equal_vertices.h"

#include "core/parallel_for.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <cassert>

namespace relievo {

namespace {

constexpr std::uint32_t empty = 0xffffffff;
constexpr int grain = 16384;          // vertices per block: long enough to hide the start of a thread
constexpr std::size_t ahead = 16;     // slots asked for before the first is looked at: they lie anywhere in memory

// Adding +0 turns -0 into +0, so that numbers that compare equal hash equal.
std::uint64_t mixed(std::uint64_t hash, float value) {
    hash = (hash ^ std::bit_cast<std::uint32_t>(value + 0.0f)) * 0x9e3779b97f4a7c15ull;
    return hash ^ (hash >> 32);
}
std::uint64_t mixed(std::uint64_t hash, const Vec3f& v) { return mixed(mixed(mixed(hash, v.x), v.y), v.z); }

}  // namespace

// One open-addressing table for all threads. A slot only ever changes from empty to a vertex, or to a lower vertex equal to it, so
// whoever comes in whatever order, in the end it holds the lowest one.
std::vector<std::uint32_t> first_equal_vertex(const Mesh& mesh, Compared compared, int threads) {
    const std::size_t count = mesh.positions.size();
    assert(count < empty);
    const bool all = compared == Compared::everything;
    const bool normals = all && !mesh.normals.empty(), uvs = all && !mesh.uvs.empty(), colours = all && !mesh.colours.empty();
    const auto hash = [&](std::size_t v) {
        std::uint64_t h = mixed(0, mesh.positions[v]);
        if (normals) h = mixed(h, mesh.normals[v]);
        if (uvs) h = mixed(mixed(h, mesh.uvs[v].x), mesh.uvs[v].y);
        if (colours) h = mixed(h, mesh.colours[v]);
        return h;
    };
    const auto equal = [&](std::size_t a, std::size_t b) {
        return mesh.positions[a] == mesh.positions[b] && (!normals || mesh.normals[a] == mesh.normals[b]) &&
               (!uvs || mesh.uvs[a] == mesh.uvs[b]) && (!colours || mesh.colours[a] == mesh.colours[b]);
    };

    // A slot holds an index and, in the bits that are left above it, bits of the hash: vertices that differ are mostly told apart without
    // looking at them. At most half full: probes stay short.
    const auto index_bits = static_cast<int>(std::bit_width(count));
    const auto index_mask = static_cast<std::uint32_t>((std::uint64_t{1} << index_bits) - 1);
    const std::size_t slots = std::bit_ceil(count * 2 + 1);
    std::vector<std::uint32_t> table(slots, empty);
    std::vector<std::uint32_t> first(count);  // the slot at first, what it holds in the end
    std::atomic<bool> any_equal{false};
    parallel_for(static_cast<int>(count), grain, threads, [&](int begin, int end) {
        bool found = false;
        std::array<std::uint64_t, ahead> hashes;
        for (auto from = static_cast<std::size_t>(begin); from < static_cast<std::size_t>(end); from += ahead) {
            const std::size_t n = std::min(ahead, static_cast<std::size_t>(end) - from);
            for (std::size_t i = 0; i < n; ++i) {
                hashes[i] = hash(from + i);
                __builtin_prefetch(&table[hashes[i] & (slots - 1)], 1);
            }
            for (std::size_t i = 0; i < n; ++i) {
                const auto v = static_cast<std::uint32_t>(from + i);
                const std::uint32_t tag = static_cast<std::uint32_t>(hashes[i] >> 32 << index_bits), mine = tag | v;
                for (std::size_t slot = hashes[i] & (slots - 1);; slot = (slot + 1) & (slots - 1)) {
                    const std::atomic_ref<std::uint32_t> held(table[slot]);
                    std::uint32_t other = held.load(std::memory_order_relaxed);
                    if (other == empty && held.compare_exchange_strong(other, mine, std::memory_order_relaxed)) other = mine;
                    if (other != mine) {
                        if ((other & ~index_mask) != tag || !equal(other & index_mask, v)) continue;
                        found = true;
                        while (mine < other && !held.compare_exchange_weak(other, mine, std::memory_order_relaxed)) {}
                    }
                    first[v] = static_cast<std::uint32_t>(slot);
                    break;
                }
            }
        }
        if (found) any_equal = true;
    });
    parallel_for(static_cast<int>(count), grain, threads, [&](int begin, int end) {
        for (auto v = static_cast<std::uint32_t>(begin); v < static_cast<std::uint32_t>(end); ++v) first[v] = any_equal ? table[first[v]] & index_mask : v;
    });
    return first;
}

}  // namespace relievo
