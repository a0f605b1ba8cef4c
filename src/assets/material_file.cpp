#include "assets/material_file.h"

#include "assets/image_file.h"
#include "assets/map_agreement.h"
#include "assets/map_names.h"
#include "assets/material_sidecar.h"
#include "core/error.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string_view>
#include <system_error>

namespace relievo {

namespace {

namespace fs = std::filesystem;

// Endings of pictures among a folder's other files (licences, previews of 3D tools, the sidecar).
constexpr std::string_view picture_endings[] = {".png",  ".jpg", ".jpeg", ".tga", ".exr", ".tif",
                                                ".tiff", ".hdr", ".dds",  ".bmp", ".webp"};

std::string number(double x, const char* format = "%.3g") {
    char text[64];
    std::snprintf(text, sizeof text, format, x);
    return text;
}

std::vector<fs::path> pictures_in(const fs::path& folder) {
    std::error_code error;
    const auto status = fs::status(folder, error);
    if (!fs::exists(status))
        throw Error("load material", folder.string(),
                    error && error != std::errc::no_such_file_or_directory ? error.message() : "there is no such folder",
                    "check the spelling of the path");
    if (!fs::is_directory(status))
        throw Error("load material", folder.string(), "it is a file, not a folder",
                    "name the folder that holds the maps, or the files one by one");
    std::vector<fs::path> pictures;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        std::string ending = it->path().extension().string();
        std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
        const bool hidden = it->path().filename().string().front() == '.';
        if (!hidden && std::find(std::begin(picture_endings), std::end(picture_endings), ending) != std::end(picture_endings))
            pictures.push_back(it->path());
    }
    if (error) throw Error("read folder", folder.string(), error.message(), "check the folder's permissions");
    std::sort(pictures.begin(), pictures.end());  // the file system's order is nobody's choice
    return pictures;
}

std::string list_of(const std::vector<fs::path>& files) {
    std::string text;
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (i == 8) return text + ", ... (" + std::to_string(files.size()) + " in all)";
        text += (i ? ", " : "") + files[i].filename().string();
    }
    return text;
}

// Luma of ITU-R BT.601, which is what JPEG stores: of a grey JPEG saved in colour exactly the grey remains and the noise of the
// chroma planes cancels.
float luma(const float* rgb) {
    if (rgb[0] == rgb[1] && rgb[1] == rgb[2]) return rgb[0];  // grey in three copies keeps every bit
    return 0.299f * rgb[0] + 0.587f * rgb[1] + 0.114f * rgb[2];
}

// Mean difference between the largest and the smallest channel. Of 30 real height maps none exceeds 0.01 (JPEG and palettes leave
// that much); of their colours those that are not all but grey begin at 0.045. A grey photograph cannot be told from a height.
constexpr double colour_chroma = 0.03;
constexpr double noted_chroma = 0.012;

