#include "pipeline/replicate_fur.h"

#include "assets/atomic_file.h"
#include "assets/image_file.h"
#include "assets/mesh_file.h"
#include "core/error.h"
#include "mesh/index_order.h"
#include "mesh/indexing.h"
#include "mesh/made_up_scan.h"
#include "mesh/normals.h"
#include "mesh/simplify.h"
#include "pipeline/classic_picture.h"
#include "pipeline/fur_picture.h"
#include "pipeline/fur_reference.h"
#include "pipeline/grown_fur.h"
#include "pipeline/lapped_picture.h"
#include "pipeline/scratch_folder.h"
#include "pipeline/shown_picture.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <fstream>
#include <memory>
#include <numbers>
#include <optional>

namespace relievo {

namespace {

// A mesh as all modes get it.
struct Subject {
    Mesh mesh;
    std::string from;
};

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c); });
    return text;
}

// The smallest file of the object's name with at least the published faces, else the largest.
Subject scan_of(const PublishedFur& published, const std::filesystem::path& folder, int threads) {
    std::optional<Subject> best;
    std::error_code fault;
    for (const auto& entry : std::filesystem::directory_iterator(folder, fault)) {
        const std::string name = entry.path().filename().string();
        if (!entry.is_regular_file() || lower(name).find(published.mesh) == std::string::npos) continue;
        Mesh mesh;
        try {
            mesh = load_mesh(entry.path(), threads);
        } catch (const Error&) {
            continue;  // a picture or a text about it
        }
        const bool enough = mesh.faces() >= published.faces, had = best && best->mesh.faces() >= published.faces;
        if (!best || (enough && (!had || mesh.faces() < best->mesh.faces())) || (!enough && !had && mesh.faces() > best->mesh.faces())) best = Subject{std::move(mesh), name};
    }
    if (fault) throw Error("replicate with the meshes of", folder.string(), fault.message());
    if (!best) throw Error("replicate with the meshes of", folder.string(), "no mesh there has " + std::string(published.mesh) + " in its name", "leave --meshes out for made-up ones");
    best->mesh.uvs.clear();
    best->mesh.colours.clear();
    best->mesh.normals.clear();
    best->mesh = indexed(std::move(best->mesh), threads);
    if (best->mesh.faces() > published.faces) {
        best->from += ", simplified from " + std::to_string(best->mesh.faces());
        best->mesh = simplified(best->mesh, {.faces = published.faces}, threads).mesh;
    }
    return *best;
}

