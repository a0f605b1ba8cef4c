#include "figure/font.h"

#include "figure/font_words.h"

#include <array>
#include <cstdint>
#include <cstdlib>
#include <stdexcept>

#include <stb/stb_truetype.h>

namespace relievo {

namespace {

struct Face {
    stbtt_fontinfo info{};
    explicit Face(const std::uint32_t* words) {
        const auto* bytes = reinterpret_cast<const unsigned char*>(words);
        if (stbtt_InitFont(&info, bytes, stbtt_GetFontOffsetForIndex(bytes, 0)) == 0) throw std::logic_error("the font inside the program is damaged");
    }
};

const stbtt_fontinfo* face(bool bold) {
    static const Face faces[2] = {Face(font_regular), Face(font_bold)};
    return &faces[bold ? 1 : 0].info;
}

// The next code point, taken off the front; a byte that begins none stands for itself.
int next_code_point(std::string_view& text) {
    const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
    const unsigned first = byte(0);
    const int more = first >= 0xf0 ? 3 : first >= 0xe0 ? 2 : first >= 0xc0 ? 1 : 0;
    unsigned point = more == 3 ? first & 7u : more == 2 ? first & 15u : more == 1 ? first & 31u : first;
    int taken = 1;
    for (; taken <= more && (byte(static_cast<std::size_t>(taken)) & 0xc0u) == 0x80u; ++taken)
        point = point << 6 | (byte(static_cast<std::size_t>(taken)) & 63u);
    text.remove_prefix(static_cast<std::size_t>(taken));
    return static_cast<int>(point);
}

double advance(const stbtt_fontinfo* font, int code_point) {
    int width = 0;
    int bearing = 0;
    stbtt_GetCodepointHMetrics(font, code_point, &width, &bearing);
    return width;
}

}  // namespace

double text_width(std::string_view text, double size, bool bold) {
    const stbtt_fontinfo* font = face(bold);
    const double scale = static_cast<double>(stbtt_ScaleForMappingEmToPixels(font, static_cast<float>(size)));
    double width = 0;
    while (!text.empty()) width += advance(font, next_code_point(text)) * scale;
    return width;
}

std::vector<std::vector<Vec2d>> text_outlines(std::string_view text, double size, bool bold) {
    const stbtt_fontinfo* font = face(bold);
    const double scale = static_cast<double>(stbtt_ScaleForMappingEmToPixels(font, static_cast<float>(size)));
    constexpr int pieces = 8;  // of a curve: at 64 pixels of size the chord is nowhere 1/20 pixel off
    std::vector<std::vector<Vec2d>> contours;
    double pen = 0;
    while (!text.empty()) {
        const int code_point = next_code_point(text);
        stbtt_vertex* vertices = nullptr;
        const int count = stbtt_GetCodepointShape(font, code_point, &vertices);
        const auto place = [&](double x, double y) { return Vec2d{pen + x * scale, -y * scale}; };
        for (int i = 0; i < count; ++i) {
            const stbtt_vertex& v = vertices[i];
            if (v.type == STBTT_vmove) {
                contours.push_back({place(v.x, v.y)});
            } else if (v.type == STBTT_vline) {
                contours.back().push_back(place(v.x, v.y));
            } else {
                const Vec2d a = contours.back().back(), b = place(v.cx, v.cy), c = place(v.x, v.y);
                for (int k = 1; k <= pieces; ++k) {
                    const double t = static_cast<double>(k) / pieces;
                    contours.back().push_back(a * ((1 - t) * (1 - t)) + b * (2 * t * (1 - t)) + c * (t * t));
                }
            }
        }
        stbtt_FreeShape(font, vertices);
        pen += advance(font, code_point) * scale;
    }
    return contours;
}

}  // namespace relievo
