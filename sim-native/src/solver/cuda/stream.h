#pragma once

#include "owned_array.h"

namespace natator::cuda {

/// A queue of work on the device that does not wait for the default stream, and goes before what asks for the lowest
/// priority.
class Stream {
public:
    Stream() { check(cudaStreamCreateWithPriority(&stream_, cudaStreamNonBlocking, priorities().highest), "stream"); }
    ~Stream() { cudaStreamDestroy(stream_); }
    Stream(const Stream&) = delete;
    Stream& operator=(const Stream&) = delete;

    cudaStream_t get() const { return stream_; }
    static int lowest_priority() { return priorities().lowest; }

private:
    struct Priorities {
        int lowest = 0, highest = 0;
    };
    static Priorities priorities() {
        Priorities range;
        check(cudaDeviceGetStreamPriorityRange(&range.lowest, &range.highest), "priorities");
        return range;
    }
    cudaStream_t stream_ = nullptr;
};

}  // namespace natator::cuda
