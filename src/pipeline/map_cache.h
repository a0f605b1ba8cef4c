// Baked maps on disk, named by what they were baked from. Nothing here is worth an error: what cannot be read is baked again,
// what cannot be written is not kept.
#pragma once

#include "core/image.h"
#include "pipeline/content_hash.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string_view>

namespace relievo {

// What decides a map's texels. The digest covers the source's texels; its size is kept apart, for equal bytes may be cut into
// different rows. Raise the baker's version whenever its output changes in any bit.
struct MapKey {
    std::string_view map_id;
    std::uint32_t baker_version = 1;
    int width = 0;
    int height = 0;
    Digest content{};
};

class MapCache {
public:
    // Room for some sixty cone maps of 1024^2; beyond it the entries unused for longest go.
    static constexpr std::uintmax_t default_size_limit = std::uintmax_t{1} << 30;

    explicit MapCache(std::filesystem::path folder, std::uintmax_t size_limit = default_size_limit)
        : folder_(std::move(folder)), size_limit_(size_limit) {}

    // $RELIEVO_CACHE, else $XDG_CACHE_HOME/relievo, else ~/.cache/relievo; nothing where none of them is set.
    static std::optional<std::filesystem::path> default_folder();

    // The map, or nothing: absent, truncated, damaged (a checksum covers everything) or of another version.
    std::optional<ImageF> find(const MapKey& key) const;

    // Keeps the map, appearing whole or not at all, so that processes may share a folder; false if it could not be kept.
    bool store(const MapKey& key, const ImageF& map) const;

    std::filesystem::path file_of(const MapKey& key) const;

private:
    void evict() const;

    std::filesystem::path folder_;
    std::uintmax_t size_limit_;
};

}  // namespace relievo