Subject subject_of(const PublishedFur& published, const ReplicateFurSettings& s) {
    Subject subject;
    if (published.mesh == "cube")
        subject = {cube_mesh(), "made"};
    else if (published.mesh == "torus")
        subject = {torus_mesh(24, 8), "made"};
    else if (s.meshes.empty())
        subject = {made_up_scan({.faces = static_cast<std::uint32_t>(published.faces), .threads = s.threads}), "a made-up scan in its stead"};
    else
        subject = scan_of(published, s.meshes, s.threads);
    subject.mesh.name = published.mesh;
    return subject;
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

struct Pictures {
    std::optional<Image8> classic, lapped, strands, reference;
};

FurUnit run_unit(const PublishedFur& published, const Subject& subject, const std::filesystem::path& file, double height, double density, LayersRenderer& layers_renderer, LayersRenderer& lapped_renderer, const ReplicateFurSettings& s,
                 Pictures& pictures, const Progress& progress) {
    FurUnit unit{.mesh = std::string(published.mesh), .from = subject.from, .faces = subject.mesh.faces(), .published_faces = published.faces, .height_percent = height, .density_percent = density,
                 .strands = 0, .trials = {}};
    ClassicSettings classic;
    classic.height = static_cast<float>(height / 100);
    classic.map.density = density / 100;
    std::vector<std::string> notes;
    const DirectionMap fur = classic_fur_map(classic, notes), colour = classic_colour_map(classic);
    const Coat coat = upright_coat(classic, strands_on(fur));

    // The reference.
    GrownFur grown = grown_fur(subject.mesh, coat, {}, s.threads);
    unit.strands = grown.roots.roots.size();
    FurView view{.camera = view_of_sphere({0, 0, 0}, 1 + static_cast<double>(coat.length) * 0.6, s.width, s.height), .layers = 16, .passes = 1};
    const FurFrames reference = trace_fur(curves_of(grown, coat, 4, {}, s.threads), grown.mesh, coat, view, s.samples, s.threads, progress);

    // Uniform layers: with their own normals and the quickest order, and the light that suits them best.
    Mesh mesh = grown.mesh;
    mesh.normals = continuous_normals(mesh, NormalMode::distinct, s.threads);
    mesh = ordered(indexed(std::move(mesh), s.threads), {.threads = s.threads});
    layers_renderer.load(classic_model(classic, mesh, fur, colour));
    struct Timed {
        FurTrial trial;
        LayersLight light;
        std::vector<double> ms;
    };
    std::vector<Timed> trials;
    for (const int layers : {8, 16, 32}) {
        view.layers = layers;
        view.passes = 1;
        Timed& t = trials.emplace_back();
        t.trial.mode = "classic";
        t.trial.layers = layers;
        t.light = fitted_light(layers_renderer, view, reference, classic.light);
        t.trial.frame_flip = fur_score(layers_renderer.draw(view), reference, s.threads).flip;
    }
    // Patches of as many strands an area, in the same light.
    LappedFurSettings patched;
    patched.coat = coat;
    patched.density = classic.map.density;
    patched.threads = s.threads;
    const LappedDress dress = lapped_dress(grown.mesh, patched);
    lapped_renderer.load(dress.model(patched));
    for (const int layers : {16, 32}) {
        view.layers = layers;
        view.passes = 1;
        Timed& t = trials.emplace_back();
        t.trial.mode = "lapped";
        t.trial.layers = layers;
        t.light = fitted_light(lapped_renderer, view, reference, patched.light);
        t.trial.frame_flip = fur_score(lapped_renderer.draw(view), reference, s.threads).flip;
    }
    for (const int layers : {1, 2, 4, 8, 16, 0}) {
        FurTrial& t = trials.emplace_back().trial;
        t.mode = "strands";
        t.layers = layers;
        t.chosen = layers == 0;
    }

    for (int round = 0; round < s.rounds; ++round)
        for (Timed& t : trials) {
            FurFrames frames;
            if (t.trial.mode != "strands") {
                LayersRenderer& renderer = t.trial.mode == "lapped" ? lapped_renderer : layers_renderer;
                view.layers = t.trial.layers;
                view.passes = s.passes;
                renderer.set_light(t.light);
                frames = renderer.draw(view);
            } else {
                FurSettings ours{.coat = coat, .layers = t.trial.chosen ? 0 : t.trial.layers, .width = s.width, .height = s.height, .passes = s.passes, .device = s.device, .threads = s.threads};
                if (round == 0) {
                    ours.passes = 1;
                    t.trial.frame_flip = fur_score(fur_picture(file, ours).frames, reference, s.threads).flip;
                    ours.passes = s.passes;
                }
                FurPicture p = fur_picture(file, ours);
                t.trial.layers = p.layers;
                frames = std::move(p.frames);
            }
            t.ms.insert(t.ms.end(), frames.frame_ms.begin(), frames.frame_ms.end());
            if (round > 0) continue;
            const FurScore score = fur_score(frames, reference, s.threads);
            t.trial.flip = score.flip;
            t.trial.coverage_error = score.coverage_error;
            t.trial.gaps = score.gaps;
            if (t.trial.mode == "classic" && t.trial.layers == 16) pictures.classic = shown_fur(frames);
            if (t.trial.mode == "lapped" && t.trial.layers == 16) pictures.lapped = shown_fur(frames);
            if (t.trial.chosen) pictures.strands = shown_fur(frames);
        }
    pictures.reference = shown_fur(reference);
    for (Timed& t : trials) {
        t.trial.ms = median(t.ms);
        unit.trials.push_back(std::move(t.trial));
    }
    return unit;
}

}  // namespace

Mesh cube_mesh() {
    Mesh mesh;
    mesh.name = "cube";
    for (int v = 0; v < 8; ++v) mesh.positions.emplace_back(v & 1 ? 1.0f : -1.0f, v & 2 ? 1.0f : -1.0f, v & 4 ? 1.0f : -1.0f);
    mesh.indices = {0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6};
    return mesh;
}

