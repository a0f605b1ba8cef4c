// Every mode of fur on small meshes of our own making, drawn small under validation: one painter a mode for the whole program, as
// starting a device costs more than most pictures.
#pragma once

#include "core/error.h"
#include "mesh/made_up_scan.h"
#include "pipeline/coat_painter.h"
#include "pipeline/fur_reference.h"
#include "pipeline/fur_score.h"
#include "pipeline/grown_fur.h"
#include "pipeline/replicate_fur.h"
#include "render/gpu_renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <ostream>
#include <string>

namespace relievo {

inline void PrintTo(const FurMode* mode, std::ostream* out) { *out << mode->id; }

}  // namespace relievo

namespace relievo::fur_contract {

inline constexpr int width = 160, height = 100;

inline MeshView camera_of(const Coat& coat) { return view_of_sphere({0, 0, 0}, 1 + static_cast<double>(coat.length) * 0.6, width, height); }

// A coat by name with as many strands as make them as wide in these pictures as the whole coat's are in those of 640x400.
inline Coat coat_of(std::string_view id) {
    Coat coat = std::ranges::find(coat_presets(), id, &CoatPreset::id)->coat;
    coat.strands /= 16;
    return coat;
}

// Every contract test is run once per row of fur_modes; its name ends with the mode's id.
class EveryMode : public testing::TestWithParam<const FurMode*> {
protected:
    void SetUp() override {
        if (std::ranges::none_of(gpu_devices(), [](const GpuDevice& d) { return d.lacks.empty(); }))
            GTEST_SKIP() << "no Vulkan device: install a driver (mesa-vulkan-drivers is a software one)";
        std::unique_ptr<CoatPainter>& kept = painters()[mode().kind];
        if (!kept) kept = std::make_unique<CoatPainter>(mode().kind, "", true);
        painter = kept.get();
    }
    void TearDown() override {
        if (painter == nullptr) return;
        const auto messages = painter->validation_messages();
        for (std::size_t& seen = messages_seen()[mode().kind]; seen < messages.size(); ++seen) ADD_FAILURE() << messages[seen];
    }
    const FurMode& mode() const { return *GetParam(); }
    FurFrames drawn(const Mesh& mesh, const Coat& coat, int passes, int threads = 0) {
        FurView view{.camera = camera_of(coat), .passes = passes};
        view = with_layers(view, painter->wear(mesh, coat, view.camera, 0, threads).layers);
        return painter->draw(view);
    }

    CoatPainter* painter = nullptr;

    // All go before main ends: the loader of Vulkan may be gone when statics are.
    static std::map<FurKind, std::unique_ptr<CoatPainter>>& painters() {
        static std::map<FurKind, std::unique_ptr<CoatPainter>> all;
        return all;
    }

private:
    static std::map<FurKind, std::size_t>& messages_seen() {
        static std::map<FurKind, std::size_t> all;
        return all;
    }
};

inline auto all_modes() {
    std::vector<const FurMode*> all;
    for (const FurMode& m : fur_modes) all.push_back(&m);
    return testing::ValuesIn(all);
}
inline std::string mode_id(const testing::TestParamInfo<const FurMode*>& info) { return std::string(info.param->id); }

#define FOR_EVERY_MODE(suite) INSTANTIATE_TEST_SUITE_P(fur, suite, all_modes(), mode_id)

}  // namespace relievo::fur_contract