HeightField read_height(const fs::path& file, std::vector<std::string>& notes) {
    const ImageFileInfo info = read_image_info(file);
    ImageF image = read_image(file);
    const bool rgb = image.channels >= 3;
    if (rgb) {
        double chroma = 0;
        float least = std::numeric_limits<float>::infinity();
        float most = -least;
        for (std::size_t i = 0; i < image.texels.size(); i += static_cast<std::size_t>(image.channels)) {
            const auto [low, high] = std::minmax({image.texels[i], image.texels[i + 1], image.texels[i + 2]});
            if (!std::isfinite(low) || !std::isfinite(high)) continue;
            chroma += static_cast<double>(high - low);
            least = std::min(least, low);
            most = std::max(most, high);
        }
        chroma /= static_cast<double>(image.width) * image.height;
        // Floats have no fixed unit; the range they use is theirs.
        if (info.floating) chroma = most > least ? chroma / static_cast<double>(most - least) : 0;
        if (chroma > colour_chroma)
            throw Error("load height map", file.string(),
                        "it is a colour picture: its channels differ by " + number(chroma) + " on average (grey stays below " +
                            number(colour_chroma) + ")",
                        "a height is one grey value per texel; name the right file, or convert this one to grey if it is meant");
        if (chroma > noted_chroma)
            notes.push_back("the height map is slightly coloured (its channels differ by " + number(chroma) +
                            " on average); its luma is used");
    }
    HeightField field(image.width, image.height);
    std::size_t broken = 0;
    std::size_t first_broken = 0;
    for (std::size_t i = 0; i < field.texels.texels.size(); ++i) {
        const float* texel = &image.texels[i * static_cast<std::size_t>(image.channels)];
        const float h = rgb ? luma(texel) : texel[0];
        if (!std::isfinite(h) && broken++ == 0) first_broken = i;
        field.texels.texels[i] = h;
    }
    if (broken) {
        const auto width = static_cast<std::size_t>(image.width);
        const auto row = static_cast<std::size_t>(image.height) - 1 - first_broken / width;
        throw Error("load height map", file.string(),
                    std::to_string(broken) + " of its texels are NaN or infinite, one of them in column " +
                        std::to_string(first_broken % width) + ", row " + std::to_string(row) + " from the top",
                    "fill them in an image editor (\"fix NaN\", inpainting) or export the map again");
    }
    const auto [low, high] = std::minmax_element(field.texels.texels.begin(), field.texels.texels.end());
    const float least = *low;
    const float most = *high;
    if (least < 0 || most > 1) {
        const float range = most - least;
        if (!std::isfinite(range))
            throw Error("load height map", file.string(), "its heights run from " + number(least) + " to " + number(most),
                        "scale them into [0,1]");
        for (float& h : field.texels.texels) h = range > 0 ? (h - least) / range : 0.5f;
        notes.push_back("heights run from " + number(least, "%.6g") + " to " + number(most, "%.6g") + "; scaled to [0,1]");
    } else if (least == most) {
        notes.push_back("the height map is flat: every texel is " + number(least));
    }
    return field;
}

ImageF read_normal(const fs::path& file, std::vector<std::string>& notes) {
    const ImageFileInfo info = read_image_info(file);
    if (info.channels < 2 || (info.channels == 2 && info.format == "png"))  // a PNG's second channel of two is alpha
        throw Error("load normal map", file.string(), "it is grey", "a normal map has red and green at least; is this a height?");
    const ImageF image = read_image(file);
    ImageF normal(image.width, image.height, 3);
    // Two channels (BC5) hold x and y; z follows from the length.
    const bool rebuild_z = image.channels == 2;
    // Floating files may hold the components themselves in [-1,1]; any value below 0 says so.
    const bool is_signed = info.floating && std::any_of(image.texels.begin(), image.texels.end(), [](float x) { return x < 0; });
    const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    std::size_t unset = 0;
    std::size_t unusable = 0;
    double chroma = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const float* texel = &image.texels[i * static_cast<std::size_t>(image.channels)];
        const auto component = [&](int c) { return is_signed ? texel[c] : 2 * texel[c] - 1; };
        const float x = component(0);
        const float y = component(1);
        const float z = rebuild_z ? std::sqrt(std::max(0.0f, 1 - x * x - y * y)) : component(2);
        const float length = std::sqrt(x * x + y * y + z * z);
        float* out = &normal.texels[i * 3];
        // Bakers leave black where the mesh has no texels; no surface is meant there, and straight up disturbs least. The same
        // goes for single texels that look below the plane or have no direction at all.
        const bool black = !rebuild_z && !is_signed && std::max({texel[0], texel[1], texel[2]}) < 0.03f;
        if (black || !std::isfinite(length) || length < 0.1f || z < 0) {
            (black ? unset : unusable) += 1;
            out[2] = 1;
            continue;
        }
        if (!rebuild_z)
            chroma += static_cast<double>(std::max({texel[0], texel[1], texel[2]}) - std::min({texel[0], texel[1], texel[2]}));
        out[0] = x / length, out[1] = y / length, out[2] = z / length;
    }
    const auto percent = [&](std::size_t part) {
        return number(100.0 * static_cast<double>(part) / static_cast<double>(count)) + " %";
    };
    // A tangent-space map has all its normals above the plane but for strays of compression.
    if (static_cast<double>(unusable) > 0.25 * static_cast<double>(count - unset) || unset == count)
        throw Error("load normal map", file.string(),
                    percent(unusable + unset) + " of its texels are no normals of a surface seen from above",
                    "is it a colour, or an object-space normal map?");
    if (!rebuild_z && chroma < colour_chroma * static_cast<double>(count - unset - unusable))
        throw Error("load normal map", file.string(), "it is grey", "is it a height?");
    if (unset + unusable > count / 1000)
        notes.push_back(percent(unset + unusable) + " of the normal map is black or looks below the plane; read as straight up");
    return normal;
}

