#include "assets/file_integrity.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string_view>
#include <vector>

namespace relievo {

namespace {

const char* const truncated = "the file is truncated";

constexpr std::array<std::uint32_t, 256> crc_table() {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t i = 0; i < 256; ++i) {
        std::uint32_t crc = i;
        for (int bit = 0; bit < 8; ++bit) crc = crc & 1 ? crc >> 1 ^ 0xedb88320u : crc >> 1;
        table[i] = crc;
    }
    return table;
}

// A PNG is a chain of chunks: length, four letters, data, checksum (CRC-32 of letters and data); the last is IEND. libpng checks
// the same, but prints what it finds.
std::string png_damage(std::ifstream& in, std::uintmax_t size) {
    static constexpr auto table = crc_table();
    std::vector<char> block(1 << 16);
    std::uintmax_t at = 8;
    in.seekg(8);
    while (at + 12 <= size) {
        unsigned char head[8];
        if (!in.read(reinterpret_cast<char*>(head), sizeof head)) return truncated;
        if (!std::all_of(head + 4, head + 8, [](unsigned char c) { return c < 128 && std::isalpha(c); }))
            return "the file is damaged: a PNG chunk has no name";
        const auto word = [](const unsigned char* b) {
            return std::uint32_t{b[0]} << 24 | std::uint32_t{b[1]} << 16 | std::uint32_t{b[2]} << 8 | b[3];
        };
        const std::uintmax_t length = word(head);
        if (at + 12 + length > size) return truncated;
        std::uint32_t crc = 0xffffffffu;
        const auto count_in = [&](unsigned char byte) { crc = crc >> 8 ^ table[(crc ^ byte) & 0xff]; };
        std::for_each(head + 4, head + 8, count_in);
        for (std::uintmax_t left = length; left > 0;) {
            const auto part = static_cast<std::streamsize>(std::min<std::uintmax_t>(left, block.size()));
            if (!in.read(block.data(), part)) return truncated;
            std::for_each(block.data(), block.data() + part, [&](char c) { count_in(static_cast<unsigned char>(c)); });
            left -= static_cast<std::uintmax_t>(part);
        }
        unsigned char checksum[4];
        if (!in.read(reinterpret_cast<char*>(checksum), sizeof checksum)) return truncated;
        const std::string name(reinterpret_cast<const char*>(head + 4), 4);
        if (word(checksum) != ~crc) return "the file is damaged: the checksum of its chunk " + name + " is wrong";
        if (name == "IEND") return {};
        at += 12 + length;
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
        return std::uint32_t{head[at]} | std::uint32_t{head[at + 1]} << 8 | std::uint32_t{head[at + 2]} << 16 |
               std::uint32_t{head[at + 3]} << 24;
    };
    const std::uintmax_t height = word(12), width = word(16);
    const std::string_view four_cc(reinterpret_cast<const char*>(head + 84), 4);
    std::uintmax_t header = 128;
    std::uintmax_t block_bytes = 0;  // of 4 x 4 texels
    if ((word(80) & 4u) == 0 && (word(80) & (0x40u | 0x20000u | 0x2u)) != 0) {
        // Plain texels: RGB, luminance or alpha.
        const std::uint32_t bits = word(88);
        if (bits <= 32 && bits % 8 == 0) block_bytes = bits * 2;
    } else if ((word(80) & 4u) == 0) {
        return {};  // no four-character code either: the decoder refuses it
    } else if (four_cc == "DX10") {
        header = 148;
        // DXGI_FORMAT: BC1 70-72, BC2 73-75, BC3 76-78, BC4 79-81, BC5 82-84, BC6H and BC7 94-99
        const std::uint32_t format = word(128);
        if ((format >= 70 && format <= 72) || (format >= 79 && format <= 81))
            block_bytes = 8;
        else if ((format >= 73 && format <= 84) || (format >= 94 && format <= 99))
            block_bytes = 16;
    } else if (four_cc == "DXT1" || four_cc == "BC4U" || four_cc == "BC4S" || four_cc == "ATI1") {
        block_bytes = 8;
    } else if (four_cc.substr(0, 3) == "DXT" || four_cc == "BC5U" || four_cc == "BC5S" || four_cc == "ATI2" || four_cc == "RXGB") {
        block_bytes = 16;
    }
    const bool plain = (word(80) & 4u) == 0;
    const std::uintmax_t data = plain ? width * height * block_bytes / 16 : (width + 3) / 4 * ((height + 3) / 4) * block_bytes;
    // Sizes beyond all reason are the reader's to refuse; here they could only overflow.
    return width < (1u << 20) && height < (1u << 20) && size < header + data ? truncated : "";
}

// OpenImageIO forgets strips of a TIFF that fail to decode and leaves what memory held. The first directory lists where the strips
// (or tiles) lie: all must lie within the file. Layout: TIFF 6.0, section 2; BigTIFF has the same with 8-byte counts and offsets.
std::string tiff_damage(std::ifstream& in, std::uintmax_t size) {
    bool cut = false;
    bool little = false;
    const auto number = [&](std::uintmax_t at, int bytes) {
        unsigned char b[8] = {};
        if (at > size || size - at < static_cast<std::uintmax_t>(bytes)) {
            cut = true;
            return std::uintmax_t{0};
        }
        in.seekg(static_cast<std::streamoff>(at));
        in.read(reinterpret_cast<char*>(b), bytes);
        std::uintmax_t value = 0;
        for (int i = 0; i < bytes; ++i) value = value << 8 | b[little ? bytes - 1 - i : i];
        return value;
    };
    little = number(0, 1) == 'I';
    const bool big = number(2, 2) == 43;
    const int word = big ? 8 : 4;
    const std::uintmax_t directory = number(big ? 8 : 4, word);
    const std::uintmax_t entries = number(directory, big ? 8 : 2);
    if (cut || entries > 4096) return cut ? truncated : "the file is damaged: its TIFF directory makes no sense";

    struct Array {
        std::uintmax_t at = 0, count = 0;
        int bytes = 0;
    };
    Array offsets, lengths;
    for (std::uintmax_t e = 0; e < entries && !cut; ++e) {
        const std::uintmax_t entry = directory + (big ? 8 : 2) + e * (big ? 20 : 12);
        const std::uintmax_t tag = number(entry, 2);
        const bool is_offset = tag == 273 || tag == 324;  // StripOffsets, TileOffsets
        const bool is_length = tag == 279 || tag == 325;  // StripByteCounts, TileByteCounts
        if (!is_offset && !is_length) continue;
        const std::uintmax_t type = number(entry + 2, 2);
        Array& array = is_offset ? offsets : lengths;
        array.bytes = type == 3 ? 2 : type == 4 ? 4 : type == 16 ? 8 : 0;  // SHORT, LONG, LONG8
        array.count = number(entry + 4, word);
        const std::uintmax_t value = entry + 4 + static_cast<std::uintmax_t>(word);
        array.at =
            array.count <= size && array.count * static_cast<std::uintmax_t>(array.bytes) <= static_cast<std::uintmax_t>(word)
                ? value
                : number(value, word);
    }
    if (cut) return truncated;
    if (offsets.bytes == 0 || lengths.bytes == 0 || offsets.count != lengths.count) return {};  // the decoder refuses it
    for (std::uintmax_t i = 0; i < offsets.count && !cut; ++i) {
        const std::uintmax_t at = number(offsets.at + i * static_cast<std::uintmax_t>(offsets.bytes), offsets.bytes);
        const std::uintmax_t length = number(lengths.at + i * static_cast<std::uintmax_t>(lengths.bytes), lengths.bytes);
        cut = cut || at > size || size - at < length;
    }
    return cut ? truncated : "";
}

}  // namespace

std::string damage_of(const std::filesystem::path& file, const std::string& format) {
    std::ifstream in(file, std::ios::binary);
    const std::uintmax_t size = std::filesystem::file_size(file);
    if (format == "png") return png_damage(in, size);
    if (format == "jpeg") return jpeg_damage(in);
    if (format == "tiff") return tiff_damage(in, size);
    if (format == "dds") return dds_damage(in, size);
    return {};
}

}  // namespace relievo
