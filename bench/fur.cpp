// From a mesh in fur space to a frame of fur: roots, strands as programs receive them, and frames of 640x400, plotted and in 16 shells, in turn, A B A B. The baseline
// are the shells: "against_shells" is the median of what the plotted strands take over that of the shells, for what must be prepared and for a frame. The mesh is RELIEVO_MESHES
// (one path), or a made-up scan of 70,000 faces.
#include "assets/mesh_file.h"
#include "mesh/made_up_scan.h"
#include "pipeline/fur_painter.h"
#include "pipeline/grown_fur.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <vector>

namespace {

using namespace relievo;

double ms_of(const auto& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double median(std::vector<double> ms) {
    std::ranges::sort(ms);
    return ms[ms.size() / 2];
}

void fur(benchmark::State& state) {
    const char* file = std::getenv("RELIEVO_MESHES");
    const Mesh mesh = file ? load_mesh(file) : made_up_scan({.faces = 70000});
    const Coat coat;
    FurPainter plotted(FurKind::strands, ""), shells(FurKind::shells, "");
    FurView view{.camera = view_of_sphere({0, 0, 0}, 1 + static_cast<double>(coat.length) * 0.6, 640, 400), .layers = 16, .passes = 1};
    const FurView pieces = with_layers(view, layers_for(FurKind::strands, view.camera, coat));
    std::vector<double> roots, load_plotted, load_shells, frame_plotted, frame_shells;
    for (auto _ : state) {
        GrownFur grown = grown_fur(mesh, coat, {});
        GrownFur again = grown;
        roots.push_back(grown.roots_ms);
        load_plotted.push_back(ms_of([&] { plotted.load(grown, coat, {}, pieces); }));
        load_shells.push_back(ms_of([&] { shells.load(again, coat, {}, view); }));
        plotted.draw(pieces);  // the first after loading grows points and meets new memory
        shells.draw(view);
        frame_plotted.push_back(ms_of([&] { plotted.draw(pieces); }));
        frame_shells.push_back(ms_of([&] { shells.draw(view); }));
    }
    state.counters["roots_ms"] = median(roots);
    state.counters["prepare_ms"] = median(load_plotted);
    state.counters["prepare_against_shells"] = median(load_plotted) / median(load_shells);
    state.counters["frame_ms"] = median(frame_plotted);
    state.counters["frame_against_shells"] = median(frame_plotted) / median(frame_shells);
    state.SetLabel(plotted.device_name());
}
BENCHMARK(fur)->Unit(benchmark::kMillisecond)->Iterations(5);

}  // namespace
