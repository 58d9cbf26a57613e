#pragma once

#include <vector>

#include "device_memory.h"
#include "owned_array.h"

namespace natator::cuda {

/// Waits for uploads and clears, on the default stream. Not for the whole device: that is refused, and breaks what
/// another thread is capturing, as long as it captures a graph.
inline void wait_for_uploads() {
    check(cudaStreamSynchronize(nullptr), "upload");
}

/// Of OwnedArray: the current device's.
struct OnDevice {
    static constexpr const char* allocating = "allocate";
    static cudaError_t allocate(void** data, std::size_t bytes) {
        const cudaError_t status = cudaMalloc(data, bytes);
        if (status == cudaSuccess) DeviceMemory::take(bytes);
        return status;
    }
    static void free(void* data, std::size_t bytes) {
        cudaFree(data);
        DeviceMemory::release(bytes);
    }
};

/// An array in device memory.
template <class T>
class DeviceBuffer : public OwnedArray<T, OnDevice> {
    using Array = OwnedArray<T, OnDevice>;

public:
    using Array::Array, Array::data, Array::size;
    DeviceBuffer() = default;
    explicit DeviceBuffer(const std::vector<T>& values) : Array(values.size()) { upload(values); }

    void upload(const std::vector<T>& values) {
        if (!values.empty())
            check(cudaMemcpy(data(), values.data(), values.size() * sizeof(T), cudaMemcpyHostToDevice), "upload");
    }
    std::vector<T> download() const {
        std::vector<T> values(size());
        if (size() > 0)
            check(cudaMemcpy(values.data(), data(), size() * sizeof(T), cudaMemcpyDeviceToHost), "download");
        return values;
    }
    void clear() {
        if (size() > 0) check(cudaMemset(data(), 0, size() * sizeof(T)), "clear");
    }
};

}  // namespace natator::cuda
