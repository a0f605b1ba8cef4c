// Time from a mesh file to an indexed mesh with normals and order, beside tinyobjloader + meshoptimizer doing the same on the same file
// (on one thread, as they come), in turn, A B A B; and what each order costs and gives. The file is RELIEVO_MESHES, one or more paths
// with ':' between, or a made-up scan of a million faces. "peak_over_mesh" is the memory in use at most, over that of the result.
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include "assets/mesh_file.h"
#include "core/error.h"
#include "mesh/equal_vertices.h"
#include "mesh/index_order.h"
#include "mesh/indexing.h"
#include "mesh/made_up_scan.h"
#include "mesh/normals.h"
#include "mesh/simplify.h"
#include "mesh/vertex_cache.h"

#include <benchmark/benchmark.h>
#include <meshoptimizer.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace {

using namespace relievo;

double ms_of(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

struct Times {
    std::vector<double> ms;
    void add(double v) { ms.push_back(v); }
    double least() const { return *std::ranges::min_element(ms); }
    double median() const {
        std::vector<double> sorted = ms;
        std::ranges::sort(sorted);
        return sorted[sorted.size() / 2];
    }
};

double status_kilobytes(const std::string& field) {
    std::ifstream in("/proc/self/status");
    for (std::string line; std::getline(in, line);)
        if (line.starts_with(field + ":")) return std::strtod(line.c_str() + field.size() + 1, nullptr);
    return 0;
}

// Memory in use at most during `work`, in bytes, beyond what was in use before.
double peak_of(const auto& work) {
    std::ofstream("/proc/self/clear_refs") << "5";  // the high-water mark begins anew
    const double before = status_kilobytes("VmRSS");
    work();
    return 1024 * (status_kilobytes("VmHWM") - before);
}

// What the usual two libraries make of an OBJ: a list of corners with unit normals summed per position, its duplicates found, its faces
// ordered, its vertices in order of use.
std::size_t usual_chain(const std::string& file) {
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    std::string warning, fault;
    if (!tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &fault, file.c_str())) throw Error("read", file, fault);
    struct Vertex {
        Vec3f position, normal;
    };
    std::vector<Vec3f> normals(attributes.vertices.size() / 3);
    const auto position = [&](int v) { return Vec3f(attributes.vertices[3 * static_cast<std::size_t>(v)], attributes.vertices[3 * static_cast<std::size_t>(v) + 1], attributes.vertices[3 * static_cast<std::size_t>(v) + 2]); };
    for (const tinyobj::shape_t& shape : shapes)
        for (std::size_t i = 0; i + 2 < shape.mesh.indices.size(); i += 3) {
            const int a = shape.mesh.indices[i].vertex_index, b = shape.mesh.indices[i + 1].vertex_index, c = shape.mesh.indices[i + 2].vertex_index;
            const Vec3f n = cross(position(b) - position(a), position(c) - position(a));
            const float l = length(n);
            for (const int v : {a, b, c})
                if (l > 0) normals[static_cast<std::size_t>(v)] += n / l;
        }
    std::vector<Vertex> corners;
    for (const tinyobj::shape_t& shape : shapes)
        for (const tinyobj::index_t& i : shape.mesh.indices) {
            const Vec3f n = normals[static_cast<std::size_t>(i.vertex_index)];
            corners.push_back({position(i.vertex_index), dot(n, n) > 0 ? normalize(n) : n});
        }
    std::vector<unsigned> remap(corners.size()), indices(corners.size());
    const std::size_t count = meshopt_generateVertexRemap(remap.data(), nullptr, corners.size(), corners.data(), corners.size(), sizeof(Vertex));
    std::vector<Vertex> vertices(count);
    meshopt_remapIndexBuffer(indices.data(), nullptr, corners.size(), remap.data());
    meshopt_remapVertexBuffer(vertices.data(), corners.data(), corners.size(), sizeof(Vertex), remap.data());
    meshopt_optimizeVertexCache(indices.data(), indices.data(), indices.size(), count);
    meshopt_optimizeVertexFetch(vertices.data(), indices.data(), indices.size(), vertices.data(), count, sizeof(Vertex));
    return count;
}

void chain(benchmark::State& state, const std::string& file, bool beside_the_usual) {
    Times all, load, normals, index, order, usual;
    std::size_t bytes = 0;
    double peak = 0;
    for (auto _ : state) {
        Mesh mesh;
        double sum = 0;
        const auto timed = [&](Times& times, const auto& work) {
            times.add(ms_of(work));
            sum += times.ms.back();
        };
        const auto ours = [&] {
            timed(load, [&] { mesh = load_mesh(file); });
            std::vector<std::uint32_t> place;
            timed(normals, [&] {
                place = first_equal_vertex(mesh, Compared::positions);
                mesh.normals = continuous_normals(mesh, NormalMode::angle, place);
            });
            timed(index, [&] { mesh = indexed(std::move(mesh), place); });
            place = {};
            timed(order, [&] { mesh = ordered(std::move(mesh), {}); });
        };
        if (peak == 0) {
            peak = peak_of(ours);
        } else {
            ours();
        }
        bytes = indexed_bytes(mesh);
        all.add(sum);
        state.SetIterationTime(sum / 1000);
        mesh = {};
        if (beside_the_usual) usual.add(ms_of([&] { benchmark::DoNotOptimize(usual_chain(file)); }));
    }
    state.counters["all_ms_min"] = all.least();
    state.counters["all_ms_median"] = all.median();
    state.counters["load_ms"] = load.least();
    state.counters["normals_ms"] = normals.least();
    state.counters["index_ms"] = index.least();
    state.counters["order_ms"] = order.least();
    state.counters["peak_over_mesh"] = peak / static_cast<double>(bytes);
    if (!beside_the_usual) return;
    state.counters["usual_ms_median"] = usual.median();
    state.counters["usual_over_ours"] = usual.median() / all.median();
}

