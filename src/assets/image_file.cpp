#include "assets/image_file.h"

#include "assets/atomic_file.h"
#include "assets/file_integrity.h"
#include "core/error.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cassert>
#include <cctype>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <memory>
#include <string_view>
#include <type_traits>
#include <vector>

namespace relievo {

namespace {

using namespace std::string_view_literals;

struct Signature {
    std::string_view bytes;
    std::size_t offset;
    const char* plugin;  // OpenImageIO's name of the format
};

// Letting OpenImageIO try every plugin on unknown bytes would also try video and font decoders; a table of the formats a
// material comes in keeps hostile files away from them.
constexpr Signature signatures[] = {
    {"\x89PNG\r\n\x1a\n"sv, 0, "png"},
    {"\xff\xd8\xff"sv, 0, "jpeg"},
    {"\x76\x2f\x31\x01"sv, 0, "openexr"},
    {"II*\0"sv, 0, "tiff"},
    {"MM\0*"sv, 0, "tiff"},
    {"II+\0"sv, 0, "tiff"},
    {"MM\0+"sv, 0, "tiff"},
    {"#?RADIANCE"sv, 0, "hdr"},
    {"#?RGBE"sv, 0, "hdr"},
    {"DDS "sv, 0, "dds"},
    {"BM"sv, 0, "bmp"},
    {"WEBP"sv, 8, "webp"},
};

std::string lower(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::string first_bytes(const std::filesystem::path& file) {
    std::error_code error;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) {
        const bool hidden = error && error != std::errc::no_such_file_or_directory && error != std::errc::not_a_directory;
        throw Error("read image", file.string(), hidden ? error.message() : "there is no such file",
                    "check the spelling of the path");
    }
    if (std::filesystem::is_directory(status)) throw Error("read image", file.string(), "it is a folder", "name a picture file");
    if (!std::filesystem::is_regular_file(status)) throw Error("read image", file.string(), "it is not a plain file");
    std::ifstream in(file, std::ios::binary);
    if (!in) throw Error("read image", file.string(), std::strerror(errno), "check the file's permissions");
    std::string bytes(16, '\0');
    in.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(in.gcount()));
    if (bytes.empty()) throw Error("read image", file.string(), "the file is empty");
    return bytes;
}

std::string plugin_for(const std::filesystem::path& file) {
    const std::string bytes = first_bytes(file);
    for (const Signature& s : signatures)
        if (bytes.size() >= s.offset + s.bytes.size() && std::string_view(bytes).substr(s.offset, s.bytes.size()) == s.bytes)
            return s.plugin;
    if (lower(file.extension().string()) == ".tga") return "targa";
    throw Error("read image", file.string(), "its content is not an image of a known format",
                "known are PNG, JPEG, TGA, OpenEXR, TIFF, Radiance HDR, DDS, BMP and WebP");
}

struct OpenedImage {
    std::unique_ptr<OIIO::ImageInput> input;
    OIIO::ImageSpec spec;
    ImageFileInfo info;
};

std::string one_line(std::string text, const std::string& otherwise) {
    while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.pop_back();
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.empty() ? otherwise : text;
}

OpenedImage open_image(const std::filesystem::path& file) {
    OpenedImage opened;
    opened.info.format = plugin_for(file);
    if (const std::string damage = damage_of(file, opened.info.format); !damage.empty())
        throw Error("read image", file.string(), damage, "fetch or export it again");
    opened.input = OIIO::ImageInput::create(opened.info.format);
    if (!opened.input)
        throw Error("read image", file.string(), "this build of OpenImageIO cannot read " + opened.info.format,
                    one_line(OIIO::geterror(), "convert the file to PNG"));
    OIIO::ImageSpec wanted;
    wanted["oiio:UnassociatedAlpha"] = 1;  // colours under transparent texels are still colours
    if (!opened.input->open(file.string(), opened.spec, wanted))
        throw Error("read image", file.string(), one_line(opened.input->geterror(), "the file is damaged"));

    const OIIO::ImageSpec& spec = opened.spec;
    const std::string size = std::to_string(spec.width) + " x " + std::to_string(spec.height);
    if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1)
        throw Error("read image", file.string(), "it has no texels (" + size + ")");
    if (spec.width > max_image_side || spec.height > max_image_side ||
        static_cast<long long>(spec.width) * spec.height > max_image_texels || spec.nchannels > 256)
        throw Error("read image", file.string(), size + " texels of " + std::to_string(spec.nchannels) + " channels are too many",
                    "the limit is " + std::to_string(max_image_side) + " on a side and 16384 x 16384 in all; scale the map down");
    if (spec.deep) throw Error("read image", file.string(), "it is a deep image", "flatten it first");
    if (spec.depth > 1) throw Error("read image", file.string(), "it is a volume, not a picture");
    if (spec.get_string_attribute("textureformat").find("CubeFace") != std::string::npos)
        throw Error("read image", file.string(), "it is a cube map, not a picture");

