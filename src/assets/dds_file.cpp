#include "assets/dds_file.h"

#include "assets/atomic_file.h"
#include "assets/block_compression.h"
#include "core/parallel_for.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <string>

namespace relievo {

namespace {

std::size_t block_bytes(DdsCode code) { return code == DdsCode::bc3 ? 16 : 8; }

void append(std::string& to, std::uint32_t v) {
    for (int i = 0; i < 4; ++i) to += static_cast<char>(v >> (8 * i) & 255);
}

// Texels beyond the edge of a level that is no multiple of four repeat those at the edge.
void append_level(std::string& to, const Image8& level, DdsCode code, int threads) {
    const int across = (level.width + 3) / 4, down = (level.height + 3) / 4;
    const std::size_t bytes = block_bytes(code), start = to.size();
    to.resize(start + static_cast<std::size_t>(across) * static_cast<std::size_t>(down) * bytes);
    parallel_for(down, 8, threads, [&](int begin, int end) {
        for (int by = begin; by < end; ++by)
            for (int bx = 0; bx < across; ++bx) {
                GreyBlock alpha;
                ColourBlock colours;
                for (int t = 0; t < 16; ++t) {
                    const std::uint8_t* texel = level.at(std::min(bx * 4 + t % 4, level.width - 1), std::min(by * 4 + t / 4, level.height - 1));
                    std::copy_n(texel, 3, colours[static_cast<std::size_t>(t)].data());
                    alpha[static_cast<std::size_t>(t)] = texel[3];
                }
                char* out = &to[start + (static_cast<std::size_t>(by) * static_cast<std::size_t>(across) + static_cast<std::size_t>(bx)) * bytes];
                if (code != DdsCode::bc1) {
                    std::memcpy(out, bc4_block(alpha).data(), 8);
                    out += 8;
                }
                if (code != DdsCode::bc4) std::memcpy(out, bc1_block(colours).data(), 8);
            }
    });
}

}  // namespace

void write_dds(const std::filesystem::path& file, std::span<const std::vector<Image8>> faces, DdsCode code, int threads) {
    assert((faces.size() == 1 || faces.size() == 6) && !faces[0].empty());
    const Image8& full = faces[0][0];
    const auto levels = static_cast<std::uint32_t>(faces[0].size());
    const bool cube = faces.size() == 6;
    // Names as in Microsoft's DDS_HEADER.
    constexpr std::uint32_t caps = 0x1, height = 0x2, width = 0x4, pixel_format = 0x1000, mip_map_count = 0x20000, linear_size = 0x80000;
    constexpr std::uint32_t four_cc = 0x4, complex_surface = 0x8, texture = 0x1000, mip_map = 0x400000, cube_map_all_faces = 0xfe00;
    std::string out = "DDS ";
    append(out, 124);
    append(out, caps | height | width | pixel_format | mip_map_count | linear_size);
    append(out, static_cast<std::uint32_t>(full.height));
    append(out, static_cast<std::uint32_t>(full.width));
    append(out, static_cast<std::uint32_t>(static_cast<std::size_t>((full.width + 3) / 4) * static_cast<std::size_t>((full.height + 3) / 4) * block_bytes(code)));
    append(out, 0);  // depth
    append(out, levels);
    for (int i = 0; i < 11; ++i) append(out, 0);
    append(out, 32);
    append(out, four_cc);
    out += code == DdsCode::bc1 ? "DXT1" : code == DdsCode::bc3 ? "DXT5" : "ATI1";
    for (int i = 0; i < 5; ++i) append(out, 0);
    append(out, texture | (levels > 1 || cube ? complex_surface : 0) | (levels > 1 ? mip_map : 0));
    append(out, cube ? cube_map_all_faces : 0);
    for (int i = 0; i < 3; ++i) append(out, 0);
    assert(out.size() == 128);
    for (const std::vector<Image8>& face : faces) {
        assert(face.size() == levels);
        for (std::size_t k = 0; k < face.size(); ++k) {
            assert(face[k].channels == 4 && face[k].width == std::max(1, full.width >> k) && face[k].height == std::max(1, full.height >> k));
            append_level(out, face[k], code, threads);
        }
    }
    write_file_atomically(file, out);
}

}  // namespace relievo
