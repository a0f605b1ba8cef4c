#include "pipeline/classic_picture.h"

#include "assets/image_file.h"
#include "assets/mesh_file.h"
#include "core/error.h"
#include "fur/carried_values.h"
#include "fur/facing.h"
#include "fur/map_strands.h"
#include "mesh/index_order.h"
#include "mesh/indexing.h"
#include "mesh/normals.h"
#include "pipeline/fur_reference.h"
#include "pipeline/fur_space.h"
#include "pipeline/grown_fur.h"
#include "pipeline/timer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <memory>

namespace relievo {

namespace {

int faces_of(MapShape shape) {
    for (const MapShapeEntry& e : map_shapes)
        if (e.shape == shape) return e.faces;
    return 0;
}

// Of the symmetric system, by elimination; a variable that nothing depends on is 0.
std::array<double, 3> solved(std::array<std::array<double, 3>, 3> m, std::array<double, 3> b, const std::array<bool, 3>& used) {
    for (std::size_t i = 0; i < 3; ++i)
        if (!used[i]) {
            for (std::size_t k = 0; k < 3; ++k) m[i][k] = m[k][i] = 0;
            m[i][i] = 1;
            b[i] = 0;
        }
    for (std::size_t i = 0; i < 3; ++i) {
        if (!(m[i][i] > 1e-12)) continue;
        for (std::size_t r = i + 1; r < 3; ++r) {
            const double f = m[r][i] / m[i][i];
            for (std::size_t c = i; c < 3; ++c) m[r][c] -= f * m[i][c];
            b[r] -= f * b[i];
        }
    }
    std::array<double, 3> x{};
    for (std::size_t i = 3; i-- > 0;) {
        double v = b[i];
        for (std::size_t c = i + 1; c < 3; ++c) v -= m[i][c] * x[c];
        x[i] = m[i][i] > 1e-12 ? v / m[i][i] : 0;
    }
    return x;
}

void require_area(const Mesh& mesh) {
    for (std::uint32_t f = 0; f < mesh.faces(); ++f)
        if (length(face_vector(mesh, f)) > 0) return;
    throw Error("grow fur on", mesh.name, "all its faces are collapsed");
}

}  // namespace

PaintedSkin classic_skin(Mesh mesh, const CombPaint& comb, int threads) {
    mesh = in_fur_space(std::move(mesh), threads);
    // The thesis' own normals, and the order that draws quickest here.
    mesh.normals = continuous_normals(mesh, NormalMode::distinct, threads);
    const std::vector<PaintedLean> painted = painted_on(mesh, comb, threads);
    if (!painted.empty()) mesh = carrying(mesh, {}, painted);
    else mesh.uvs.clear(), mesh.colours.clear();
    mesh = ordered(indexed(std::move(mesh), threads), {.threads = threads});
    require_area(mesh);
    PaintedSkin skin;
    skin.painted = taken_off(mesh, false, !painted.empty()).painted;
    skin.mesh = std::move(mesh);
    return skin;
}

ClassicSettings classic_of(const Coat& coat) {
    ClassicSettings classic;
    classic.height = coat.length;
    classic.colour = coat.tip_colour;
    classic.skin = coat.root_colour;
    classic.gloss = coat.gloss;
    return classic;
}

Evenness classic_evenness(const Mesh& mesh, const MapStrands& grown, const DirectionMap& fur, int threads) {
    // A strand of the map grows wherever its direction is met, on scans ten times and more. The discs of the measure are as large as if all
    // grew once, which is what the map's size and density ask for; smaller ones would find still more unevenness.
    const double times = static_cast<double>(grown.roots.roots.size()) / static_cast<double>(std::max<std::size_t>(strands_on(fur), 1));
    const double per_disc = EvennessSettings{}.strands_per_disc * std::max(times, 1.0);
    return evenness(mesh, grown.roots, grown.strands, {.strands_per_disc = per_disc, .extent = 1, .threads = threads});
}

std::size_t strands_on(const DirectionMap& fur) {
    std::size_t strands = 0;
    for (const std::vector<Image8>& face : fur.faces)
        for (std::size_t t = 3; t < face.front().texels.size(); t += 4) strands += face.front().texels[t] > 0;
    return strands;
}

DirectionMap classic_fur_map(const ClassicSettings& s, std::vector<std::string>& notes) {
    std::vector<Image8> faces;
    std::size_t strands = 0, wanted = 0;
    for (int f = 0; f < faces_of(s.shape); ++f) {
        FurMapSettings face = s.map;
        face.height = face.width;
        face.seed = s.map.seed + 1000003u * static_cast<std::uint32_t>(f);
        FurMap map = fur_map(face);
        strands += map.strands;
        wanted += map.wanted;
        faces.push_back(std::move(map.texels));
    }
    if (strands < wanted)
        notes.push_back("the neighbourhood leaves room for " + std::to_string(strands) + " of " + std::to_string(wanted) + " strands on the fur map");
    return direction_map(s.shape, std::move(faces), false);
}

DirectionMap classic_colour_map(const ClassicSettings& s) {
    Image8 face;
    if (s.colour_map.empty()) {
        face = Image8(s.map.width, s.map.width, 4, 255);
        const std::uint8_t rgb[] = {srgb_from_linear(s.colour.x), srgb_from_linear(s.colour.y), srgb_from_linear(s.colour.z)};
        for (std::size_t t = 0; t < face.texels.size(); t += 4) std::copy_n(rgb, 3, &face.texels[t]);
    } else {
        const Image8 picture = read_image_8(s.colour_map, FirstRow::top);
        if (picture.channels > 4) throw Error("colour fur by", s.colour_map.string(), "it has " + std::to_string(picture.channels) + " channels");
        face = square_picture(picture, s.map.width);
    }
    return direction_map(s.shape, std::vector(static_cast<std::size_t>(faces_of(s.shape)), face), true);
}

void write_fur_map(const std::filesystem::path& file, const DirectionMap& fur, const DirectionMap* colour, DdsCode code, int threads) {
    std::vector<std::vector<Image8>> faces = fur.faces;
    if (colour != nullptr)
        for (std::size_t f = 0; f < faces.size(); ++f)
            for (std::size_t k = 0; k < faces[f].size(); ++k)
                for (std::size_t t = 0; t < faces[f][k].texels.size(); t += 4) std::copy_n(&colour->faces[f][k].texels[t], 3, &faces[f][k].texels[t]);
    if (file.extension() == ".dds") return write_dds(file, faces, code, threads);
    const int edge = fur.size();
    Image8 strip(edge * static_cast<int>(faces.size()), edge, 4);
    for (int f = 0; f < static_cast<int>(faces.size()); ++f)
        for (int y = 0; y < edge; ++y) std::copy_n(faces[static_cast<std::size_t>(f)][0].at(0, y), edge * 4, strip.at(f * edge, y));
    write_png(file, strip, FirstRow::top);
}

LayersModel classic_model(const ClassicSettings& s, const Mesh& mesh, const DirectionMap& fur, const DirectionMap& colour, const std::vector<Vec3f>* comb) {
    return {.mesh = &mesh, .fur = &fur, .colour = &colour, .addressing = s.addressing, .comb = comb, .tilt = s.tilt, .bend = s.bend, .filtered = s.filtered, .height = s.height, .light = s.light, .skin = s.skin};
}

Coat upright_coat(const ClassicSettings& s, std::size_t strands) {
    Coat coat;
    coat.strands = static_cast<float>(strands);
    coat.length = s.height;
    coat.tilt = coat.bend = coat.spread = 0;
    coat.length_variation = coat.lock = coat.colour_variation = coat.countershade = coat.guard_hairs = 0;
    coat.taper = 1;
    // Strands of the thesis are as thick at the tip as at the root. The bluntest there are here have radius 1 - t^4, whose square is
    // 1 - 2/5 + 1/9 in the mean: so much wider they are, and fill the same volume.
    coat.width = static_cast<float>(std::sqrt(s.map.density / (3.141592653589793 * (1 - 2.0 / 5 + 1.0 / 9))));
    coat.root_colour = coat.tip_colour = s.colour;
    coat.gloss = s.gloss;
    return coat;
}

LayersLight fitted_light(LayersRenderer& renderer, const FurView& view, const FurFrames& reference, const LayersLight& start) {
    const auto drawn = [&](float ambient, float diffuse, float specular) {
        renderer.set_light({.ambient = ambient, .diffuse = diffuse, .specular = specular, .power = start.power});
        return renderer.draw(view);
    };
    const FurFrames none = drawn(0, 0, 0);
    const std::array<FurFrames, 3> parts{drawn(1, 0, 0), drawn(0, 1, 0), drawn(0, 0, 1)};
    std::array<std::array<double, 3>, 3> m{};
    std::array<double, 3> b{};
    double rest = 0;
    for (std::size_t t = 0; t < none.colour.texels.size(); ++t) {
        if (none.coverage.texels[t / 3] == 0 && reference.coverage.texels[t / 3] == 0) continue;
        const auto base = static_cast<double>(none.colour.texels[t]);
        const double wanted = static_cast<double>(reference.colour.texels[t]) - base;
        std::array<double, 3> p{};
        for (std::size_t i = 0; i < 3; ++i) p[i] = static_cast<double>(parts[i].colour.texels[t]) - base;
        for (std::size_t i = 0; i < 3; ++i) {
            for (std::size_t k = 0; k < 3; ++k) m[i][k] += p[i] * p[k];
            b[i] += p[i] * wanted;
        }
        rest += wanted * wanted;
    }
    // No light is negative: the best of the fits in which some are 0.
    std::array<double, 3> best{};
    double least = rest;
    for (unsigned set = 1; set < 8; ++set) {
        const std::array<double, 3> x = solved(m, b, {(set & 1u) != 0, (set & 2u) != 0, (set & 4u) != 0});
        if (std::ranges::any_of(x, [](double v) { return v < 0; })) continue;
        double error = rest;
        for (std::size_t i = 0; i < 3; ++i) {
            error -= 2 * x[i] * b[i];
            for (std::size_t k = 0; k < 3; ++k) error += x[i] * x[k] * m[i][k];
        }
        if (error < least) {
            least = error;
            best = x;
        }
    }
    const LayersLight light{.ambient = static_cast<float>(best[0]), .diffuse = static_cast<float>(best[1]), .specular = static_cast<float>(best[2]), .power = start.power};
    renderer.set_light(light);
    return light;
}

FurPicture classic_picture(const std::filesystem::path& file, const ClassicSettings& s, const Progress& progress) {
    FurPicture result;
    result.mode = FurKind::classic;
    auto starting = std::async(std::launch::async, [&] { return std::make_unique<LayersRenderer>(s.device); });
    report(progress, "loading " + file.filename().string(), 0);
    const Timer loading;
    Mesh mesh = load_mesh(file, s.threads);
    result.ms.load = loading.ms();
    const std::unique_ptr<LayersRenderer> renderer = starting.get();
    result.device = renderer->device_name();
    const Timer timer;
    report(progress, "growing fur", 0.2);
    const Growth growth = with_pictures({.lengths = {}, .comb = s.comb, .upright = true});
    const Mesh as_painted = growth.comb.empty() ? Mesh{} : mesh;
    auto [skin, painted] = classic_skin(std::move(mesh), growth.comb, s.threads);
    mesh = std::move(skin);
    const std::vector<Vec3f> comb = upright_but_for(mesh, painted);
    result.ms.prepare = timer.ms();
    const Timer growing;
    result.notes = mesh.notes;
    const DirectionMap fur = classic_fur_map(s, result.notes), colour = classic_colour_map(s);
    result.ms.roots = growing.ms();
    if (!s.fur_map_file.empty()) write_fur_map(s.fur_map_file, fur, nullptr, s.dds_code, s.threads);
    if (!s.tinted_map_file.empty()) write_fur_map(s.tinted_map_file, fur, &colour, s.dds_code, s.threads);
    renderer->load(classic_model(s, mesh, fur, colour, painted.empty() ? nullptr : &comb));
    const FurView view{.camera = view_of_sphere({0, 0, 0}, 1 + static_cast<double>(s.height) * 0.6, s.width_px, s.height_px), .layers = s.layers, .passes = 1};
    FurView averaged = view;
    averaged.passes = s.passes;
    report(progress, "drawing", 0.5);
    FurFrames frames = renderer->draw(view);
    result.picture = shown_fur(frames);
    result.ms.first_frame = timer.ms();
    if (s.passes > 1) {
        frames = renderer->draw(averaged);
        result.picture = shown_fur(frames);
    }
    result.faces = result.layer_faces = mesh.faces();
    result.layers = s.layers;
    result.passes = s.passes;
    result.light = s.light;
    const MapStrands grown = map_strands(mesh, fur, s.addressing, s.threads);
    result.strands = grown.roots.roots.size();
    if (s.reference_samples > 0) {
        const Timer tracing;
        Coat coat = upright_coat(s, std::max<std::size_t>(strands_on(fur), 1));
        if (!painted.empty()) {
            coat.tilt = s.tilt;
            coat.bend = s.bend;
        }
        GrownFur even = painted.empty() ? grown_fur(mesh, coat, {}, s.threads) : grown_fur(as_painted, coat, growth, s.threads);
        const FurFrames reference = trace_fur(curves_of(even, coat, 4, {}, s.threads), even.mesh, coat, view, s.reference_samples, s.threads, progress);
        if (s.fit_light) {
            result.light = fitted_light(*renderer, averaged, reference, s.light);
            frames = renderer->draw(averaged);
            result.picture = shown_fur(frames);
        }
        result.score = fur_score(frames, reference, s.threads);
        result.score->reference_ms = tracing.ms();
        result.score->samples = s.reference_samples;
        result.beside = side_by_side(result.picture, shown_fur(reference));
    }
    std::ranges::sort(frames.frame_ms);
    result.ms.frame_median = frames.frame_ms[frames.frame_ms.size() / 2];
    if (s.measure) {
        report(progress, "measuring", 0.9);
        result.evenness = classic_evenness(mesh, grown, fur, s.threads);
    }
    result.frames = std::move(frames);
    report(progress, "drawing", 1);
    return result;
}

}  // namespace relievo
