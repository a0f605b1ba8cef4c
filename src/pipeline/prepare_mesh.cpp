#include "pipeline/prepare_mesh.h"

#include "assets/mesh_file.h"
#include "core/error.h"
#include "mesh/equal_vertices.h"
#include "mesh/indexing.h"
#include "mesh/overdraw.h"
#include "mesh/tangents.h"

#include <chrono>

namespace relievo {

namespace {

class Timer {
public:
    double lap_ms() {
        const auto now = Clock::now();
        const double ms = std::chrono::duration<double, std::milli>(now - last_).count();
        last_ = now;
        return ms;
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point last_ = Clock::now();
};

}  // namespace

PreparedMesh prepare_mesh(Mesh mesh, const MeshSteps& steps) {
    PreparedMesh p;
    Timer timer;
    if (steps.repair) {
        RepairedMesh r = repaired(std::move(mesh), steps.threads);
        mesh = std::move(r.mesh);
        p.repair = r.changed;
        p.ms.repair = timer.lap_ms();
    }
    if (steps.centre) {
        mesh = centred(std::move(mesh), steps.threads);
        p.ms.centre = timer.lap_ms();
    }
    if (steps.simplify) {
        SimplifiedMesh s = simplified(mesh, *steps.simplify, steps.threads);
        p.ms.simplify = timer.lap_ms();
        p.simplify_estimate = s.estimated_error;
        if (mesh.faces() > 0 && s.mesh.faces() > 0) p.simplify_distance = surface_distance(mesh, s.mesh, 100000, steps.threads);
        mesh = std::move(s.mesh);
        timer.lap_ms();
    }
    std::vector<std::uint32_t> place;
    if (steps.normals != NormalMode::none) {
        place = first_equal_vertex(mesh, Compared::positions, steps.threads);
        mesh.normals = continuous_normals(mesh, steps.normals, place, steps.threads);
        p.ms.normals = timer.lap_ms();
        // With continuous normals and nothing else, vertices at one place are equal: they need not be compared again.
        if (!mesh.uvs.empty() || !mesh.colours.empty()) place = {};
    }
    p.vertices_before = mesh.indices.size();
    p.bytes_before = list_bytes(mesh);
    timer.lap_ms();
    if (steps.index) {
        mesh = place.empty() ? indexed(std::move(mesh), steps.threads) : indexed(std::move(mesh), place, steps.threads);
        p.ms.index = timer.lap_ms();
    }
    place = {};
    if (steps.order.order != IndexOrder::none) {
        OrderSettings order = steps.order;
        order.threads = steps.threads;
        mesh = ordered(std::move(mesh), order);
        p.ms.order = timer.lap_ms();
    }
    if (steps.tangents) {
        if (mesh.uvs.empty()) throw Error("find the tangents of", mesh.name, "it has no texture coordinates, which tangents follow");
        if (mesh.normals.empty()) throw Error("find the tangents of", mesh.name, "it has no normals", "add --normals");
        const std::size_t vertices = mesh.positions.size();
        timer.lap_ms();
        TangentMesh t = with_tangents(std::move(mesh));
        mesh = std::move(t.mesh);
        p.tangents = std::move(t.tangents);
        p.vertices_doubled = mesh.positions.size() - vertices;
        p.ms.tangents = timer.lap_ms();
    }
    p.bytes_after = indexed_bytes(mesh) + p.tangents.size() * sizeof(Vec4f);
    p.mesh = std::move(mesh);
    p.box = bounding_box(p.mesh.positions, steps.threads);
    p.sphere = bounding_sphere(p.mesh.positions, steps.threads);
    return p;
}

PreparedMesh prepare_mesh_file(const std::filesystem::path& in, const MeshSteps& steps, const std::filesystem::path& out, const Progress& progress) {
    report(progress, "loading " + in.filename().string(), 0);
    Timer timer;
    Mesh mesh = load_mesh(in, steps.threads);
    const double load = timer.lap_ms();
    report(progress, "preparing " + in.filename().string(), 0.5);
    PreparedMesh p = prepare_mesh(std::move(mesh), steps);
    p.ms.load = load;
    if (!out.empty()) {
        report(progress, "writing " + out.filename().string(), 0.9);
        timer.lap_ms();
        save_mesh(out, p.mesh, steps.threads, p.tangents);
        p.ms.save = timer.lap_ms();
    }
    report(progress, "preparing " + in.filename().string(), 1);
    return p;
}

DrawingCost drawing_cost(const Mesh& mesh) {
    const std::size_t vertices = mesh.positions.size();
    return {fifo_work(mesh.indices, vertices, 16), fifo_work(mesh.indices, vertices, 32), batched_work(mesh.indices, vertices), overdraw(mesh)};
}

std::filesystem::path with_suffix(const std::filesystem::path& file, const std::string& suffix) {
    std::filesystem::path stem = file, ending;
    if (stem.extension() == ".gz") {
        ending = ".gz";
        stem.replace_extension();
    }
    ending = stem.extension().string() + ending.string();
    stem.replace_extension();
    return stem.string() + "_" + suffix + ending.string();
}

}  // namespace relievo