Image8 read_colour(const fs::path& file) {
    Image8 image = read_image_8(file);
    if (image.channels == 4) return image;
    Image8 rgba(image.width, image.height, 4);
    const std::size_t count = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
    const auto channels = static_cast<std::size_t>(image.channels);
    for (std::size_t i = 0; i < count; ++i) {
        const std::uint8_t* from = &image.texels[i * channels];
        std::uint8_t* to = &rgba.texels[i * 4];
        for (std::size_t c = 0; c < 3; ++c) to[c] = channels >= 3 ? from[c] : from[0];
        to[3] = channels == 2 ? from[1] : channels > 3 ? from[3] : 255;
    }
    return rgba;
}

std::string name_of(const MaterialFiles& files) {
    if (!files.name.empty()) return files.name;
    for (const auto* file : {&files.height, &files.normal, &files.colour})
        if (*file) return (*file)->stem().string();
    return "material";
}

// "-0.97 in x and +0.97 in y at 128 x 128 texels"
std::string figures_of(const MapAgreement& a) {
    if (a.width == 0) return "too small to compare";
    return number(a.x, "%+.2f") + " in x and " + number(a.y, "%+.2f") + " in y at " + std::to_string(a.width) + " x " +
           std::to_string(a.height) + " texels";
}

std::string_view meaning_of_name(const fs::path& file) {
    const MapName* name = find_map_name(file.stem().string());
    return name ? name->meaning : std::string_view{};
}

// Whether white is low. Whoever wrote the sidecar knows; then the two maps; then the file's name; then the custom.
bool is_inverted(const MaterialFiles& files, const MaterialSidecar& sidecar, const std::optional<MapAgreement>& agreement,
                 std::vector<std::string>& notes) {
    const MapReading reading = agreement ? read_agreement(*agreement) : MapReading{};
    const std::string evidence = agreement ? "slopes of height and normals correlate " + figures_of(*agreement) : "";
    if (sidecar.white_is_high) {
        const bool inverted = !*sidecar.white_is_high;
        if (reading.polarity_decided && reading.inverted != inverted)
            notes.push_back(std::string("material.toml says white is ") + (inverted ? "low" : "high") +
                            ", and is obeyed, but the maps say the opposite: " + evidence);
        return inverted;
    }
    if (reading.polarity_decided) {
        notes.push_back((reading.inverted ? "height reads as depth (white is low) and was inverted: "
                                          : "height reads as height (white is high): ") +
                        evidence);
        return reading.inverted;
    }
    const bool inverted = meaning_of_name(*files.height) == "depth";
    const std::string because = inverted
                                    ? "white taken as low, from the name " + files.height->filename().string() + ", and inverted"
                                    : "white taken as high";
    notes.push_back(because + (agreement ? "; the maps leave it undecided: slopes correlate " + figures_of(*agreement)
                                         : "; there is no normal map to check it against"));
    return inverted;
}

