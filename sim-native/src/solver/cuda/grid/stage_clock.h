#pragma once

#include <deque>
#include <optional>

#include "natator/solver.h"
#include "solver/cuda/device_buffer.h"
#include "solver/stage.h"

namespace natator::cuda {

/// Takes the device's time of every stage that a stream goes through.
class StageClock {
public:
    explicit StageClock(cudaStream_t stream) : stream_(stream) { mark(std::nullopt); }
    ~StageClock() {
        for (const Mark& mark : marks_) cudaEventDestroy(mark.event);
    }
    StageClock(const StageClock&) = delete;
    StageClock& operator=(const StageClock&) = delete;

    /// The stage ends here that began at the last mark.
    void mark(std::optional<Stage> stage) {
        cudaEvent_t event = nullptr;
        check(cudaEventCreate(&event), "event");
        marks_.push_back({event, stage});
        check(cudaEventRecord(event, stream_), "event");
    }

    /// The stream must have come to its end.
    void add_to(StageProfile& profile) const {
        for (std::size_t k = 1; k < marks_.size(); ++k) {
            float milliseconds = 0;
            check(cudaEventElapsedTime(&milliseconds, marks_[k - 1].event, marks_[k].event), "event");
            profile.add(name(*marks_[k].stage), 1e-3 * static_cast<double>(milliseconds));
        }
    }

private:
    struct Mark {
        cudaEvent_t event;
        std::optional<Stage> stage;
    };
    cudaStream_t stream_;
    std::deque<Mark> marks_;
};

}  // namespace natator::cuda
