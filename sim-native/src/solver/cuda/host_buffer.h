#pragma once

#include "device_buffer.h"

namespace natator::cuda {

/// Of OwnedArray: the host's, page-locked.
struct OnHost {
    static constexpr const char* allocating = "host memory";
    static cudaError_t allocate(void** data, std::size_t bytes) { return cudaMallocHost(data, bytes); }
    static void free(void* data, std::size_t) { cudaFreeHost(data); }
};

/// An array in memory of the host that a device reads and writes at its full speed.
template <class T>
class HostBuffer : public OwnedArray<T, OnHost> {
    using Array = OwnedArray<T, OnHost>;

public:
    using Array::Array, Array::data, Array::size;
    T& operator[](std::size_t k) const { return data()[k]; }

    /// Fills it with as much of what a device has.
    void fetch(const DeviceBuffer<T>& from) const {
        if (size() > 0) check(cudaMemcpy(data(), from.data(), size() * sizeof(T), cudaMemcpyDeviceToHost), "download");
    }
};

}  // namespace natator::cuda
