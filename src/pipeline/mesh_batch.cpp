#include "pipeline/mesh_batch.h"

#include "assets/atomic_file.h"
#include "assets/mesh_file.h"
#include "core/error.h"
#include "core/parallel_for.h"
#include "core/version.h"
#include "pipeline/prepare_mesh.h"
#include "render/mesh_renderer.h"
#include "report/mesh_table.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <ctime>
#include <fstream>
#include <iterator>
#include <optional>

namespace relievo {

namespace {

constexpr std::array endings{".obj", ".ply", ".off", ".stl", ".gltf", ".glb", ".rmesh"};

bool is_mesh_name(std::filesystem::path file) {
    if (file.extension() == ".gz") file.replace_extension();
    std::string ending = file.extension().string();
    std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return std::ranges::find(endings, ending) != endings.end();
}

std::vector<std::filesystem::path> meshes_of(const std::filesystem::path& folder) {
    std::error_code fault;
    std::vector<std::filesystem::path> files;
    for (std::filesystem::directory_iterator it(folder, fault), end; !fault && it != end; it.increment(fault))
        if (it->is_regular_file() && is_mesh_name(it->path())) files.push_back(it->path());
    if (fault) throw Error("read", folder.string(), fault.message());
    if (files.empty()) throw Error("find meshes in", folder.string(), "no file there has the ending of a mesh");
    std::ranges::sort(files);
    return files;
}

std::string input_of(const std::filesystem::path& file) {
    const auto written = std::filesystem::last_write_time(file).time_since_epoch();
    return std::to_string(std::filesystem::file_size(file)) + " bytes, " +
           std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(written).count());
}

std::string now_utc() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text;
}

struct Combination {
    const NormalModeEntry* normals;
    bool index;
    const IndexOrderEntry* order;
};

// An order needs indices, so a list is drawn as it is.
std::vector<Combination> combinations() {
    std::vector<Combination> all;
    for (const NormalModeEntry& n : normal_modes) {
        all.push_back({&n, false, &index_orders[0]});
        for (const IndexOrderEntry& o : index_orders) all.push_back({&n, true, &o});
    }
    return all;
}

// Three vertices of its own for every face.
Mesh as_list(const Mesh& mesh) {
    Mesh list;
    list.name = mesh.name;
    const auto spread = [&](const auto& from, auto& to) {
        if (from.empty()) return;
        to.reserve(mesh.indices.size());
        for (const std::uint32_t v : mesh.indices) to.push_back(from[v]);
    };
    spread(mesh.positions, list.positions);
    spread(mesh.normals, list.normals);
    spread(mesh.uvs, list.uvs);
    spread(mesh.colours, list.colours);
    list.indices.resize(mesh.indices.size());
    for (std::uint32_t i = 0; i < list.indices.size(); ++i) list.indices[i] = i;
    return list;
}

// The row of a combination, and the mesh it gave.
struct Made {
    MeshRow row;
    Mesh mesh;
};

Made make_row(const Mesh& mesh, double load_ms, const Combination& c, const MeshBatchSettings& settings) {
    PreparedMesh best;
    for (int run = 0; run < settings.runs; ++run) {
        PreparedMesh p = prepare_mesh(mesh, {.centre = true, .normals = c.normals->mode, .index = c.index, .order = {.order = c.order->order}, .threads = settings.threads});
        if (run == 0 || p.ms.total() < best.ms.total()) best = std::move(p);
    }
    if (!c.index) {
        best.mesh = as_list(best.mesh);
        best.bytes_after = best.bytes_before;
    }
    const DrawingCost cost = drawing_cost(best.mesh);
    MeshRow row;
    row.normals = c.normals->id;
    row.index = c.index;
    row.order = c.order->id;
    row.faces = best.mesh.faces();
    row.sphere_radius = best.sphere.radius;
    row.half_diagonal = length(best.box.size()) / 2;
    row.vertices_before = best.vertices_before;
    row.vertices_after = best.mesh.positions.size();
    row.bytes_before = best.bytes_before;
    row.bytes_after = best.bytes_after;
    row.load_ms = load_ms;
    row.centre_ms = best.ms.centre;
    row.normals_ms = best.ms.normals;
    row.index_ms = best.ms.index;
    row.order_ms = best.ms.order;
    row.acmr_fifo16 = cost.fifo16.acmr;
    row.acmr_fifo32 = cost.fifo32.acmr;
    row.acmr_batched = cost.batched.acmr;
    row.overdraw = cost.overdraw;
    return {row, std::move(best.mesh)};
}

// Enough frames that the median of a small mesh is steady, and of a large one still takes a second or two.
constexpr int timed_frames = 15;

