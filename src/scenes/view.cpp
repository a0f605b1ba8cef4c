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

std::optional<View> parse_view(std::string_view text) {
    const auto table = views();
    const auto it = std::ranges::find(table, text, &View::id);
    if (it != table.end()) return *it;
    double degrees = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), degrees);
    if (error != std::errc{} || end != text.data() + text.size() || !(degrees >= 1 && degrees <= 90)) return std::nullopt;
    return View{.id = std::string(text), .elevation_deg = degrees};
}

}  // namespace relievo
