// Loading a mesh from every format we write, beside tinyobjloader on the OBJ (on one thread, as it comes), in turn, in one run. The mesh
// is RELIEVO_MESH, a path, or a made-up scan of a million faces; its files are made in the folder for temporary files.
#define TINYOBJLOADER_IMPLEMENTATION
#include <tiny_obj_loader.h>

#include "assets/mesh_file.h"
#include "mesh/made_up_scan.h"

#include <benchmark/benchmark.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

namespace {

using namespace relievo;

// The files of one mesh, removed at the end.
struct Files {
    Files() : folder(std::filesystem::temp_directory_path() / ("relievo-bench-" + std::to_string(::getpid()))) {
        std::filesystem::create_directory(folder);
        const char* const path = std::getenv("RELIEVO_MESH");
        const Mesh mesh = path ? load_mesh(path) : made_up_scan({});
        for (const char* ending : {"obj", "ply", "glb", "rmesh", "ply.gz"}) save_mesh(file(ending), mesh);
        faces = mesh.faces();
    }
    ~Files() {
        std::error_code ignored;
        std::filesystem::remove_all(folder, ignored);
    }
    std::filesystem::path file(const std::string& ending) const { return folder / ("mesh." + ending); }

    std::filesystem::path folder;
    std::size_t faces = 0;
};

double ms_of(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

void load(benchmark::State& state) {
    static const Files files;
    const std::vector<std::pair<std::string, int>> ours = {{"obj", 2}, {"obj", 1}, {"ply", 2}, {"glb", 2}, {"rmesh", 2}, {"ply.gz", 2}};
    std::vector<std::vector<double>> times(ours.size());
    std::vector<double> tinyobj_times;
    for (auto _ : state) {
        for (std::size_t i = 0; i < ours.size(); ++i)
            times[i].push_back(ms_of([&] { benchmark::DoNotOptimize(load_mesh(files.file(ours[i].first), ours[i].second).indices.data()); }));
        tinyobj_times.push_back(ms_of([&] {
            tinyobj::attrib_t attributes;
            std::vector<tinyobj::shape_t> shapes;
            std::vector<tinyobj::material_t> materials;
            std::string warning, error;
            benchmark::DoNotOptimize(tinyobj::LoadObj(&attributes, &shapes, &materials, &warning, &error, files.file("obj").c_str()));
        }));
    }
    state.counters["faces"] = static_cast<double>(files.faces);
    state.counters["tinyobj_ms"] = median(tinyobj_times);
    state.counters["tinyobj_over_obj_2"] = median(tinyobj_times) / median(times[0]);
    for (std::size_t i = 0; i < ours.size(); ++i) {
        const std::string name = ours[i].first + "_" + std::to_string(ours[i].second);
        state.counters[name + "_ms"] = median(times[i]);
        state.counters[name + "_least"] = *std::ranges::min_element(times[i]);
    }
}
BENCHMARK(load)->Iterations(15)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