    opened.info.width = spec.width;
    opened.info.height = spec.height;
    opened.info.channels = spec.nchannels;
    opened.info.bits = static_cast<int>(spec.format.basesize()) * 8;
    opened.info.floating = spec.format.is_floating_point();
    return opened;
}

// Decodes all channels as T (OpenImageIO's own conversion: value / max for integers to float), flipped by stepping backwards.
template <class T>
Image<T> decode(const std::filesystem::path& file, FirstRow first_row, OIIO::TypeDesc type) {
    try {
        OpenedImage opened = open_image(file);
        const OIIO::ImageSpec& spec = opened.spec;
        Image<T> image(spec.width, spec.height, spec.nchannels);
        const auto row = static_cast<OIIO::stride_t>(sizeof(T)) * spec.width * spec.nchannels;
        char* first = reinterpret_cast<char*>(image.texels.data());
        const bool flip = first_row == FirstRow::bottom;
        if (flip) first += row * (spec.height - 1);
        if (!opened.input->read_image(0, 0, 0, spec.nchannels, type, first, OIIO::AutoStride, flip ? -row : row))
            throw Error("read image", file.string(), one_line(opened.input->geterror(), "the file is damaged or truncated"),
                        "fetch or export it again");
        opened.input->close();
        if constexpr (std::is_same_v<T, float>) {
            // OpenImageIO multiplies by 1 / max, which misses the nearest float by one unit for some values.
            if (!opened.info.floating && opened.info.bits <= 16) {
                const float most = opened.info.bits == 8 ? 255.0f : 65535.0f;
                for (float& x : image.texels) x = std::round(x * most) / most;
            }
        }
        return image;
    } catch (const Error&) {
        throw;
    } catch (const std::bad_alloc&) {
        throw Error("read image", file.string(), "there is not enough memory for it", "scale the map down");
    } catch (const std::exception& e) {
        throw Error("read image", file.string(), e.what());
    }
}

void write(const std::filesystem::path& file, const char* plugin, OIIO::ImageSpec spec, OIIO::TypeDesc type, const void* texels,
           std::size_t texel_bytes, FirstRow first_row) {
    if (spec.width < 1 || spec.height < 1) throw Error("write image", file.string(), "it has no texels");
    AtomicFile out(file);
    try {
        auto output = OIIO::ImageOutput::create(plugin);
        if (!output)
            throw Error("write image", file.string(), std::string("this build of OpenImageIO cannot write ") + plugin,
                        OIIO::geterror());
        const auto row = static_cast<OIIO::stride_t>(texel_bytes) * spec.width;
        const char* first = static_cast<const char*>(texels);
        const bool flip = first_row == FirstRow::bottom;
        if (flip) first += row * (spec.height - 1);
        if (!output->open(out.temporary().string(), spec) ||
            !output->write_image(type, first, OIIO::AutoStride, flip ? -row : row) || !output->close())
            throw Error("write image", file.string(), one_line(output->geterror(), "writing failed"), "is the disk full?");
    } catch (const Error&) {
        throw;
    } catch (const std::exception& e) {
        throw Error("write image", file.string(), e.what());
    }
    out.commit();
}

