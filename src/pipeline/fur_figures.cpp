#include "pipeline/fur_figures.h"

#include "assets/image_file.h"
#include "assets/mesh_file.h"
#include "mesh/made_up_scan.h"
#include "pipeline/classic_picture.h"
#include "pipeline/fur_picture.h"
#include "pipeline/lapped_picture.h"
#include "pipeline/replicate_fur.h"
#include "pipeline/scratch_folder.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace relievo {

namespace {

// A square sheet that bulges toward +z, with texture coordinates.
Mesh bulge(std::uint32_t cells) {
    Mesh mesh;
    mesh.name = "bulge";
    const std::uint32_t row = cells + 1;
    for (std::uint32_t i = 0; i < row * row; ++i) {
        const double u = static_cast<double>(i % row) / cells, v = static_cast<double>(i / row) / cells, x = 2 * u - 1, y = 2 * v - 1;
        mesh.positions.push_back(Vec3f(Vec3d(x, y, 0.5 * (1 - x * x) * (1 - y * y))));
        mesh.uvs.push_back(Vec2f(Vec2d(u, v)));
    }
    for (std::uint32_t y = 0; y < cells; ++y)
        for (std::uint32_t x = 0; x < cells; ++x) {
            const std::uint32_t a = y * row + x, b = a + 1, c = b + row, d = a + row;
            mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
        }
    return mesh;
}

// A flow map whose fur circles its middle, where it stands up, and is left as it was outside the circle.
ImageF swirl(int size) {
    ImageF picture(size, size, 4, 0.0f);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const double u = 2 * (x + 0.5) / size - 1, v = 2 * (y + 0.5) / size - 1, r = std::hypot(u, v);
            const double lean = std::min(1.0, r / 0.3), weight = std::clamp((0.95 - r) / 0.1, 0.0, 1.0);
            const auto code = [](double d) { return static_cast<float>((128 + 127 * d) / 255); };
            picture(x, y, 0) = code(-v / r * lean);
            picture(x, y, 1) = code(u / r * lean);
            picture(x, y, 2) = code(0);
            picture(x, y, 3) = static_cast<float>(weight);
        }
    return picture;
}

// Its colours on white as far as it holds, rows from the top, in a frame of that size.
Image8 shown(const ImageF& flow, int width, int height) {
    Image8 picture(width, height, 3, 255);
    const int left = (width - flow.width) / 2, top = (height - flow.height) / 2;
    for (int y = 0; y < flow.height; ++y)
        for (int x = 0; x < flow.width; ++x)
            for (int c = 0; c < 3; ++c) {
                const float* texel = flow.at(x, flow.height - 1 - y);
                picture(left + x, top + y, c) = static_cast<std::uint8_t>(255 * (1 - texel[3] * (1 - texel[c])) + 0.5f);
            }
    return picture;
}

Image8 row_of(const std::vector<Image8>& pictures) {
    Image8 row = pictures[0];
    for (std::size_t i = 1; i < pictures.size(); ++i) row = side_by_side(row, pictures[i]);
    return row;
}

// The right half.
Image8 reference_of(const Image8& beside) {
    Image8 right(beside.width / 2, beside.height, 3);
    for (int y = 0; y < right.height; ++y) std::copy_n(beside.at(right.width, y), right.width * 3, right.at(0, y));
    return right;
}

}  // namespace

void write_fur_figures(const std::filesystem::path& folder, const std::string& device, int threads) {
    const ScratchFolder scratch;
    const std::filesystem::path scan = scratch.path / "scan.rmesh", torus = scratch.path / "torus.rmesh";
    save_mesh(scan, made_up_scan({.faces = 16000, .threads = threads}), threads);
    save_mesh(torus, torus_mesh(96, 48), threads);

    ClassicSettings classic{.width_px = 420, .height_px = 400, .passes = 16, .device = device, .threads = threads};
    classic.light.specular = 0.2f;
    const auto drawn = [&](const std::filesystem::path& mesh) { return classic_picture(mesh, classic).picture; };
    std::vector<Image8> pictures;
    for (const AddressingEntry& a : addressings) {
        classic.addressing = a.addressing;
        pictures.push_back(drawn(scan));
    }
    write_png(folder / "fur-addressing.png", row_of(pictures), FirstRow::top);

    pictures.clear();
    for (const auto& [shape, size] : {std::pair{MapShape::cube, 128}, std::pair{MapShape::cube, 256}, std::pair{MapShape::sphere, 1024}}) {
        classic.shape = shape;
        classic.map.width = size;
        pictures.push_back(drawn(torus));
    }
    write_png(folder / "fur-maps.png", row_of(pictures), FirstRow::top);

    // Every mode wears the same coat: that which the maps stand for.
    classic.shape = MapShape::cube;
    classic.map.width = 256;
    classic.width_px = 360;
    classic.height_px = 300;
    classic.reference_samples = 16;
    classic.fit_light = true;
    const FurPicture by_direction = classic_picture(torus, classic);
    std::vector<std::string> notes;
    const Coat coat = upright_coat(classic, strands_on(classic_fur_map(classic, notes)));
    const FurPicture patches = lapped_picture(torus, {.coat = coat, .fit_light = true, .width = 360, .height = 300, .device = device, .reference_samples = 1, .threads = threads});
    const FurPicture strands = fur_picture(torus, {.coat = coat, .width = 360, .height = 300, .device = device, .threads = threads});
    write_png(folder / "fur-modes.png", row_of({by_direction.picture, patches.picture, strands.picture, reference_of(by_direction.beside)}), FirstRow::top);

    // The same strands in shells, plotted and traced.
    FurSettings rabbit{.mode = FurKind::shells, .width = 420, .height = 400, .device = device, .threads = threads};
    const FurPicture shells = fur_picture(scan, rabbit);
    rabbit.mode = FurKind::strands;
    rabbit.reference_samples = 16;
    write_png(folder / "fur-plotted.png", side_by_side(shells.picture, fur_picture(scan, rabbit).beside), FirstRow::top);

    // Combed by itself, and as a flow map says.
    const std::filesystem::path sheet = scratch.path / "bulge.rmesh";
    save_mesh(sheet, bulge(96), threads);
    const CoatPreset& fox = *std::ranges::find(coat_presets(), "fox", &CoatPreset::id);
    FurSettings combed{.coat = fox.coat, .width = 360, .height = 360, .device = device, .threads = threads};
    const FurPicture by_itself = fur_picture(sheet, combed);
    const ImageF flow = swirl(280);
    combed.growth.comb.picture = std::make_shared<const ImageF>(flow);
    combed.reference_samples = 16;
    write_png(folder / "fur-combed.png", row_of({shown(flow, 360, 360), by_itself.picture, fur_picture(sheet, combed).beside}), FirstRow::top);
}

}  // namespace relievo
