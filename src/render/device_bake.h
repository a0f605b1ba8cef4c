// Maps baked by compute programs on a Vulkan device: to the bit what the CPU bakes.
#pragma once

#include "core/map_set.h"
#include "maps/map_kinds.h"

#include <memory>
#include <string>
#include <vector>

namespace relievo {

// One map's programs, compiled for a device.
class MapProgram {
public:
    virtual ~MapProgram() = default;
    // What map_kinds' baker makes of these heights. Throws Error where the device has no room, and what `progress` throws.
    virtual ImageF bake(const HeightField& field, const MapBake& bake) = 0;
};

// The maps that have programs; the others are baked on the CPU only.
std::vector<Map> device_baked_maps();
bool bakes_on_device(Map map);

// Whether `device` (as GpuRenderer takes it) means a GPU that is there; a software device is none.
bool is_real_gpu(const std::string& device);

class DeviceBaker {
public:
    // device: as GpuRenderer takes it. Throws Error without one.
    DeviceBaker(const std::string& device, bool validation);
    ~DeviceBaker();

    std::string device_name() const;
    // Messages of the validation layers since the start; empty without validation.
    std::vector<std::string> validation_messages() const;

    // Of one of device_baked_maps(). Heights are finite and in [0,1]. The programs are compiled when a map is first baked.
    ImageF bake(Map map, const HeightField& field, const MapBake& bake);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace relievo