// The forms of table 7.5, which the thesis drew with its second normals, in turn.
void draw_forms(MeshRenderer& renderer, std::vector<Made>& made) {
    std::vector<MeshForm> forms;
    std::vector<MeshRow*> rows;
    for (Made& m : made)
        if (m.row.normals == "distinct" && m.mesh.faces() > 0) {
            forms.push_back({&m.mesh, !m.row.index});
            rows.push_back(&m.row);
        }
    if (forms.empty()) return;
    const Sphere sphere = bounding_sphere(forms.front().mesh->positions);
    const std::vector<MeshFrames> frames = renderer.draw(forms, view_of_sphere(sphere.centre, sphere.radius), timed_frames);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i]->frames_per_second = frames[i].frames_per_second;
        if (frames[i].vertex_invocations) rows[i]->vertex_invocations = *frames[i].vertex_invocations;
    }
}

MeshTable earlier_table(const std::filesystem::path& json) {
    std::ifstream in(json, std::ios::binary);
    if (!in) return {};
    return parse_mesh_table(std::string(std::istreambuf_iterator<char>(in), {}), json.string());
}

}  // namespace

MeshBatchResult batch_meshes(const MeshBatchSettings& settings, const Progress& progress) {
    const std::vector<std::filesystem::path> files = meshes_of(settings.folder);
    std::error_code fault;
    std::filesystem::create_directories(settings.out, fault);
    if (fault) throw Error("make the folder", settings.out.string(), fault.message());
    const MeshTable earlier = earlier_table(settings.out / "meshes.json");
    MeshTable table;
    table.version = version;
    table.date = now_utc();
    table.threads = settings.threads > 0 ? settings.threads : default_threads();

    std::optional<MeshRenderer> renderer;
    if (settings.frames) {
        renderer.emplace(settings.device);
        table.device = renderer->device_name();
    }

    MeshBatchResult result;
    const std::vector<Combination> all = combinations();
    for (std::size_t i = 0; i < files.size(); ++i) {
        const std::string name = files[i].filename().string(), input = input_of(files[i]);
        const std::string stage = "preparing meshes, " + std::to_string(files.size()) + " in all";
        report(progress, stage, static_cast<double>(i) / static_cast<double>(files.size()));
        std::vector<MeshRow> rows;
        std::ranges::copy_if(earlier.rows, std::back_inserter(rows), [&](const MeshRow& r) { return r.file == name && r.input == input; });
        const bool drawn = std::ranges::any_of(rows, [](const MeshRow& r) { return r.frames_per_second.has_value(); });
        const bool complete = rows.size() == all.size() && (drawn || !settings.frames);
        if (complete) {
            ++result.taken_over;
        } else {
            rows.clear();
            try {
                double load_ms = 0;
                Mesh mesh;
                for (int run = 0; run < settings.runs; ++run) {
                    const auto start = std::chrono::steady_clock::now();
                    mesh = load_mesh(files[i], settings.threads);
                    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
                    if (run == 0 || ms < load_ms) load_ms = ms;
                }
                std::vector<Made> made;
                for (std::size_t c = 0; c < all.size(); ++c) {
                    report(progress, stage, (static_cast<double>(i) + static_cast<double>(c) / static_cast<double>(all.size())) / static_cast<double>(files.size()));
                    made.push_back(make_row(mesh, load_ms, all[c], settings));
                    made.back().row.file = name;
                    made.back().row.input = input;
                    // Only what is drawn is worth its memory.
                    if (!renderer || made.back().row.normals != "distinct") made.back().mesh = {};
                }
                if (renderer) draw_forms(*renderer, made);
                for (const Made& m : made) rows.push_back(m.row);
            } catch (const Error& e) {
                rows.clear();
                table.skipped.push_back(name + ": " + e.what());
            }
        }
        table.rows.insert(table.rows.end(), rows.begin(), rows.end());
        result.meshes += !rows.empty();
        if (complete && i + 1 < files.size()) continue;
        // The rows of files still to come stay in the table until their turn, so that stopping now loses none of them.
        MeshTable saved = table;
        for (const MeshRow& r : earlier.rows) {
            const auto later = std::find_if(files.begin() + static_cast<std::ptrdiff_t>(i) + 1, files.end(), [&](const auto& f) { return f.filename() == r.file; });
            if (later != files.end()) saved.rows.push_back(r);
        }
        result.json = mesh_table_json(saved);
        write_file_atomically(settings.out / "meshes.json", result.json);
        write_file_atomically(settings.out / "meshes.csv", mesh_table_csv(saved));
        write_file_atomically(settings.out / "meshes.html", mesh_table_page(saved));
    }
    report(progress, "preparing meshes, " + std::to_string(files.size()) + " in all", 1);
    if (result.taken_over > 0) result.notes.push_back(std::to_string(result.taken_over) + " meshes were taken over from an earlier run");
    for (const std::string& s : table.skipped) result.notes.push_back("left out " + s);
    return result;
}

}  // namespace relievo