bool is_green_down(const MaterialFiles& files, const MaterialSidecar& sidecar, const std::optional<MapAgreement>& agreement,
                   std::vector<std::string>& notes) {
    MapReading reading = agreement ? read_agreement(*agreement) : MapReading{};
    if (sidecar.white_is_high && !reading.polarity_decided && !*sidecar.white_is_high)
        reading.green_down = reading.green_decided && !reading.green_down;
    const std::string evidence = agreement ? "slopes of height and normals correlate " + figures_of(*agreement) : "";
    if (sidecar.normal_y_up) {
        const bool down = !*sidecar.normal_y_up;
        if (reading.green_decided && reading.green_down != down)
            notes.push_back(std::string("material.toml says green points ") + (down ? "down" : "up") +
                            ", and is obeyed, but the maps say the opposite: " + evidence);
        return down;
    }
    if (reading.green_decided) {
        notes.push_back(std::string("green of the normals points ") +
                        (reading.green_down ? "down (DirectX) and was flipped" : "up (OpenGL)") +
                        (reading.polarity_decided && !sidecar.white_is_high ? ", by the same figures" : ": " + evidence));
        return reading.green_down;
    }
    const bool down = meaning_of_name(*files.normal) == "down";
    const bool named = down || meaning_of_name(*files.normal) == "up";
    notes.push_back(std::string("green of the normals taken as ") + (down ? "down (DirectX) and flipped" : "up (OpenGL)") +
                    (named ? ", from the name " + files.normal->filename().string() : "") +
                    (agreement ? "; the maps leave it undecided: slopes correlate " + figures_of(*agreement)
                               : "; there is no height map to check it against"));
    return down;
}

// Agreement (root mean square of the two correlations) from which the implied amplitude is a measurement rather than a rumour.
constexpr double strong_agreement = 0.8;
// Sets exist whose normals are drawn so weak that their relief would be a thousandth of the tile: nothing to see, nothing to
// compare. Nor is relief deeper than an eighth of the tile what a texture is for.
constexpr float least_height_scale = 0.02f;
constexpr float most_height_scale = 0.12f;

float height_scale_of(const MaterialSidecar& sidecar, const std::optional<MapAgreement>& agreement,
                      std::vector<std::string>& notes) {
    if (sidecar.height_scale) return *sidecar.height_scale;
    const float usual = Material{}.height_scale;
    if (!agreement) {
        notes.push_back("height_scale " + number(usual) + " assumed");
        return usual;
    }
    const double strength = std::sqrt((agreement->x * agreement->x + agreement->y * agreement->y) / 2);
    if (strength < strong_agreement) {
        notes.push_back("height_scale " + number(usual) + " assumed: the maps agree too little (" + number(strength, "%.2f") +
                        ") to imply one");
        return usual;
    }
    const auto implied = static_cast<float>(agreement->height_scale);
    const float used = std::clamp(implied, least_height_scale, most_height_scale);
    notes.push_back("height_scale " + number(used) +
                    (used == implied ? " follows from the slopes of height and normals"
                                     : "; the slopes of height and normals together imply " + number(implied) +
                                           ", which is outside the useful range " + number(least_height_scale) + " to " +
                                           number(most_height_scale)));
    return used;
}

}  // namespace

