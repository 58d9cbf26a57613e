#pragma once

#include <algorithm>
#include <chrono>

namespace natator::cli {

/// When the next frame may be simulated, so that simulated time runs no faster than asked for. Time that was lost is
/// not made up for, but for one frame's worth of it: after a delay the pace goes on, and doesn't run to catch up.
class Pace {
public:
    using Clock = std::chrono::steady_clock;

    /// `rate`: simulated seconds per second of wall time, at most; 0 = as fast as possible.
    explicit Pace(double rate) : rate_(rate) {}

    void set_rate(double rate) {
        rate_ = rate;
        restart();
    }
    /// The next frame may come at once.
    void restart() { next_ = Clock::now(); }
    Clock::time_point next() const { return next_; }

    /// A frame of `time_step` (s) begins.
    void begin_frame(double time_step) {
        if (rate_ == 0) return;
        const auto interval =
            std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(time_step / rate_));
        next_ = std::max(next_, Clock::now() - interval) + interval;
    }

private:
    double rate_;
    Clock::time_point next_ = Clock::now();
};

}  // namespace natator::cli
