// Pictures of a stage by a technique on a Vulkan device, headless.
#pragma once

#include "core/frame.h"
#include "core/map_set.h"
#include "core/progress.h"
#include "scenes/scene.h"
#include "techniques/modifiers.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace relievo {

struct GpuDevice {
    std::string name;
    std::string driver;
    bool software;      // runs on the CPU
    std::string lacks;  // what it lacks to be usable, or empty
};

// Every Vulkan device of this machine; none if there is no Vulkan.
std::vector<GpuDevice> gpu_devices();

// A material on the device: its maps uploaded once.
class GpuMaterial;

struct PictureSettings {
    int width = 0;
    int height = 0;
    DrawOptions options{};
    std::vector<Vec2f> offsets{
        {0, 0}};  // samples per pixel, offset from its centre in pixels; colour averages them in linear light
};

class GpuRenderer {
public:
    // device: "" for the first real GPU and else the software device, "software", or part of a device's name. Throws Error with
    // the list of devices when there is no match.
    GpuRenderer(const std::string& device, bool validation);
    ~GpuRenderer();

    std::string device_name() const;
    std::string driver() const;
    // Messages of the validation layers since the start; empty without validation.
    std::vector<std::string> validation_messages() const;

    std::shared_ptr<const GpuMaterial> upload(const MapSet& maps, float height_scale, float zero_level);

    // The rays of a picture as this device interpolates them, one sample per pixel at the centre plus `offset`.
    RayField rays(const Stage& stage, const GpuMaterial& material, int width, int height, Vec2f offset);

    // Colour averages settings.offsets; every other plane is taken at the pixel centre.
    Frame draw(const Stage& stage, const GpuMaterial& material, const Technique& technique, const MarchParams& params,
               const PictureSettings& settings);

    // The same for several techniques, with Frame::gpu_ms: milliseconds of the colour pass (one sample per pixel, nothing else
    // written), runs x techniques, interleaved A B C ... A B C ..., after one unmeasured round. `progress` is called between draws,
    // outside of what is timed.
    struct Timed {
        const Technique* technique;
        MarchParams params;
        DrawOptions options{};
    };
    std::vector<Frame> draw_timed(const Stage& stage, const GpuMaterial& material, std::span<const Timed> timed,
                                  const PictureSettings& settings, int runs, const Progress& progress = {});

    // The search alone on explicit rays, in a compute shader: hits and fetch counts in the order of the rays.
    struct Cast {
        glsl::SurfaceHit hit;
        int fetches;
    };
    std::vector<Cast> cast(const GpuMaterial& material, const Technique& technique, const MarchParams& params,
                           std::span<const glsl::SurfaceRay> rays);

private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace relievo
