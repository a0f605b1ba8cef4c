#include "viewer/reference_worker.h"

#include "core/error.h"
#include "core/parallel_for.h"
#include "pipeline/reference_picture.h"
#include "pipeline/shown_picture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace relievo {

namespace {

// Edge of the squares of each level, in pixels. The first costs a 64th of the picture, so that it can follow the hand.
constexpr std::array levels{8, 3, 1};
// Rows drawn between two looks at the clock and at newer requests, for each thread.
constexpr int rows_per_thread = 8;

RayField rows_of(const RayField& rays, int begin, int end) {
    RayField part(rays.width, end - begin);
    const auto copy = [&](const auto& from, auto& to) {
        std::copy(from.at(0, begin), from.at(0, begin) + to.texels.size(), to.texels.begin());
    };
    copy(rays.coverage, part.coverage);
    copy(rays.uv, part.uv);
    copy(rays.view, part.view);
    copy(rays.lod, part.lod);
    return part;
}

}  // namespace

ReferenceWorker::ReferenceWorker(const MapSet& maps, int threads)
    // A core is left to the window.
    : maps_(maps), threads_(threads > 0 ? threads : std::max(1, default_threads() - 1)), thread_([this] { work(); }) {}

ReferenceWorker::~ReferenceWorker() {
    {
        const std::lock_guard lock(mutex_);
        end_ = true;
        asked_.reset();
        ++number_;
    }
    changed_.notify_all();
    thread_.join();
}

void ReferenceWorker::ask(Request request) {
    {
        const std::lock_guard lock(mutex_);
        asked_ = std::move(request);
        ++number_;
    }
    changed_.notify_all();
}

void ReferenceWorker::forget() {
    std::unique_lock lock(mutex_);
    asked_.reset();
    ++number_;
    changed_.wait(lock, [&] { return !busy_; });
}

void ReferenceWorker::wait() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return !busy_ && !asked_; });
}

ReferenceWorker::State ReferenceWorker::state() {
    const std::lock_guard lock(mutex_);
    if (error_) std::rethrow_exception(error_);
    return state_;
}

Image8 ReferenceWorker::picture() {
    const std::lock_guard lock(mutex_);
    return shown_;
}

bool ReferenceWorker::outdated(std::uint64_t number) {
    const std::lock_guard lock(mutex_);
    return number != number_;
}

void ReferenceWorker::work() {
    std::unique_lock lock(mutex_);
    while (true) {
        changed_.wait(lock, [&] { return asked_ || end_; });
        if (end_) return;
        const Request request = std::move(*asked_);
        const std::uint64_t number = number_;
        asked_.reset();
        busy_ = true;
        lock.unlock();
        std::exception_ptr error;
        try {
            draw(request, number);
        } catch (const Cancelled&) {
            // Something newer was asked.
        } catch (...) {
            error = std::current_exception();
        }
        lock.lock();
        if (error) error_ = error;
        busy_ = false;
        changed_.notify_all();
    }
}

void ReferenceWorker::draw(const Request& request, std::uint64_t number) {
    const ReferencePicture settings{
        .height_scale = request.height_scale, .zero_level = request.zero_level, .options = request.options, .threads = threads_};
    for (const int scale : levels) {
        // The first level is always finished: while the hand moves, every request is outdated as soon as it is made.
        const bool coarsest = scale == levels.front();
        const auto stop = [&] {
            if (!coarsest && outdated(number)) throw Cancelled();
        };
        stop();
        RayField rays = quad_rays(request.stage, (request.width + scale - 1) / scale, (request.height + scale - 1) / scale, {0, 0});
        // The maps are read as sharply as in the finished picture, or the preview would look smoother than the truth.
        for (float& lod : rays.lod.texels) lod -= std::log2(static_cast<float>(scale));
        const int band = scale == 1 ? rows_per_thread * threads_ : rays.height;
        for (int y = 0; y < rays.height; y += band) {
            stop();
            const int end = std::min(rays.height, y + band);
            const RayField part = rows_of(rays, y, end);
            const Frame frame =
                reference_picture(request.stage, maps_, {&part, 1}, settings, [&](std::string_view, double) { stop(); });
            publish(shown_picture(frame.colour), y, scale, scale == 1 ? static_cast<double>(end) / rays.height : 0, request);
        }
    }
}

void ReferenceWorker::publish(const Image8& part, int first_row, int scale, double share, const Request& request) {
    const std::lock_guard lock(mutex_);
    if (shown_.width != request.width || shown_.height != request.height) shown_ = Image8(request.width, request.height, 4, 0);
    const int end = std::min(request.height, (first_row + part.height) * scale);
    for (int y = first_row * scale; y < end; ++y) {
        const std::uint8_t* row = part.at(0, y / scale - first_row);
        std::uint8_t* out = shown_.at(0, y);
        for (int x = 0; x < request.width; ++x) std::copy_n(row + x / scale * 4, 4, out + 4 * x);
    }
    state_ = {state_.version + 1, share, request.width, request.height};
}

}  // namespace relievo