float unit(float x) { return x > 0 ? std::min(x, 1.0f) : 0.0f; }  // NaN fails the comparison

}  // namespace

ImageFileInfo read_image_info(const std::filesystem::path& file) {
    try {
        return open_image(file).info;
    } catch (const Error&) {
        throw;
    } catch (const std::exception& e) {
        throw Error("read image", file.string(), e.what());
    }
}

ImageF read_image(const std::filesystem::path& file, FirstRow first_row) {
    return decode<float>(file, first_row, OIIO::TypeDesc::FLOAT);
}

Image8 read_image_8(const std::filesystem::path& file, FirstRow first_row) {
    if (!read_image_info(file).floating) return decode<std::uint8_t>(file, first_row, OIIO::TypeDesc::UINT8);
    const ImageF linear = read_image(file, first_row);
    Image8 image(linear.width, linear.height, linear.channels);
    const bool alpha = linear.channels == 2 || linear.channels == 4;
    for (std::size_t i = 0; i < linear.texels.size(); ++i) {
        const bool is_alpha = alpha && static_cast<int>(i % static_cast<std::size_t>(linear.channels)) == linear.channels - 1;
        const float x = linear.texels[i];
        image.texels[i] = is_alpha ? static_cast<std::uint8_t>(unit(x) * 255 + 0.5f) : srgb_from_linear(x);
    }
    return image;
}

std::uint8_t srgb_from_linear(float linear) {
    const float x = unit(linear);
    const float encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(encoded * 255 + 0.5f);
}

void write_png(const std::filesystem::path& file, const Image8& image, FirstRow first_row) {
    assert(image.empty() || (image.channels >= 1 && image.channels <= 4));
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
    spec["oiio:UnassociatedAlpha"] = 1;
    write(file, "png", spec, OIIO::TypeDesc::UINT8, image.texels.data(), static_cast<std::size_t>(image.channels), first_row);
}

void write_png_16(const std::filesystem::path& file, const ImageF& image, FirstRow first_row) {
    assert(image.empty() || (image.channels >= 1 && image.channels <= 4));
    std::vector<std::uint16_t> texels(image.texels.size());
    std::transform(image.texels.begin(), image.texels.end(), texels.begin(),
                   [](float x) { return static_cast<std::uint16_t>(std::lround(static_cast<double>(unit(x)) * 65535)); });
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT16);
    spec["oiio:UnassociatedAlpha"] = 1;
    write(file, "png", spec, OIIO::TypeDesc::UINT16, texels.data(),
          sizeof(std::uint16_t) * static_cast<std::size_t>(image.channels), first_row);
}

void write_exr(const std::filesystem::path& file, std::span<const ExrChannel> channels, FirstRow first_row) {
    assert(!channels.empty() && channels.front().image);
    const int width = channels.front().image->width;
    const int height = channels.front().image->height;
    const std::size_t count = channels.size();
    std::vector<float> texels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * count);
    OIIO::ImageSpec spec(width, height, static_cast<int>(count), OIIO::TypeDesc::FLOAT);
    // Without a date the writer stamps the present one, and equal pictures would be unequal files.
    spec.attribute("DateTime", "1970:01:01 00:00:00");
    spec.channelnames.clear();
    for (std::size_t c = 0; c < count; ++c) {
        const ImageF& plane = *channels[c].image;
        assert(plane.width == width && plane.height == height && channels[c].channel < plane.channels);
        spec.channelnames.push_back(channels[c].name);
        const float* from = plane.texels.data() + channels[c].channel;
        for (std::size_t i = 0; i * count < texels.size(); ++i)
            texels[i * count + c] = from[i * static_cast<std::size_t>(plane.channels)];
    }
    spec["compression"] = "zip";
    spec.alpha_channel = -1;  // "A" here would be a measurement, not a reason to divide
    write(file, "openexr", spec, OIIO::TypeDesc::FLOAT, texels.data(), sizeof(float) * count, first_row);
}

}  // namespace relievo
