#include "cli/commands.h"

#include "cli/mesh_json.h"
#include "cli/progress_display.h"
#include "core/error.h"
#include "core/suggest.h"
#include "pipeline/mesh_batch.h"
#include "pipeline/mesh_picture.h"
#include "pipeline/prepare_mesh.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

namespace relievo {

namespace {

template <class Entry>
const Entry& find_id(std::span<const Entry> table, const std::string& what, const std::string& id) {
    std::vector<std::string> known;
    for (const Entry& e : table) {
        if (e.id == id) return e;
        known.emplace_back(e.id);
    }
    throw UsageError(unknown_word(what, id, known));
}

// "5000" is a count of faces, "0.01" a share of the mesh's extent.
SimplifyTarget parse_target(const std::string& text) {
    double value = 0;
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = text.find_first_of(".e") == std::string::npos;
    if (fault != std::errc{} || end != text.data() + text.size() || !(value > 0) || (whole ? value < 1 || value > 1e9 : value >= 1))
        throw UsageError("--simplify takes a number of faces (5000) or an error below 1 in shares of the mesh's extent (0.01), not \"" + text + "\"");
    return whole ? SimplifyTarget{.faces = static_cast<std::size_t>(value)} : SimplifyTarget{.error = value};
}

nlohmann::ordered_json frames_json(const MeshFrames& f) {
    return {{"frames_per_second", f.frames_per_second},
            {"frame_ms", {{"min", f.frame_ms.min}, {"median", f.frame_ms.median}, {"max", f.frame_ms.max}, {"runs", f.frame_ms.runs}}},
            {"vertex_invocations", f.vertex_invocations ? nlohmann::ordered_json(*f.vertex_invocations) : nlohmann::ordered_json()}};
}

}  // namespace

void add_mesh_command(CLI::App& app) {
    struct Options {
        std::string in, out, normals, order, batch, picture, device;
        std::vector<std::string> simplify, orders, modes;
        std::vector<float> weights;
        int cache = 16;
        MeshSteps steps;
        bool json = false, quiet = false, frames = false;
    };
    auto o = std::make_shared<Options>();
    auto* verb = app.add_subcommand("mesh", "Makes a mesh ready to draw, or analyses it");
    verb->add_option("in", o->in, "mesh to read: OBJ, PLY, OFF, STL, glTF, GLB or our cache, each also as .gz");
    verb->add_flag("--repair", o->steps.repair, "take out collapsed and repeated faces, turn faces to agree, and say what was changed");
    verb->add_flag("--centre,--center", o->steps.centre, "move the centre of its box to the origin");
    verb->add_option("--simplify", o->simplify, "number of faces, or error in shares of the extent; several make several files")->expected(1, 64);
    verb->add_option("--normals", o->normals, "one normal per position: sum, distinct or angle (the default of the bare option); none keeps the file's")
        ->expected(0, 1)
        ->default_str("angle");
    verb->add_flag("--index", o->steps.index, "equal vertices become one, unused ones go");
    verb->add_option("--order", o->order, "of faces: meshopt (the default of the bare option), fifo, lin-yu or none")->expected(0, 1)->default_str("meshopt");
    verb->add_flag("--tangents", o->steps.tangents, "a tangent per vertex, by Mikkelsen's conventions; kept by .glb and .gltf");
    verb->add_option("--cache", o->cache, "size of the FIFO cache that fifo and lin-yu aim at")->check(CLI::Range(4, 255))->capture_default_str();
    verb->add_option("--weights", o->weights, "of lin-yu: per face drawn, freshness, per vertex evicted, per face opened, margin of look-ahead")->expected(5);
    verb->add_option("--batch", o->batch, "all meshes of a folder with all combinations of normals, index and order, as a table in the folder --out");
    verb->add_flag("--frames", o->frames, "draw it as well, in a batch: frames a second and vertices computed by the device");
    verb->add_option("--picture", o->picture, "FILE.png: the result under Phong's model at 1280x800, and how fast it draws as a list and through its indices");
    verb->add_option("--device", o->device, "that draws: software, or part of a device's name (relievo list devices)");
    verb->add_option("--threads", o->steps.threads, "0: all cores")->check(CLI::Range(0, 1024))->capture_default_str();
    verb->add_flag("--quiet", o->quiet, "no progress and no notes");
    verb->add_flag("--json", o->json, "print what was done and what the mesh is like as JSON");
    verb->add_option("--out", o->out, "FILE.ply, .obj, .gltf, .glb or .rmesh, each also with .gz; with --batch, a folder");
    verb->footer("Examples:\n  relievo mesh bunny.obj --centre --normals --index --order --out bunny.rmesh\n"
                 "  relievo mesh dragon.ply.gz --index --order lin-yu --cache 32 --json --out dragon.ply\n"
                 "  relievo mesh scan.obj --simplify 20000 5000 0.01 --out scan.ply       writes scan_20000.ply, scan_5000.ply, scan_0.01.ply\n"
                 "  relievo mesh scan.stl --json                                         analyses it and writes nothing\n"
                 "  relievo mesh --batch scans --out table");
    verb->callback([o, verb] {
        MeshSteps& s = o->steps;
        if (verb->count("--normals") > 0) s.normals = find_id<NormalModeEntry>(normal_modes, "mode of normals", o->normals.empty() ? "angle" : o->normals).mode;
        if (verb->count("--order") > 0) s.order.order = find_id<IndexOrderEntry>(index_orders, "order", o->order.empty() ? "meshopt" : o->order).order;
        s.order.cache = o->cache;
        if (!o->weights.empty()) s.order.weights = LinYuWeights{o->weights[0], o->weights[1], o->weights[2], o->weights[3], o->weights[4]};
        if (!o->batch.empty()) {
            if (!o->in.empty()) throw UsageError("--batch takes the meshes from its folder; leave out \"" + o->in + "\"");
            if (o->out.empty()) throw UsageError("--batch needs --out FOLDER for its table");
            const MeshBatchResult result = batch_meshes({.folder = o->batch, .out = o->out, .threads = s.threads, .frames = o->frames, .device = o->device}, progress_display(o->quiet));
            if (!o->quiet)
                for (const std::string& note : result.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
            if (o->json) std::printf("%s\n", result.json.c_str());
            return;
        }
        if (o->in.empty()) throw UsageError("mesh needs a mesh to read, or --batch FOLDER");
        if (o->out.empty() && !o->json && o->picture.empty()) throw UsageError("mesh needs --out FILE for the result, or --json to analyse without one");
        const bool several = o->simplify.size() > 1;
        nlohmann::ordered_json all = nlohmann::ordered_json::array();
        if (o->simplify.empty()) o->simplify.emplace_back();
        for (const std::string& target : o->simplify) {
            MeshSteps steps = s;
            if (!target.empty()) steps.simplify = parse_target(target);
            const std::filesystem::path out = several && !o->out.empty() ? with_suffix(o->out, target) : std::filesystem::path(o->out);
            const PreparedMesh p = prepare_mesh_file(o->in, steps, out, progress_display(o->quiet));
            if (!o->quiet)
                for (const std::string& note : p.mesh.notes) std::fprintf(stderr, "note: %s\n", note.c_str());
            std::optional<MeshPicture> picture;
            if (!o->picture.empty())
                picture = draw_mesh_picture(p, several ? with_suffix(o->picture, target) : std::filesystem::path(o->picture), o->device);
            if (picture && !o->quiet)
                std::fprintf(stderr, "%s: as a list %.1f frames a second, through its indices %.1f\n", o->picture.c_str(), picture->list.frames_per_second,
                             picture->indexed.frames_per_second);
            if (!o->json) {
                if (!o->quiet && !out.empty())
                    std::fprintf(stderr, "%s: %zu faces, %zu vertices, %zu bytes (a list: %zu), %.1f ms\n", out.c_str(), p.mesh.faces(),
                                 p.mesh.positions.size(), p.bytes_after, p.bytes_before, p.ms.total());
                continue;
            }
            all.push_back(mesh_json(p, steps));
            if (picture) all.back()["report"]["frames"] = {{"list", frames_json(picture->list)}, {"indexed", frames_json(picture->indexed)}, {"device", picture->device}};
        }
        if (o->json) std::printf("%s\n", (several ? all : all.front()).dump(2).c_str());
    });
}

}  // namespace relievo
