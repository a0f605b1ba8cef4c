// Relief on unwrapped meshes, whole: exact techniques against the exact answer, where charts end, and what is refused.
#include "pipeline/mesh_relief_picture.h"

#include "assets/mesh_file.h"
#include "core/error.h"
#include "mesh/made_up_atlas.h"
#include "techniques/catalogue.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <unistd.h>

namespace relievo {
namespace {

RenderSettings settings_for(const char* mesh, const char* technique, const char* material = "cobbles") {
    RenderSettings s{.material = {.folder = material, .procedural_size = 64, .threads = 2}, .technique = find_technique(technique), .view = {.id = "25", .elevation_deg = 25}};
    if (s.technique != nullptr) s.params = default_params(*s.technique);
    s.mesh = mesh;
    s.repeats = 3;
    s.picture.width = 128;
    s.picture.height = 96;
    s.picture.options.border = glsl::border_chart;
    s.use_cache = false;
    return s;
}

MeshReliefPicture drawn(const RenderSettings& settings) { return mesh_relief_picture(settings, {}); }

TEST(MeshRelief, IsExactWhereTheTechniqueIs) {
    for (const UnwrappedShape& shape : unwrapped_shapes()) {
        for (const char* technique : {"max_mip_tracing", "cell_cone_tracing"}) {
            const MeshFacts facts = drawn(settings_for(std::string(shape.id).c_str(), technique)).facts;
            EXPECT_GT(facts.judged, 2500u) << shape.id;
            EXPECT_GT(facts.holes, 100u) << shape.id << ": cobbles at the edges are cut";
            // A hit on the very edge may be taken for one or the other by a rounding.
            EXPECT_LE(*facts.missed_first_hit, 2e-4) << shape.id << " " << technique;
            EXPECT_LE(*facts.early_hit, 2e-4) << shape.id << " " << technique;
            EXPECT_LE(facts.uv_error_texels->p99, 1e-3) << shape.id << " " << technique;
            EXPECT_LE(facts.holes_filled, 2u) << shape.id << " " << technique;
        }
    }
}

TEST(MeshRelief, ShowsWhatOthersGetWrong) {
    RenderSettings s = settings_for("cube", "relief_mapping", "spikes");
    s.material.procedural_size = 256;
    const MeshFacts relief = drawn(s).facts;
    s = settings_for("cube", "parallax_mapping", "spikes");
    s.material.procedural_size = 256;
    const MeshFacts parallax = drawn(s).facts;
    const auto wrong = [](const MeshFacts& f) { return *f.missed_first_hit + *f.early_hit; };
    EXPECT_GT(wrong(relief), 0.002);
    EXPECT_LT(wrong(relief), 0.2);
    EXPECT_GT(wrong(parallax), 2 * wrong(relief));
}

// Every technique draws it, and none finds anything beyond a chart that its own question does not reach.
TEST(MeshRelief, WorksWithEveryTechnique) {
    for (const Technique& t : techniques()) {
        RenderSettings s = settings_for("torus", std::string(t.id).c_str(), "dunes");
        s.picture.width = 64;
        s.picture.height = 48;
        const MeshReliefPicture picture = drawn(s);
        EXPECT_GT(picture.facts.judged, 500u) << t.id;
        for (const float c : picture.frame.colour.texels) ASSERT_TRUE(std::isfinite(c)) << t.id;
    }
}

TEST(MeshRelief, GoesOnBeyondTheChartIfTold) {
    RenderSettings s = settings_for("cube", "cell_cone_tracing");
    const MeshReliefPicture cut = drawn(s);
    s.picture.options.border = glsl::border_repeat;
    const MeshReliefPicture whole = drawn(s);
    EXPECT_EQ(whole.facts.holes, 0u);
    EXPECT_EQ(whole.facts.judged, cut.facts.judged + cut.facts.holes);
    EXPECT_EQ(*whole.facts.missed_first_hit, 0);
    // Through the holes of the near sides the picture shows others or nothing: the outline is smaller.
    const auto covered = [](const Frame& f) { return std::ranges::count(f.coverage.texels, static_cast<std::uint8_t>(Coverage::hit)); };
    EXPECT_LT(covered(cut.frame), covered(whole.frame));
}

TEST(MeshRelief, IsTheSameForAnyNumberOfThreadsAndFromAFile) {
    RenderSettings s = settings_for("cylinder", "relief_mapping");
    const MeshReliefPicture two = drawn(s);
    s.material.threads = 1;
    const MeshReliefPicture one = drawn(s);
    EXPECT_EQ(one.frame.colour.texels, two.frame.colour.texels);
    const auto folder = std::filesystem::temp_directory_path() / ("relievo-mesh-relief-" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder);
    const std::string file = (folder / "cylinder.rmesh").string();
    save_mesh(file, find_unwrapped_shape("cylinder")->make());
    s.mesh = file;
    EXPECT_EQ(drawn(s).frame.colour.texels, one.frame.colour.texels);
    std::filesystem::remove_all(folder);
}

TEST(MeshRelief, ReferenceIsThePictureOfAnExactTechnique) {
    RenderSettings s = settings_for("torus", "cell_cone_tracing");
    const MeshReliefPicture exact = drawn(s);
    s.technique = nullptr;
    const MeshReliefPicture reference = drawn(s);
    EXPECT_EQ(*reference.facts.missed_first_hit, 0);
    double off = 0;
    for (std::size_t i = 0; i < exact.frame.colour.texels.size(); ++i) off += std::abs(static_cast<double>(exact.frame.colour.texels[i]) - static_cast<double>(reference.frame.colour.texels[i]));
    EXPECT_LT(off / static_cast<double>(exact.frame.colour.texels.size()), 2e-3);
}

TEST(MeshRelief, RefusesWhatItCannotDo) {
    RenderSettings s = settings_for("cube", "relief_mapping");
    s.picture.options.border = glsl::border_clip;
    EXPECT_THROW(drawn(s), UsageError);
    s = settings_for("cube", "relief_mapping");
    s.picture.options.shadow = glsl::shadow_horizon;
    EXPECT_THROW(drawn(s), UsageError);
    EXPECT_THROW(drawn(settings_for("no_such_mesh.obj", "relief_mapping")), Error);
    const auto file = std::filesystem::temp_directory_path() / ("relievo-bare-" + std::to_string(::getpid()) + ".ply");
    Mesh bare = find_unwrapped_shape("cube")->make();
    bare.uvs.clear();
    save_mesh(file, bare);
    try {
        drawn(settings_for(file.c_str(), "relief_mapping"));
        ADD_FAILURE() << "a mesh without texture coordinates was accepted";
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("no texture coordinates"), std::string::npos);
    }
    std::filesystem::remove(file);
}

}  // namespace
}  // namespace relievo
