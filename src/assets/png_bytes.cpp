// PNG (ISO/IEC 15948): signature, header, the rows as one zlib stream, end.
#include "assets/png_bytes.h"

#include "core/error.h"

#include <cassert>
#include <zlib.h>

namespace relievo {

namespace {

void append_big_endian(std::string& bytes, std::uint32_t value) {
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(static_cast<unsigned char>(value >> shift & 255u));
}

void append_chunk(std::string& bytes, const std::string& type, const std::string& data) {
    append_big_endian(bytes, static_cast<std::uint32_t>(data.size()));
    const std::string body = type + data;
    bytes += body;
    append_big_endian(bytes, static_cast<std::uint32_t>(crc32(0, reinterpret_cast<const Bytef*>(body.data()), static_cast<uInt>(body.size()))));
}

}  // namespace

std::string png_bytes(const Image8& image) {
    assert(!image.empty() && image.channels >= 1 && image.channels <= 4);
    const auto row = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.channels), step = static_cast<std::size_t>(image.channels);
    // Each row as differences to the row above (filter 2): what repeats downward becomes zeros.
    std::string rows;
    rows.reserve((row + 1) * static_cast<std::size_t>(image.height));
    for (int y = 0; y < image.height; ++y) {
        rows += '\2';
        const std::uint8_t* now = image.at(0, y);
        const std::uint8_t* above = y > 0 ? image.at(0, y - 1) : nullptr;
        for (std::size_t i = 0; i < row; ++i) rows += static_cast<char>(static_cast<unsigned char>(now[i] - (above ? above[i] : 0)));
    }
    uLongf packed_size = compressBound(static_cast<uLong>(rows.size()));
    std::string packed(packed_size, '\0');
    constexpr int level = 4;  // of a texture of fur, whose texels are mostly noise, higher ones gain 2 % and take three times as long
    if (compress2(reinterpret_cast<Bytef*>(packed.data()), &packed_size, reinterpret_cast<const Bytef*>(rows.data()), static_cast<uLong>(rows.size()), level) != Z_OK)
        throw Error("pack", "a picture", "zlib has no memory for it");
    packed.resize(packed_size);
    constexpr char kinds[] = {0, 0, 4, 2, 6};  // grey, grey + alpha, RGB, RGBA
    std::string header;
    append_big_endian(header, static_cast<std::uint32_t>(image.width));
    append_big_endian(header, static_cast<std::uint32_t>(image.height));
    header += {8, kinds[step], 0, 0, 0};
    std::string bytes = "\x89PNG\r\n\x1a\n";
    append_chunk(bytes, "IHDR", header);
    append_chunk(bytes, "IDAT", packed);
    append_chunk(bytes, "IEND", {});
    return bytes;
}

}  // namespace relievo
