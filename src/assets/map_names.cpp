#include "assets/map_names.h"

#include <algorithm>
#include <cctype>
#include <string>
#include <vector>

namespace relievo {

namespace {

using enum MapRole;

constexpr MapName names[] = {
    {"height", height},
    {"heightmap", height},
    {"displacement", height},
    {"displacementmap", height},
    {"displace", height},
    {"disp", height},
    {"dsp", height},
    {"hgt", height},
    {"ht", height},
    {"hm", height},
    {"h", height},
    {"relief", height, 1},
    {"parallax", height, 1},
    {"pom", height, 1},
    {"bump", height, 2},  // often a high-pass of the height, or computed from the normals
    {"bumpmap", height, 2},
    {"bmp", height, 2},
    {"depth", height, 2, "depth"},
    {"depthmap", height, 2, "depth"},

    {"normal", normal, 1},
    {"normals", normal, 1},
    {"normalmap", normal, 1},
    {"norm", normal, 1},
    {"nor", normal, 1},
    {"nrm", normal, 1},
    {"nrml", normal, 1},
    {"nml", normal, 1},
    {"nmap", normal, 1},
    {"nm", normal, 1},
    {"n", normal, 1},
    {"ddn", normal, 1},
    {"nrmrgh", normal, 1},  // roughness packed into the alpha
    {"norgl", normal, 0, "up"},
    {"nrmgl", normal, 0, "up"},
    {"normgl", normal, 0, "up"},
    {"normalgl", normal, 0, "up"},
    {"normalogl", normal, 0, "up"},
    {"normalopengl", normal, 0, "up"},
    {"noropengl", normal, 0, "up"},
    {"normalmapopengl", normal, 0, "up"},
    {"nordx", normal, 2, "down"},
    {"nrmdx", normal, 2, "down"},
    {"normdx", normal, 2, "down"},
    {"normaldx", normal, 2, "down"},
    {"normaldirectx", normal, 2, "down"},
    {"nordirectx", normal, 2, "down"},
    {"normalmapdirectx", normal, 2, "down"},

    {"colour", colour},
    {"color", colour},
    {"colormap", colour},
    {"col", colour},
    {"clr", colour},
    {"cc", colour},
    {"c", colour},
    {"basecolor", colour},
    {"basecolour", colour},
    {"basecol", colour},
    {"base", colour, 1},
    {"bc", colour},
    {"albedo", colour},
    {"alb", colour},
    {"albht", colour},  // height packed into the alpha
    {"diffuse", colour},
    {"diffusemap", colour},
    {"diff", colour},
    {"dif", colour},
    {"d", colour},

    {"ao", ignored},
    {"occ", ignored},
    {"occlusion", ignored},
    {"ambient", ignored},
    {"ambientocclusion", ignored},
    {"cavity", ignored},
    {"curvature", ignored},
    {"rough", ignored},
    {"roughness", ignored},
    {"rgh", ignored},
    {"gloss", ignored},
    {"glossiness", ignored},
    {"smooth", ignored},
    {"smoothness", ignored},
    {"refl", ignored},
    {"reflection", ignored},
    {"metal", ignored},
    {"metallic", ignored},
    {"metalness", ignored},
    {"metallicroughness", ignored},
    {"metalroughness", ignored},
    {"met", ignored},
    {"mtl", ignored},
    {"arm", ignored},
    {"orm", ignored},
    {"rma", ignored},
    {"specular", ignored},
    {"spec", ignored},
    {"spc", ignored},
    {"opacity", ignored},
    {"alpha", ignored},
    {"mask", ignored},
    {"transmission", ignored},
    {"translucency", ignored},
    {"emission", ignored},
    {"emissive", ignored},
    {"emit", ignored},
    {"glow", ignored},
    {"preview", ignored},
    {"thumb", ignored},
    {"thumbnail", ignored},
    {"render", ignored},
    {"sphere", ignored},
    {"id", ignored},
    {"s", ignored},
    {"r", ignored},
    {"m", ignored},
    {"e", ignored},
};

std::vector<std::string> parts_of(std::string_view stem) {
    std::vector<std::string> parts(1);
    char before = 0;
    for (const char c : stem) {
        const auto u = static_cast<unsigned char>(c);
        const bool new_word = std::isupper(u) && std::islower(static_cast<unsigned char>(before));
        if (!std::isalnum(u) || new_word) parts.emplace_back();
        if (std::isalnum(u)) parts.back() += static_cast<char>(std::tolower(u));
        before = c;
    }
    for (std::string& part : parts)
        while (!part.empty() && std::isdigit(static_cast<unsigned char>(part.back()))) part.pop_back();
    std::erase(parts, std::string{});
    return parts;
}

}  // namespace

std::span<const MapName> map_names() { return names; }

const MapName* find_map_name(std::string_view stem) {
    const std::vector<std::string> parts = parts_of(stem);
    for (std::size_t end = parts.size(); end > 0; --end) {
        for (std::size_t count = std::min<std::size_t>(3, end); count > 0; --count) {
            std::string word;
            for (std::size_t i = end - count; i < end; ++i) word += parts[i];
            if (word.size() == 1 && (end != parts.size() || end < 2)) continue;
            const auto found = std::find_if(std::begin(names), std::end(names), [&](const MapName& n) { return n.word == word; });
            if (found != std::end(names)) return found;
        }
    }
    return nullptr;
}

}  // namespace relievo
