#include "assets/file_integrity.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>

namespace relievo {

namespace {

const char* const truncated = "the file is truncated";

// A PNG is a chain of chunks: length, four letters, data, checksum; the last is IEND.
std::string png_damage(std::ifstream& in, std::uintmax_t size) {
    std::uintmax_t at = 8;
    while (at + 12 <= size) {
        unsigned char head[8];
        in.seekg(static_cast<std::streamoff>(at));
        if (!in.read(reinterpret_cast<char*>(head), sizeof head)) return truncated;
        if (!std::all_of(head + 4, head + 8, [](unsigned char c) { return c < 128 && std::isalpha(c); })) return "the file is damaged: a PNG chunk has no name";
        if (std::memcmp(head + 4, "IEND", 4) == 0) return {};
        at += 12 + (std::uintmax_t{head[0]} << 24 | std::uintmax_t{head[1]} << 16 | std::uintmax_t{head[2]} << 8 | head[3]);
    }
    return truncated;
}

// libjpeg fills what is missing from a truncated file with grey and only warns. A whole file has its end marker (FF D9) somewhere
// after the first start of scan (FF DA); those of embedded thumbnails stand in segments before it, which are skipped.
std::string jpeg_damage(std::ifstream& in) {
    in.seekg(0);
    const std::string bytes((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
    std::size_t at = 2;
    while (at + 4 <= bytes.size() && byte(at) == 0xff) {
        if (byte(at + 1) == 0xff) {
            ++at;  // filling
        } else if (byte(at + 1) == 0xda) {
            return bytes.find("\xff\xd9", at) != std::string::npos ? "" : truncated;
        } else {
            at += 2 + byte(at + 2) * 256u + byte(at + 3);
        }
    }
    return at + 4 > bytes.size() ? truncated : "the file is damaged: a JPEG segment has no marker";
}

// OpenImageIO decodes whatever memory holds when blocks are missing. Only the largest level is counted.
std::string dds_damage(std::ifstream& in, std::uintmax_t size) {
    unsigned char head[148] = {};
    in.seekg(0);
    in.read(reinterpret_cast<char*>(head), sizeof head);
    if (size < 128) return truncated;
    const auto word = [&](int at) {
        return std::uint32_t{head[at]} | std::uint32_t{head[at + 1]} << 8 | std::uint32_t{head[at + 2]} << 16 | std::uint32_t{head[at + 3]} << 24;
    };
    const std::uintmax_t height = word(12), width = word(16);
    const std::string_view four_cc(reinterpret_cast<const char*>(head + 84), 4);
    std::uintmax_t header = 128;
    std::uintmax_t block_bytes = 0;  // of 4 x 4 texels
    if ((word(80) & 4u) == 0) {      // no four-character code: plain texels
        const std::uint32_t bits = word(88);
        if (bits <= 32 && bits % 8 == 0) block_bytes = bits * 2;
    } else if (four_cc == "DX10") {
        header = 148;
        const std::uint32_t format = word(128);  // DXGI_FORMAT: BC1 70-72, BC2 73-75, BC3 76-78, BC4 79-81, BC5 82-84, BC6H and BC7 94-99
        if ((format >= 70 && format <= 72) || (format >= 79 && format <= 81)) block_bytes = 8;
        else if ((format >= 73 && format <= 84) || (format >= 94 && format <= 99)) block_bytes = 16;
    } else if (four_cc == "DXT1" || four_cc == "BC4U" || four_cc == "BC4S" || four_cc == "ATI1") {
        block_bytes = 8;
    } else if (four_cc.substr(0, 3) == "DXT" || four_cc == "BC5U" || four_cc == "BC5S" || four_cc == "ATI2" || four_cc == "RXGB") {
        block_bytes = 16;
    }
    const bool blocks = (word(80) & 4u) != 0;
    const std::uintmax_t data = blocks ? (width + 3) / 4 * ((height + 3) / 4) * block_bytes : width * height * block_bytes / 16;
    return width < 65536 * 16 && height < 65536 * 16 && size < header + data ? truncated : "";
}

}  // namespace

std::string damage_of(const std::filesystem::path& file, const std::string& format) {
    std::ifstream in(file, std::ios::binary);
    const std::uintmax_t size = std::filesystem::file_size(file);
    if (format == "png") return png_damage(in, size);
    if (format == "jpeg") return jpeg_damage(in);
    if (format == "dds") return dds_damage(in, size);
    return {};
}

}  // namespace relievo
