// The exact reference of what is being looked at, drawn on the CPU behind the window's back: coarse at once, then finer, and
// begun anew whenever something is asked that makes the unfinished picture useless.
#pragma once

#include "core/image.h"
#include "core/map_set.h"
#include "scenes/scene.h"
#include "techniques/modifiers.h"

#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace relievo {

class ReferenceWorker {
public:
    struct Request {
        Stage stage;
        int width = 0;
        int height = 0;
        float height_scale = 0;
        float zero_level = 1;
        DrawOptions options{};
    };

    // The maps are read from another thread until forget() or the end; they must hold height, normal and colour.
    ReferenceWorker(const MapSet& maps, int threads);
    ~ReferenceWorker();
    ReferenceWorker(const ReferenceWorker&) = delete;
    ReferenceWorker& operator=(const ReferenceWorker&) = delete;

    void ask(Request request);

    // Gives up what is unfinished; from its return to the next ask() no map is read.
    void forget();

    // Until the picture last asked for is whole.
    void wait();

    // What there is by now. `share` of the finest level that is done; version grows with every change. Rethrows an error of the
    // work.
    struct State {
        std::uint64_t version = 0;
        double share = 0;
        int width = 0;
        int height = 0;
    };
    State state();

    // The picture as shown_picture gives it, empty before the first.
    Image8 picture();

private:
    void work();
    void draw(const Request& request, std::uint64_t number);
    bool outdated(std::uint64_t number);
    void publish(const Image8& part, int first_row, int scale, double share, const Request& request);

    const MapSet& maps_;
    int threads_;

    std::mutex mutex_;
    std::condition_variable changed_;
    std::optional<Request> asked_;
    std::uint64_t number_ = 0;  // of the last request
    bool busy_ = false;
    bool end_ = false;
    Image8 shown_;
    State state_;
    std::exception_ptr error_;
    std::thread thread_;  // last: it uses all of the above
};

}  // namespace relievo
