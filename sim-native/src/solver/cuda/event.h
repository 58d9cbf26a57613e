#pragma once

#include "device_buffer.h"

namespace natator::cuda {

/// A point in the device's own time.
class Event {
public:
    explicit Event(unsigned flags = cudaEventDefault) { check(cudaEventCreateWithFlags(&event_, flags), "event"); }
    ~Event() { cudaEventDestroy(event_); }
    Event(const Event&) = delete;
    Event& operator=(const Event&) = delete;

    void record(cudaStream_t stream = nullptr) const { check(cudaEventRecord(event_, stream), "event"); }
    void wait() const { check(cudaEventSynchronize(event_), "run"); }
    /// Seconds from another event to this one; both must have passed.
    double seconds_since(const Event& earlier) const {
        float milliseconds = 0;
        check(cudaEventElapsedTime(&milliseconds, earlier.event_, event_), "event");
        return 1e-3 * static_cast<double>(milliseconds);
    }

private:
    cudaEvent_t event_ = nullptr;
};

}  // namespace natator::cuda
