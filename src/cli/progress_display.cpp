#include "cli/progress_display.h"

#include "cli/interrupt.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <unistd.h>

namespace relievo {

namespace {

using Clock = std::chrono::steady_clock;

class Display {
public:
    explicit Display(bool quiet) : quiet_(quiet), terminal_(isatty(STDERR_FILENO) != 0) {}
    ~Display() { end_line(); }
    Display(const Display&) = delete;
    Display& operator=(const Display&) = delete;

    void show(std::string_view stage, double share) {
        stop_if_interrupted();
        if (quiet_) return;
        const auto now = Clock::now();
        const bool new_stage = stage != stage_;
        if (new_stage) {
            end_line();
            stage_ = stage;
            began_ = now;
        }
        // A terminal is redrawn ten times a second; a log gets a line when a stage begins, ends, and every ten seconds between.
        const auto pause = terminal_ ? std::chrono::milliseconds(100) : std::chrono::milliseconds(10000);
        if (!new_stage && now - last_ < pause && share < 1) return;
        if (share >= 1 && done_) return;
        done_ = share >= 1;
        last_ = now;
        const double seconds = std::chrono::duration<double>(now - began_).count();
        const double left = share > 0.01 ? seconds * (1 - share) / share : -1;
        if (terminal_) {
            constexpr int width = 30;
            std::string bar(width, '.');
            std::fill_n(bar.begin(), static_cast<int>(share * width), '#');
            std::fprintf(stderr, "\r\033[K[%s] %3.0f %%  %s", bar.c_str(), share * 100, stage_.c_str());
            if (left >= 1 && !done_) std::fprintf(stderr, ", %.0f s left", left);
            std::fflush(stderr);
            line_open_ = true;
        } else if (done_) {
            std::fprintf(stderr, "%s: done in %.1f s\n", stage_.c_str(), seconds);
        } else if (left >= 1) {
            std::fprintf(stderr, "%s: %.0f %%, %.0f s left\n", stage_.c_str(), share * 100, left);
        } else if (new_stage) {
            std::fprintf(stderr, "%s\n", stage_.c_str());
        }
    }

private:
    void end_line() {
        if (line_open_) std::fputc('\n', stderr);
        line_open_ = false;
        done_ = false;
    }

    bool quiet_;
    bool terminal_;
    bool line_open_ = false;
    bool done_ = false;
    std::string stage_;
    Clock::time_point began_;
    Clock::time_point last_;
};

}  // namespace

Progress progress_display(bool quiet) {
    auto display = std::make_shared<Display>(quiet);
    return [display](std::string_view stage, double share) { display->show(stage, share); };
}

}  // namespace relievo
