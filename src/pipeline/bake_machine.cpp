#include "pipeline/bake_machine.h"

#include "core/error.h"
#include "maps/map_kinds.h"

namespace relievo {

BakeMachine BakeMachine::named(const std::string& word) {
    if (word == "auto") return automatic();
    if (word == "cpu") return {Device::never, {}};
    return {Device::must, word == "gpu" ? std::string() : word};
}

DeviceBaker* BakeMachine::baker_of(Map map) {
    if (use_ == Device::never) return nullptr;
    if (!bakes_on_device(map)) {
        if (!insists()) return nullptr;
        std::string known;
        for (const Map m : device_baked_maps()) known += (known.empty() ? "" : ", ") + std::string(map_kind(m).id);
        throw UsageError("the " + std::string(map_kind(map).id) + " map is baked on the CPU only (--device cpu); a device bakes " +
                         known);
    }
    if (baker_) return baker_.get();
    if (insists()) {
        baker_ = std::make_unique<DeviceBaker>(device_, false);
    } else if (!is_real_gpu(device_)) {
        use_ = Device::never;  // looked for once
    } else {
        try {
            baker_ = std::make_unique<DeviceBaker>(device_, false);
        } catch (const Error&) {
            use_ = Device::never;  // the CPU can do it; what is to be drawn will say what the device has
        }
    }
    return baker_.get();
}

}  // namespace relievo
