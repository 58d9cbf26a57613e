#pragma once

#include <cuda_runtime.h>

#include <cstddef>
#include <new>
#include <stdexcept>
#include <string>
#include <utility>

namespace natator::cuda {

/// Throws std::runtime_error with CUDA's own words.
inline void check(cudaError_t status, const char* doing) {
    if (status != cudaSuccess)
        throw std::runtime_error(std::string("cuda: ") + doing + ": " + cudaGetErrorString(status));
}

/// Of the current device.
inline int device_attribute(cudaDeviceAttr what) {
    int device = 0, value = 0;
    check(cudaGetDevice(&device), "current device");
    check(cudaDeviceGetAttribute(&value, what, device), "attribute of the device");
    return value;
}

/// An array in memory that Memory allocates and frees. Throws std::bad_alloc when there is none left.
template <class T, class Memory>
class OwnedArray {
public:
    OwnedArray() = default;
    explicit OwnedArray(std::size_t size) : size_(size) {
        if (size == 0) return;
        void* data = nullptr;
        const cudaError_t status = Memory::allocate(&data, size * sizeof(T));
        if (status == cudaErrorMemoryAllocation) {
            cudaGetLastError();
            throw std::bad_alloc();
        }
        check(status, Memory::allocating);
        data_ = static_cast<T*>(data);
    }
    ~OwnedArray() {
        if (data_) Memory::free(data_, size_ * sizeof(T));
    }
    OwnedArray(OwnedArray&& other) noexcept
        : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
    OwnedArray& operator=(OwnedArray&& other) noexcept {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        return *this;
    }

    T* data() const { return data_; }
    std::size_t size() const { return size_; }

private:
    T* data_ = nullptr;
    std::size_t size_ = 0;
};

}  // namespace natator::cuda
