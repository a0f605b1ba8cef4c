#include "cli/mesh_json.h"

#include "mesh/indexing.h"

#include <cmath>

namespace relievo {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Vec3d& v) { return {v.x, v.y, v.z}; }

// A tenth of a microsecond is finer than the clock means.
double rounded(double ms) { return std::round(ms * 1e4) / 1e4; }

Json json_of(const Topology& t) {
    return {{"vertices", t.vertices},
            {"distinct_positions", t.distinct_positions},
            {"duplicate_vertices", t.duplicate_vertices},
            {"unreferenced_vertices", t.unreferenced_vertices},
            {"degenerate_faces", t.degenerate_faces},
            {"duplicate_faces", t.duplicate_faces},
            {"edges", t.edges},
            {"boundary_edges", t.boundary_edges},
            {"non_manifold_edges", t.non_manifold_edges},
            {"non_manifold_vertices", t.non_manifold_vertices},
            {"flipped_edges", t.flipped_edges},
            {"holes", t.holes},
            {"components", t.components},
            {"closed", t.closed},
            {"oriented", t.oriented},
            {"euler", t.euler ? Json(*t.euler) : Json()},
            {"genus", t.genus ? Json(*t.genus) : Json()}};
}

Json json_of(const Repair& r) {
    return {{"faces_collapsed", r.faces_collapsed},     {"faces_repeated", r.faces_repeated},
            {"faces_turned", r.faces_turned},           {"pieces_turned_out", r.pieces_turned_out},
            {"vertices_merged", r.vertices_merged},     {"vertices_unreferenced", r.vertices_unreferenced}};
}

std::string id_of(NormalMode mode) {
    for (const NormalModeEntry& e : normal_modes)
        if (e.mode == mode) return std::string(e.id);
    return {};
}
std::string id_of(IndexOrder order) {
    for (const IndexOrderEntry& e : index_orders)
        if (e.order == order) return std::string(e.id);
    return {};
}

}  // namespace

nlohmann::ordered_json mesh_json(const PreparedMesh& p, const MeshSteps& steps) {
    const Mesh& mesh = p.mesh;
    const DrawingCost cost = drawing_cost(mesh);
    Json report;
    report["steps"] = {{"repair", steps.repair},
                       {"centre", steps.centre},
                       {"normals", id_of(steps.normals)},
                       {"index", steps.index},
                       {"order", id_of(steps.order.order)},
                       {"cache", steps.order.cache}};
    report["box"] = {{"low", json_of(Vec3d(p.box.low))}, {"high", json_of(Vec3d(p.box.high))}, {"half_diagonal", length(p.box.size()) / 2}};
    report["sphere"] = {{"centre", json_of(p.sphere.centre)}, {"radius", p.sphere.radius}};
    report["vertex_bytes"] = vertex_bytes(mesh);
    report["index_bytes"] = index_bytes(mesh.positions.size());
    report["batched"] = {{"acmr", cost.batched.acmr}, {"atvr", cost.batched.atvr}, {"vertices", BatchModel{}.vertices}, {"faces", BatchModel{}.faces}};
    report["overdraw"] = cost.overdraw;
    report["topology"] = json_of(topology(mesh, steps.threads));
    if (p.repair) {
        report["repair"] = json_of(*p.repair);
        report["repair"]["ms"] = rounded(p.ms.repair);
    }
    if (steps.simplify) {
        report["simplify"] = {{"wanted_faces", steps.simplify->faces > 0 ? Json(steps.simplify->faces) : Json()},
                              {"wanted_error", steps.simplify->error > 0 ? Json(steps.simplify->error) : Json()},
                              {"estimated_error", p.simplify_estimate.value_or(0)},
                              {"ms", rounded(p.ms.simplify)}};
        if (p.simplify_distance)
            report["simplify"]["hausdorff"] = {{"largest", p.simplify_distance->largest},
                                               {"original_to_result", p.simplify_distance->from_first},
                                               {"result_to_original", p.simplify_distance->from_second},
                                               {"root_mean_square", p.simplify_distance->root_mean_square},
                                               {"samples", p.simplify_distance->samples}};
    }
    if (steps.tangents) report["tangents"] = {{"vertices_doubled", p.vertices_doubled}, {"ms", rounded(p.ms.tangents)}};
    report["notes"] = mesh.notes;

    return {{"faces", mesh.faces()},
            {"vertices_before", p.vertices_before},
            {"vertices_after", mesh.positions.size()},
            {"bytes_before", p.bytes_before},
            {"bytes_after", p.bytes_after},
            {"acmr", {{"fifo16", cost.fifo16.acmr}, {"fifo32", cost.fifo32.acmr}}},
            {"atvr", {{"fifo16", cost.fifo16.atvr}, {"fifo32", cost.fifo32.atvr}}},
            {"ms",
             {{"load", rounded(p.ms.load)},
              {"centre", rounded(p.ms.centre)},
              {"normals", rounded(p.ms.normals)},
              {"index", rounded(p.ms.index)},
              {"order", rounded(p.ms.order)},
              {"save", rounded(p.ms.save)},
              {"total", rounded(p.ms.total())}}},
            {"report", report}};
}

}  // namespace relievo
