#include "render/device_bake.h"

#include "render/cell_cone_bake.h"
#include "render/cone_bake.h"
#include "render/distance_bake.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

namespace relievo {

namespace {

template <class Program>
std::unique_ptr<MapProgram> compiled(const gpu::Device& device) {
    return std::make_unique<Program>(device);
}

struct Row {
    Map map;
    std::unique_ptr<MapProgram> (*compile)(const gpu::Device&);
};

constexpr Row rows[] = {
    {Map::cone, compiled<ConeBake>},
    {Map::distance, compiled<DistanceBake>},
    {Map::cell_cone, compiled<CellConeBake>},
};

// Vulkan leaves devices free to round sums toward zero or to flush small numbers. One that does is found out here, on noise, before
// a map that differs is taken for the CPU's.
void require_equal_bits(MapProgram& program, const MapKind& kind, const std::string& device) {
    MapSet maps;
    maps.height = HeightField(45, 28);
    std::uint32_t noise = 1;
    for (float& h : maps.height.texels.texels) {
        noise = noise * 1664525u + 1013904223u;  // Knuth's, as Numerical Recipes gives it
        h = static_cast<float>(noise >> 8) * 0x1p-24f;
    }
    const Progress silent;
    const MapBake bake{.height_scale = 0.07f, .threads = 1, .progress = silent};
    kind.bake(maps, bake);
    const ImageF baked = program.bake(maps.height, bake);
    const ImageF& expected = maps.*kind.image;
    if (!std::ranges::equal(std::as_bytes(std::span(baked.texels)), std::as_bytes(std::span(expected.texels))))
        throw Error("bake", "the " + std::string(kind.id) + " map on " + device, "it does not compute as the CPU does",
                    "bake it on the CPU (--device cpu)");
}

}  // namespace

std::vector<Map> device_baked_maps() {
    std::vector<Map> maps;
    for (const Row& row : rows) maps.push_back(row.map);
    return maps;
}

bool bakes_on_device(Map map) { return std::ranges::find(rows, map, &Row::map) != std::end(rows); }

bool is_real_gpu(const std::string& device) {
    try {
        return !gpu::chosen_device(device).software;
    } catch (const Error&) {
        return false;
    }
}

struct DeviceBaker::State {
    gpu::Device device;
    std::array<std::unique_ptr<MapProgram>, map_count> programs;
};

DeviceBaker::DeviceBaker(const std::string& device, bool validation)
    : state_(new State{.device = gpu::Device(gpu::DeviceSettings{.choice = device, .validation = validation}), .programs = {}}) {}

DeviceBaker::~DeviceBaker() = default;

std::string DeviceBaker::device_name() const { return state_->device.info().name; }
std::vector<std::string> DeviceBaker::validation_messages() const { return state_->device.validation_messages(); }

ImageF DeviceBaker::bake(Map map, const HeightField& field, const MapBake& bake) {
    const Row* row = std::ranges::find(rows, map, &Row::map);
    assert(row != std::end(rows) && !field.empty());
    return gpu::vulkan_errors_as("bake", "the " + std::string(map_kind(map).id) + " map on " + device_name(), [&] {
        auto& program = state_->programs[index_of(map)];
        if (!program) {
            auto compiled_now = row->compile(state_->device);
            require_equal_bits(*compiled_now, map_kind(map), device_name());
            program = std::move(compiled_now);
        }
        return program->bake(field, bake);
    });
}

}  // namespace relievo
