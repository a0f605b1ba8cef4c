#include "pipeline/map_cache.h"

#include "assets/atomic_file.h"
#include "core/error.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace relievo {

namespace {

namespace fs = std::filesystem;

// A file is this header, then the texels as 32-bit floats; both in the machine's byte order, which the first word tells apart.
struct Header {
    std::uint32_t magic = 0x31434d52;  // "RMC1" in little-endian order
    std::uint32_t width = 0, height = 0, channels = 0;
    Digest key{};       // of everything that decides the texels
    Digest checksum{};  // of the words above and the texels
};
static_assert(sizeof(Header) == 80);

constexpr std::string_view ending = ".map";

Digest digest_of(const MapKey& key) {
    std::string text(key.map_id);
    text += '\n' + std::to_string(key.baker_version) + '\n' + std::to_string(key.width) + 'x' + std::to_string(key.height) + '\n' + hex(key.content);
    return sha256(std::as_bytes(std::span(text)));
}

Digest checksum_of(Header header, const ImageF& map) {
    header.checksum = content_digest(std::as_bytes(std::span(map.texels)));
    return sha256(std::as_bytes(std::span(&header, 1)));
}

}  // namespace

std::optional<fs::path> MapCache::default_folder() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return fs::path(value ? value : "");
    };
    if (const fs::path ours = variable("RELIEVO_CACHE"); !ours.empty()) return ours;
    // The XDG specification has relative paths ignored.
    if (const fs::path xdg = variable("XDG_CACHE_HOME"); xdg.is_absolute()) return xdg / "relievo";
    if (const fs::path home = variable("HOME"); home.is_absolute()) return home / ".cache" / "relievo";
    return std::nullopt;
}

fs::path MapCache::file_of(const MapKey& key) const {
    const Digest digest = digest_of(key);
    return folder_ / (std::string(key.map_id) + "-" + hex(std::span(digest).first(16)) + std::string(ending));
}

std::optional<ImageF> MapCache::find(const MapKey& key) const {
    const fs::path file = file_of(key);
    std::error_code ignored;
    const std::uintmax_t bytes = fs::file_size(file, ignored);
    std::ifstream in(file, std::ios::binary);
    Header header;
    if (!in.read(reinterpret_cast<char*>(&header), sizeof header)) return std::nullopt;
    if (header.magic != Header{}.magic || header.key != digest_of(key)) return std::nullopt;
    // Sizes are believed only as far as the file goes, so that a damaged one asks for no memory.
    constexpr std::uint32_t most = 1u << 20;
    if (header.width == 0 || header.height == 0 || header.channels == 0) return std::nullopt;
    if (header.width > most || header.height > most || header.channels > 16) return std::nullopt;
    const std::uintmax_t payload = std::uintmax_t{header.width} * header.height * header.channels * sizeof(float);
    if (bytes != sizeof header + payload) return std::nullopt;
    ImageF map(static_cast<int>(header.width), static_cast<int>(header.height), static_cast<int>(header.channels));
    if (!in.read(reinterpret_cast<char*>(map.texels.data()), static_cast<std::streamsize>(payload))) return std::nullopt;
    const Digest stated = std::exchange(header.checksum, Digest{});
    if (stated != checksum_of(header, map)) return std::nullopt;
    fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);  // used: not the next to go
    return map;
}

bool MapCache::store(const MapKey& key, const ImageF& map) const {
    const std::uintmax_t payload = map.texels.size() * sizeof(float);
    if (sizeof(Header) + payload > size_limit_) return false;
    std::error_code error;
    fs::create_directories(folder_, error);
    Header header{.width = static_cast<std::uint32_t>(map.width),
                  .height = static_cast<std::uint32_t>(map.height),
                  .channels = static_cast<std::uint32_t>(map.channels),
                  .key = digest_of(key)};
    header.checksum = checksum_of(header, map);
    try {
        AtomicFile file(file_of(key));
        std::ofstream out(file.temporary(), std::ios::binary);
        out.write(reinterpret_cast<const char*>(&header), sizeof header);
        out.write(reinterpret_cast<const char*>(map.texels.data()), static_cast<std::streamsize>(payload));
        out.close();
        if (!out) return false;
        file.commit();
    } catch (const Error&) {
        return false;  // a read-only or full disk slows the next run down; it is no reason to stop this one
    }
    evict();
    return true;
}

void MapCache::evict() const {
    struct Entry {
        fs::path path;
        std::uintmax_t bytes;
        fs::file_time_type used;
    };
    std::vector<Entry> entries;
    std::uintmax_t total = 0;
    std::error_code error;
    const auto now = fs::file_time_type::clock::now();
    for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
        // Another process may remove a file between any two of these calls.
        std::error_code gone;
        const std::uintmax_t bytes = it->file_size(gone);
        const fs::file_time_type used = it->last_write_time(gone);
        if (gone) continue;
        const std::string name = it->path().filename().string();
        // Half-written files of processes that were killed; nobody writes for an hour.
        if (name.starts_with(".relievo-") && name.ends_with(".tmp") && now - used > std::chrono::hours(1)) fs::remove(it->path(), gone);
        if (!name.ends_with(ending)) continue;
        entries.push_back({it->path(), bytes, used});
        total += bytes;
    }
    std::ranges::sort(entries, [](const Entry& a, const Entry& b) { return a.used != b.used ? a.used < b.used : a.path < b.path; });
    for (const Entry& e : entries) {
        if (total <= size_limit_) break;
        std::error_code gone;
        fs::remove(e.path, gone);
        total -= e.bytes;
    }
}

}  // namespace relievo
