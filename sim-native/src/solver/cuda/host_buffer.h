#pragma once

#include <cuda_runtime.h>

#include <new>
#include <utility>

#include "device_buffer.h"

namespace natator::cuda {

/// Page-locked memory of the host, which a device reads and writes at its full speed.
template <class T>
class HostBuffer {
public:
    HostBuffer() = default;
    explicit HostBuffer(std::size_t size) : size_(size) {
        if (size == 0) return;
        const cudaError_t status = cudaMallocHost(&data_, size * sizeof(T));
        if (status == cudaErrorMemoryAllocation) {
            cudaGetLastError();
            throw std::bad_alloc();
        }
        check(status, "host memory");
    }
    ~HostBuffer() { cudaFreeHost(data_); }
    HostBuffer(HostBuffer&& other) noexcept
        : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
    HostBuffer& operator=(HostBuffer&& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        return *this;
    }

    T* data() const { return data_; }
    std::size_t size() const { return size_; }
    T& operator[](std::size_t k) const { return data_[k]; }

    /// Fills it with as much of what a device has.
    void fetch(const DeviceBuffer<T>& from) const {
        if (size_ > 0) check(cudaMemcpy(data_, from.data(), size_ * sizeof(T), cudaMemcpyDeviceToHost), "download");
    }

private:
    T* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace natator::cuda
