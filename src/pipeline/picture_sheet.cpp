#include "pipeline/picture_sheet.h"

#include "assets/image_file.h"

#include <algorithm>

namespace relievo {

namespace {

constexpr int gap = 6;

}  // namespace

Image8 beside(const std::vector<Image8>& panels) {
    int width = -gap;
    for (const Image8& p : panels) width += p.width + gap;
    Image8 sheet(width, panels.front().height, 3, 255);
    int x0 = 0;
    for (const Image8& p : panels) {
        for (int y = 0; y < p.height; ++y)
            for (int x = 0; x < p.width; ++x)
                for (int c = 0; c < 3; ++c) sheet(x0 + x, y, c) = p(x, y, c);
        x0 += p.width + gap;
    }
    return sheet;
}

Image8 stacked(const std::vector<Image8>& rows) {
    Image8 sheet(rows.front().width, 0, 3);
    for (const Image8& r : rows) {
        sheet.texels.insert(sheet.texels.end(), r.texels.begin(), r.texels.end());
        sheet.height += r.height;
    }
    return sheet;
}

Image8 srgb_picture(const ImageF& linear) {
    Image8 out(linear.width, linear.height, 3);
    for (std::size_t i = 0; i < out.texels.size(); ++i) out.texels[i] = srgb_from_linear(linear.texels[i]);
    return out;
}

Image8 magnified(const Image8& picture, int times) {
    Image8 out(picture.width * times, picture.height * times, picture.channels);
    for (int y = 0; y < out.height; ++y)
        for (int x = 0; x < out.width; ++x)
            for (int c = 0; c < out.channels; ++c) out(x, y, c) = picture(x / times, y / times, c);
    return out;
}

Image8 in_rows(std::vector<Image8> panels, int abreast) {
    const auto columns = static_cast<std::size_t>(abreast);
    while (panels.size() % columns != 0) panels.emplace_back(panels.front().width, panels.front().height, 3, std::uint8_t{255});
    std::vector<Image8> rows;
    for (std::size_t begin = 0; begin < panels.size(); begin += columns) {
        rows.push_back(beside({panels.begin() + static_cast<std::ptrdiff_t>(begin), panels.begin() + static_cast<std::ptrdiff_t>(begin + columns)}));
        if (begin + columns < panels.size()) rows.emplace_back(rows.front().width, gap, 3, std::uint8_t{255});
    }
    return stacked(rows);
}

}  // namespace relievo
