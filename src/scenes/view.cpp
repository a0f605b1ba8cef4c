#include "scenes/view.h"

#include <algorithm>
#include <array>
#include <charconv>

namespace relievo {

std::span<const View> views() {
    static const std::array table{
        View{.id = "grazing", .elevation_deg = 15},
        View{.id = "middle", .elevation_deg = 35},
        View{.id = "steep", .elevation_deg = 65},
    };
    return table;
}

namespace {

std::optional<double> number_in(std::string_view text, double least, double most) {
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || !(value >= least && value <= most)) return std::nullopt;
    return value;
}

}  // namespace

std::optional<View> parse_view(std::string_view text) {
    const std::size_t at = text.find('@');
    const std::string_view angle = text.substr(0, at);
    View view{.id = std::string(text), .elevation_deg = 0};
    if (at != std::string_view::npos) {
        const auto distance = number_in(text.substr(at + 1), 0.1, 100);
        if (!distance) return std::nullopt;
        view.distance = *distance;
    }
    const auto table = views();
    const auto it = std::ranges::find(table, angle, &View::id);
    auto degrees = it != table.end() ? std::optional(it->elevation_deg) : number_in(angle, 1, 90);
    if (!degrees) degrees = number_in(angle, -90, -1);
    if (!degrees) return std::nullopt;
    view.elevation_deg = *degrees;
    return view;
}

}  // namespace relievo