// meshoptimizer's call on the whole mesh, one thread, is the baseline of every order.
void one_order(benchmark::State& state, const std::string& file, IndexOrder kind, int cache) {
    const Mesh mesh = indexed(load_mesh(file));
    Times ours, whole;
    Mesh result;
    std::vector<unsigned> indices(mesh.indices.size());
    for (auto _ : state) {
        Mesh copy = mesh;
        ours.add(ms_of([&] { result = ordered(std::move(copy), {.order = kind, .cache = cache}); }));
        whole.add(ms_of([&] { meshopt_optimizeVertexCache(indices.data(), mesh.indices.data(), indices.size(), mesh.positions.size()); }));
        state.SetIterationTime(ours.ms.back() / 1000);
    }
    const std::size_t vertices = result.positions.size();
    state.counters["ms_min"] = ours.least();
    state.counters["ns_per_face"] = 1e6 * ours.least() / static_cast<double>(mesh.faces());
    state.counters["acmr16"] = fifo_work(result.indices, vertices, 16).acmr;
    state.counters["acmr32"] = fifo_work(result.indices, vertices, 32).acmr;
    state.counters["acmr_batched"] = batched_work(result.indices, vertices).acmr;
    state.counters["over_meshopt_whole"] = ours.median() / whole.median();
}

void lin_yu_alone(benchmark::State& state, const std::string& file) {
    const Mesh mesh = indexed(load_mesh(file));
    Times ours;
    for (auto _ : state) {
        ours.add(ms_of([&] { benchmark::DoNotOptimize(lin_yu_order(mesh.indices, static_cast<std::uint32_t>(mesh.positions.size()), 16, {})); }));
        state.SetIterationTime(ours.ms.back() / 1000);
    }
    state.counters["ns_per_face"] = 1e6 * ours.least() / static_cast<double>(mesh.faces());
}

void simplify(benchmark::State& state, const std::string& file, double share) {
    const Mesh mesh = indexed(load_mesh(file));
    const auto wanted = static_cast<std::size_t>(share * static_cast<double>(mesh.faces()));
    Times ours, theirs;
    std::size_t faces = 0;
    std::vector<unsigned> indices(mesh.indices.size());
    for (auto _ : state) {
        ours.add(ms_of([&] { faces = simplified(mesh, {.faces = wanted}).mesh.faces(); }));
        theirs.add(ms_of([&] {
            meshopt_simplify(indices.data(), mesh.indices.data(), indices.size(), &mesh.positions[0].x, mesh.positions.size(), sizeof(Vec3f), wanted * 3, 1, 0, nullptr);
        }));
        state.SetIterationTime(ours.ms.back() / 1000);
    }
    state.counters["ms_min"] = ours.least();
    state.counters["faces_over_wanted"] = static_cast<double>(faces) / static_cast<double>(wanted);
    state.counters["over_meshopt_alone"] = ours.median() / theirs.median();
}

std::vector<std::string> mesh_files() {
    std::vector<std::string> files;
    if (const char* named = std::getenv("RELIEVO_MESHES")) {
        std::string all = named;
        for (std::size_t from = 0; from <= all.size();) {
            const std::size_t to = std::min(all.find(':', from), all.size());
            if (to > from) files.push_back(all.substr(from, to - from));
            from = to + 1;
        }
        return files;
    }
    const std::filesystem::path made = std::filesystem::temp_directory_path() / "relievo_bench_scan.obj";
    const Mesh scan = made_up_scan({.faces = 1000000});
    std::FILE* out = std::fopen(made.c_str(), "w");
    for (const Vec3f& p : scan.positions) std::fprintf(out, "v %.7g %.7g %.7g\n", p.x, p.y, p.z);
    for (std::size_t i = 0; i < scan.indices.size(); i += 3) std::fprintf(out, "f %u %u %u\n", scan.indices[i] + 1, scan.indices[i + 1] + 1, scan.indices[i + 2] + 1);
    std::fclose(out);
    return {made.string()};
}

}  // namespace

int main(int argc, char** argv) {
    for (const std::string& file : mesh_files()) {
        const std::string name = std::filesystem::path(file).filename().string();
        const auto add = [&](const std::string& what, int iterations, auto function, auto... arguments) {
            benchmark::RegisterBenchmark((what + "/" + name).c_str(), function, file, arguments...)->UseManualTime()->Unit(benchmark::kMillisecond)->Iterations(iterations);
        };
        add("chain", 7, chain, file.ends_with(".obj"));
        add("order_meshopt", 5, one_order, IndexOrder::meshopt, 16);
        add("order_fifo", 5, one_order, IndexOrder::fifo, 16);
        add("order_lin_yu_16", 5, one_order, IndexOrder::lin_yu, 16);
        add("order_lin_yu_32", 5, one_order, IndexOrder::lin_yu, 32);
        add("lin_yu_one_thread", 3, lin_yu_alone);
        add("simplify_to_a_quarter", 3, simplify, 0.25);
    }
    benchmark::Initialize(&argc, argv);
    benchmark::RunSpecifiedBenchmarks();
}