MaterialFiles find_material_files(const fs::path& folder, std::vector<std::string>& notes) {
    const std::vector<fs::path> pictures = pictures_in(folder);
    std::error_code ignored;
    MaterialFiles files;
    files.name = fs::weakly_canonical(folder, ignored).filename().string();
    if (fs::exists(folder / "material.toml", ignored)) files.sidecar = folder / "material.toml";

    const auto choose = [&](MapRole role, const char* role_name) -> std::optional<fs::path> {
        std::vector<fs::path> candidates;
        int best = 0;
        std::string passed_over;
        for (const fs::path& file : pictures) {
            const MapName* name = find_map_name(file.stem().string());
            if (!name || name->role != role) continue;
            if (!candidates.empty() && name->rank > best) {
                passed_over += (passed_over.empty() ? "" : ", ") + file.filename().string();
                continue;
            }
            if (!candidates.empty() && name->rank < best) {
                for (const fs::path& worse : candidates)
                    passed_over += (passed_over.empty() ? "" : ", ") + worse.filename().string();
                candidates.clear();
            }
            best = name->rank;
            candidates.push_back(file);
        }
        if (candidates.empty()) return std::nullopt;
        if (candidates.size() > 1 && role != MapRole::colour)
            throw Error("load material", folder.string(),
                        std::string("it has several ") + role_name + " maps: " + list_of(candidates),
                        std::string("name one under [files] in its material.toml: ") + role_name + " = \"" +
                            candidates.front().filename().string() + "\"");
        for (std::size_t i = 1; i < candidates.size(); ++i)
            passed_over += (passed_over.empty() ? "" : ", ") + candidates[i].filename().string();
        if (!passed_over.empty())
            notes.push_back(std::string(role_name) + " is " + candidates.front().filename().string() + ", not " + passed_over);
        return candidates.front();
    };
    MaterialSidecar sidecar;
    if (files.sidecar) sidecar = read_sidecar(*files.sidecar);
    const auto find = [&](const std::optional<std::string>& named, MapRole role, const char* role_name) -> std::optional<fs::path> {
        if (named) return folder / *named;
        return choose(role, role_name);
    };
    files.colour = find(sidecar.colour, MapRole::colour, "colour");
    files.height = find(sidecar.height, MapRole::height, "height");
    files.normal = find(sidecar.normal, MapRole::normal, "normal");
    if (!files.height && !files.normal) {
        const std::string advice =
            "a material needs a height or a normal map, with a name like height.png, rock_disp.png, rock_normal.png or "
            "rock_nor_gl.exr";
        if (pictures.empty()) throw Error("load material", folder.string(), "there is no picture in it", advice);
        throw Error("load material", folder.string(),
                    "none of its pictures is a height or a normal map by its name: " + list_of(pictures), advice);
    }
    return files;
}

Material load_material(const MaterialFiles& files) {
    Material material;
    material.name = name_of(files);
    if (!files.height && !files.normal)
        throw Error("load material", material.name, "neither height nor normal was given", "name at least one of the two");
    MaterialSidecar sidecar;
    if (files.sidecar) sidecar = read_sidecar(*files.sidecar);
    if (files.height) material.height = read_height(*files.height, material.notes);
    if (files.normal) material.normal = read_normal(*files.normal, material.notes);
    if (files.colour) {
        material.colour = read_colour(*files.colour);
    } else {
        material.notes.push_back("no colour map; a neutral grey stands in");
    }

    std::optional<MapAgreement> agreement;
    if (files.height && files.normal) agreement = compare_maps(material.height, *material.normal);
    if (files.height && is_inverted(files, sidecar, agreement, material.notes))
        for (float& h : material.height.texels.texels) h = 1 - h;
    if (files.normal && is_green_down(files, sidecar, agreement, material.notes))
        for (std::size_t i = 1; i < material.normal->texels.size(); i += 3) material.normal->texels[i] *= -1;

    material.height_scale = height_scale_of(sidecar, agreement, material.notes);
    if (sidecar.zero_level)
        material.zero_level = *sidecar.zero_level;
    else
        material.notes.push_back("zero_level " + number(material.zero_level) + " assumed: the relief is carved below the polygon");
    material.physical_size_m = sidecar.physical_size_m;
    return material;
}

Material load_material(const fs::path& folder) {
    std::vector<std::string> notes;
    const MaterialFiles files = find_material_files(folder, notes);
    Material material = load_material(files);
    material.notes.insert(material.notes.begin(), notes.begin(), notes.end());
    return material;
}

}  // namespace relievo
