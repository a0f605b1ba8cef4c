// The reference behind the window's back ends as the picture that is computed at once, whatever was asked before.
#include "viewer/reference_worker.h"

#include "core/error.h"
#include "pipeline/map_set_bake.h"
#include "pipeline/reference_picture.h"
#include "pipeline/shown_picture.h"
#include "textures/procedural.h"

#include <gtest/gtest.h>

#include <chrono>

namespace relievo {
namespace {

constexpr float height_scale = 0.1f;

const BakedMaps& cobbles() {
    static const BakedMaps baked = [] {
        Material material = procedural_material("cobbles", 64, 1, 0);
        material.height_scale = height_scale;
        constexpr Map wanted[] = {Map::height, Map::normal, Map::colour};
        return bake_maps(std::move(material), wanted, {.use_cache = false});
    }();
    return baked;
}

ReferenceWorker::Request request(std::size_t view, int width, int height) {
    return {.stage = stage_for(views()[view]), .width = width, .height = height, .height_scale = height_scale, .zero_level = cobbles().zero_level};
}

Image8 at_once(const ReferenceWorker::Request& r) {
    const RayField rays = quad_rays(r.stage, r.width, r.height, {0, 0});
    return shown_picture(
        reference_picture(r.stage, cobbles().maps, {&rays, 1}, {.height_scale = r.height_scale, .zero_level = r.zero_level, .options = r.options}).colour);
}

TEST(reference_worker, ends_as_the_picture_drawn_at_once) {
    // Sizes that no level divides, and a single pixel.
    for (const auto& [width, height] : {std::pair{101, 67}, std::pair{1, 1}, std::pair{7, 130}}) {
        ReferenceWorker worker(cobbles().maps, 2);
        const auto what = request(1, width, height);
        worker.ask(what);
        worker.wait();
        EXPECT_EQ(worker.state().share, 1);
        EXPECT_EQ(worker.picture().texels, at_once(what).texels) << width << " x " << height;
    }
}

TEST(reference_worker, the_last_request_wins) {
    ReferenceWorker worker(cobbles().maps, 1);
    for (int k = 0; k < 20; ++k) worker.ask(request(static_cast<std::size_t>(k % 3), 300, 200));
    const auto last = request(2, 90, 60);
    worker.ask(last);
    worker.wait();
    EXPECT_EQ(worker.picture().texels, at_once(last).texels);
}

TEST(reference_worker, shows_something_long_before_it_is_whole) {
    ReferenceWorker worker(cobbles().maps, 1);
    worker.ask(request(0, 640, 400));
    double first_share = 1;
    while (true) {
        const auto state = worker.state();
        if (state.version == 0) continue;
        first_share = state.share;
        break;
    }
    EXPECT_LT(first_share, 0.5);
    EXPECT_FALSE(worker.picture().empty());
}

TEST(reference_worker, does_not_read_the_maps_once_told_to_forget) {
    BakedMaps baked = cobbles();
    ReferenceWorker worker(baked.maps, 1);
    worker.ask(request(0, 640, 400));
    worker.forget();
    const auto version = worker.state().version;
    baked.maps.height = {};
    baked.maps.normal.clear();
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    EXPECT_EQ(worker.state().version, version);
    worker.wait();  // nothing is asked, so nothing is waited for
}

TEST(reference_worker, ends_in_the_middle_of_its_work) {
    ReferenceWorker worker(cobbles().maps, 1);
    worker.ask(request(0, 2000, 1500));
}

TEST(reference_worker, hands_on_what_went_wrong) {
    const MapSet nothing;
    ReferenceWorker worker(nothing, 1);
    worker.ask(request(0, 8, 8));
    worker.wait();
    EXPECT_THROW(worker.state(), Error);
}

}  // namespace
}  // namespace relievo