Mesh torus_mesh(std::uint32_t around, std::uint32_t across) {
    Mesh mesh;
    mesh.name = "torus";
    constexpr double turn = 2 * std::numbers::pi;
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t k = 0; k < across; ++k) {
            const double u = turn * i / around, v = turn * k / across, r = 1 + 0.4 * std::cos(v);
            mesh.positions.push_back(Vec3f(Vec3d(r * std::cos(u), 0.4 * std::sin(v), -r * std::sin(u))));
        }
    for (std::uint32_t i = 0; i < around; ++i)
        for (std::uint32_t k = 0; k < across; ++k) {
            const std::uint32_t j = (i + 1) % around, l = (k + 1) % across;
            const std::uint32_t a = i * across + k, b = j * across + k, c = j * across + l, d = i * across + l;
            mesh.indices.insert(mesh.indices.end(), {a, b, c, a, c, d});
        }
    return mesh;
}

FurReplication replicate_fur(const ReplicateFurSettings& s, const Progress& progress) {
    for (const std::filesystem::path& file : {s.page, s.csv, s.state})
        if (!file.empty()) require_writable(file);
    if (!s.pictures.empty()) std::filesystem::create_directories(s.pictures);
    LayersRenderer layers_renderer(s.device), lapped_renderer(s.device);
    FurReplication result{.device = layers_renderer.device_name(), .width = s.width, .height = s.height, .passes = s.passes, .samples = s.samples, .stand_ins = s.meshes.empty(), .units = {}};
    if (!s.state.empty() && std::filesystem::exists(s.state)) {
        std::ifstream in(s.state);
        FurReplication kept = fur_replication_from(std::string(std::istreambuf_iterator<char>(in), {}), s.state.string());
        if (kept.device != result.device || kept.width != s.width || kept.height != s.height || kept.passes != s.passes || kept.samples != s.samples || kept.stand_ins != result.stand_ins)
            throw Error("go on from", s.state.string(), "it was measured with other settings or on another device", "remove it to begin anew");
        result = std::move(kept);
    }
    const auto start = std::chrono::steady_clock::now();
    const auto done = [&](std::string_view mesh, double height, double density) {
        return std::ranges::any_of(result.units, [&](const FurUnit& u) { return u.mesh == mesh && u.height_percent == height && u.density_percent == density; });
    };
    const ScratchFolder scratch;
    int step = 0;
    const std::vector<double> heights = s.heights.empty() ? std::vector(std::begin(published_fur_heights), std::end(published_fur_heights)) : s.heights;
    const std::vector<double> densities = s.densities.empty() ? std::vector(std::begin(published_fur_densities), std::end(published_fur_densities)) : s.densities;
    const int steps = static_cast<int>((s.only.empty() ? std::size(published_fur()) : s.only.size()) * heights.size() * densities.size());
    bool out_of_time = false;
    for (const PublishedFur& published : published_fur()) {
        if (!s.only.empty() && std::ranges::find(s.only, published.mesh) == s.only.end()) continue;
        std::optional<Subject> subject;
        const std::filesystem::path file = scratch.path / (std::string(published.mesh) + ".rmesh");
        for (const double height : heights)
            for (const double density : densities) {
                const int here = step++;
                if (out_of_time || done(published.mesh, height, density)) continue;
                if (s.seconds > 0 && std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > s.seconds) {
                    out_of_time = true;
                    continue;
                }
                report(progress, "replicating fur on the " + std::string(published.mesh), static_cast<double>(here) / steps);
                if (!subject) {
                    subject = subject_of(published, s);
                    save_mesh(file, subject->mesh, s.threads);
                }
                const Progress inside = [&](std::string_view, double share) { report(progress, "replicating fur on the " + std::string(published.mesh), (here + 0.5 * share) / steps); };
                Pictures pictures;
                result.units.push_back(run_unit(published, *subject, file, height, density, layers_renderer, lapped_renderer, s, pictures, inside));
                if (!s.state.empty()) write_file_atomically(s.state, fur_replication_json(result));
                if (!s.pictures.empty()) {
                    const std::string name = std::string(published.mesh) + "_" + std::to_string(static_cast<int>(height)) + "_" + std::to_string(static_cast<int>(density)) + ".png";
                    write_png(s.pictures / name, side_by_side(side_by_side(*pictures.classic, *pictures.lapped), side_by_side(*pictures.strands, *pictures.reference)), FirstRow::top);
                }
            }
    }
    report(progress, "replicating fur", 1);
    if (!s.page.empty()) write_file_atomically(s.page, fur_replication_page(result, s.command));
    if (!s.csv.empty()) write_file_atomically(s.csv, fur_replication_csv(result));
    return result;
}

}  // namespace relievo
