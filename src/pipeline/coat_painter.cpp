#include "pipeline/coat_painter.h"

#include "core/error.h"
#include "fur/likeness.h"
#include "fur/painted_comb.h"
#include "fur/strand_grid.h"
#include "mesh/normals.h"
#include "pipeline/classic_picture.h"
#include "pipeline/fur_painter.h"
#include "pipeline/lapped_picture.h"

namespace relievo {

namespace {

bool is_bald(const Coat& coat) { return !(coat.length > 0) || !(coat.strands >= 1); }

}  // namespace

// One of three ways to wear a coat; what a renderer points to stays here.
struct CoatPainter::State {
    const FurKind kind;
    std::unique_ptr<FurPainter> strands;     // plotted or in shells
    std::unique_ptr<LayersRenderer> layers;  // of textures
    Coat coat;
    CombPaint comb;
    bool bald = false;
    GrownFur grown;
    Mesh skin;
    std::vector<Vec3f> lean;  // of the skin's vertices
    DirectionMap fur, colour;
    LappedDress dress;
    LayersLight light;

    State(FurKind k, const std::string& device, bool validation) : kind(k) {
        if (kind == FurKind::strands || kind == FurKind::shells) strands = std::make_unique<FurPainter>(kind, device, validation);
        else layers = std::make_unique<LayersRenderer>(device, validation);
    }

    Worn wear_strands(Mesh mesh, const MeshView& camera, int count, int threads) {
        Coat growing = coat;
        if (bald) growing.strands = 1;
        grown = grown_fur(std::move(mesh), growing, {.lengths = {}, .comb = comb}, threads);
        if (bald) {
            grown.mesh.normals = continuous_normals(grown.mesh, NormalMode::angle, threads);
            grown.lengths.assign(grown.mesh.positions.size(), 0.0f);
        }
        const FurView view = with_layers({.camera = camera}, count > 0 ? count : layers_for(kind, camera, coat));
        strands->load(grown, coat, {}, view, threads);
        return {.faces = grown.mesh.faces(), .layers = layers_of(view)};
    }

    Worn wear_classic(Mesh mesh, int count, int threads) {
        ClassicSettings classic = classic_of(coat);
        classic.light.specular = coat.gloss;
        PaintedSkin worn = classic_skin(std::move(mesh), comb, threads);
        skin = std::move(worn.mesh);
        lean = upright_but_for(skin, worn.painted);
        classic.tilt = coat.tilt;
        classic.bend = coat.bend;
        std::vector<std::string> notes;
        fur = classic_fur_map(classic, notes);
        colour = classic_colour_map(classic);
        light = classic.light;
        layers->load(classic_model(classic, skin, fur, colour, worn.painted.empty() ? nullptr : &lean));
        return {.faces = skin.faces(), .layers = static_cast<double>(count > 0 ? count : classic.layers)};
    }

    Worn wear_lapped(Mesh mesh, int count, int threads) {
        LappedFurSettings lapped;
        lapped.coat = coat;
        lapped.threads = threads;
        lapped.light.specular = coat.gloss;
        if (bald) lapped.coat.strands = 1;
        PaintedSkin worn = lapped_skin(std::move(mesh), comb, threads);
        skin = std::move(worn.mesh);
        dress = lapped_dress(skin, lapped, worn.painted);
        light = lapped.light;
        layers->load(dress.model(lapped));
        return {.faces = skin.faces(), .layers = static_cast<double>(count > 0 ? count : lapped.layers)};
    }
};

CoatPainter::CoatPainter(FurKind kind, const std::string& device, bool validation) : state_(std::make_unique<State>(kind, device, validation)) {}
CoatPainter::~CoatPainter() = default;

std::string CoatPainter::device_name() const { return state_->strands ? state_->strands->device_name() : state_->layers->device_name(); }
std::vector<std::string> CoatPainter::validation_messages() const { return state_->strands ? state_->strands->validation_messages() : state_->layers->validation_messages(); }

CoatPainter::Worn CoatPainter::wear(Mesh mesh, const Coat& coat, const MeshView& camera, int layers, int threads) {
    State& s = *state_;
    s.coat = coat;
    s.bald = is_bald(coat);
    if (s.bald) s.coat.length = 0;
    if (s.strands) return s.wear_strands(std::move(mesh), camera, layers, threads);
    return s.kind == FurKind::classic ? s.wear_classic(std::move(mesh), layers, threads) : s.wear_lapped(std::move(mesh), layers, threads);
}

void CoatPainter::paint(const CombPaint& comb) { state_->comb = comb; }

bool light_is_fitted(FurKind kind) { return kind == FurKind::classic || kind == FurKind::lapped; }

void CoatPainter::fit_light(const FurView& view, const FurFrames& traced) {
    if (state_->layers) fitted_light(*state_->layers, view, traced, state_->light);
}

FurFrames CoatPainter::draw(const FurView& view) { return state_->strands ? state_->strands->draw(view) : state_->layers->draw(view); }

CoatPainter::Counted CoatPainter::counted(int threads) const {
    const State& s = *state_;
    if (s.bald) throw Error("count strands on", s.strands ? s.grown.mesh.name : s.skin.name, "none grow there");
    if (s.strands) {
        std::vector<std::uint32_t> chances;
        for (const Root& root : s.grown.roots.roots) chances.push_back(strand_chance(root.position));
        return {s.grown.roots.roots.size(), evenness(s.grown.mesh, s.grown.roots, likeness(s.grown.roots, chances, threads), {.extent = 1, .threads = threads})};
    }
    if (s.kind == FurKind::classic) {
        const MapStrands map = map_strands(s.skin, s.fur, ClassicSettings{}.addressing, threads);
        return {map.roots.roots.size(), classic_evenness(s.skin, map, s.fur, threads)};
    }
    const MapStrands patches = lapped_strands(s.dress.patches, s.dress.base, s.dress.texture);
    return {patches.roots.roots.size(), evenness(s.dress.base, patches.roots, patches.strands, {.extent = 1, .threads = threads})};
}

}  // namespace relievo
