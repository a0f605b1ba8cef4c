// Who bakes: the CPU, or a device where it has programs for the map. The maps are the same to the bit.
#pragma once

#include "core/map_set.h"
#include "render/device_bake.h"

#include <memory>
#include <string>
#include <utility>

namespace relievo {

class BakeMachine {
public:
    // A real GPU where there is one, for the maps that it has programs for; else the CPU. `device`: which one, as GpuRenderer takes
    // it; a software device is the CPU by a longer way and bakes nothing.
    static BakeMachine automatic(std::string device = {}) { return {Device::may, std::move(device)}; }
    // "cpu", "auto", "gpu" (the first real one, else a software device), or a device as GpuRenderer takes it, which is then
    // insisted on.
    static BakeMachine named(const std::string& word);

    // The device that bakes this map, started when one is first needed; null: the CPU does. Throws Error where a device is insisted
    // on that is not there, UsageError where one is that has no programs for the map.
    DeviceBaker* baker_of(Map map);
    bool insists() const { return use_ == Device::must; }

private:
    enum class Device { never, may, must };
    BakeMachine(Device use, std::string device) : use_(use), device_(std::move(device)) {}

    Device use_;
    std::string device_;
    std::unique_ptr<DeviceBaker> baker_;
};

}  // namespace relievo
