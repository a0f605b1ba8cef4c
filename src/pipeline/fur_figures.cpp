#include "pipeline/fur_figures.h"

#include "assets/image_file.h"
#include "assets/mesh_file.h"
#include "mesh/made_up_scan.h"
#include "pipeline/classic_picture.h"
#include "pipeline/fur_picture.h"
#include "pipeline/lapped_picture.h"
#include "pipeline/replicate_fur.h"
#include "pipeline/scratch_folder.h"

#include <vector>

namespace relievo {

namespace {

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
}

}  // namespace relievo
