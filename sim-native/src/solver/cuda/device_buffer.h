#pragma once

#include <cuda_runtime.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "device_memory.h"

namespace natator::cuda {

/// Throws std::runtime_error with CUDA's own words.
inline void check(cudaError_t status, const char* doing) {
    if (status != cudaSuccess)
        throw std::runtime_error(std::string("cuda: ") + doing + ": " + cudaGetErrorString(status));
}

/// Waits for uploads and clears, on the default stream. Not for the whole device: that is refused, and breaks what another
/// thread is capturing, as long as it captures a graph.
inline void wait_for_uploads() {
    check(cudaStreamSynchronize(nullptr), "upload");
}

/// An array in device memory. Throws std::bad_alloc when there is none left.
template <class T>
class DeviceBuffer {
public:
    DeviceBuffer() = default;
    explicit DeviceBuffer(std::size_t size) : size_(size) {
        if (size == 0) return;
        const cudaError_t status = cudaMalloc(&data_, size * sizeof(T));
        if (status == cudaErrorMemoryAllocation) {
            cudaGetLastError();
            throw std::bad_alloc();
        }
        check(status, "allocate");
        DeviceMemory::take(size * sizeof(T));
    }
    explicit DeviceBuffer(const std::vector<T>& values) : DeviceBuffer(values.size()) { upload(values); }
    ~DeviceBuffer() {
        if (!data_) return;
        cudaFree(data_);
        DeviceMemory::give_back(size_ * sizeof(T));
    }
    DeviceBuffer(DeviceBuffer&& other) noexcept
        : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
    DeviceBuffer& operator=(DeviceBuffer&& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        return *this;
    }

    T* data() const { return data_; }
    std::size_t size() const { return size_; }

    void upload(const std::vector<T>& values) {
        if (!values.empty())
            check(cudaMemcpy(data_, values.data(), values.size() * sizeof(T), cudaMemcpyHostToDevice), "upload");
    }
    std::vector<T> download() const {
        std::vector<T> values(size_);
        if (size_ > 0) check(cudaMemcpy(values.data(), data_, size_ * sizeof(T), cudaMemcpyDeviceToHost), "download");
        return values;
    }
    void clear() {
        if (size_ > 0) check(cudaMemset(data_, 0, size_ * sizeof(T)), "clear");
    }

private:
    T* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace natator::cuda
