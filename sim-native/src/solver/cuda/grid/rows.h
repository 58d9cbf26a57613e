#pragma once

#include "solver/cuda/device_buffer.h"

namespace natator::cuda {

/// The most bytes from one row to the next that CUDA takes in one copy (cudaDeviceProp::memPitch); the arrays of a
/// State of some million particles are further apart.
inline constexpr std::size_t max_pitch = 0x7fffffff;

/// Copies a row of `count` on the device, to it or from it.
template <class T>
void copy_row(T* to, const T* from, std::size_t count, cudaStream_t stream) {
    if (count > 0) check(cudaMemcpyAsync(to, from, count * sizeof(T), cudaMemcpyDefault, stream), "copy");
}

/// Copies `rows` rows of `count` on the device, to it or from it; their begins are so many bytes apart.
template <class T>
void copy_rows(T* to, std::size_t to_stride, const T* from, std::size_t from_stride, std::size_t count, int rows,
               cudaStream_t stream) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes == 0) return;
    if (rows > 1 && to_stride <= max_pitch && from_stride <= max_pitch) {
        check(cudaMemcpy2DAsync(to, to_stride, from, from_stride, bytes, rows, cudaMemcpyDefault, stream), "copy");
        return;
    }
    for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row)
        check(
            cudaMemcpyAsync(reinterpret_cast<char*>(to) + row * to_stride,
                            reinterpret_cast<const char*>(from) + row * from_stride, bytes, cudaMemcpyDefault, stream),
            "copy");
}

/// Sets `rows` rows of `count` to 0.
template <class T>
void clear_rows(T* rows_begin, std::size_t stride, std::size_t count, int rows, cudaStream_t stream) {
    const std::size_t bytes = count * sizeof(T);
    if (bytes == 0) return;
    if (rows > 1 && stride <= max_pitch) {
        check(cudaMemset2DAsync(rows_begin, stride, 0, bytes, rows, stream), "clear");
        return;
    }
    for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row)
        check(cudaMemsetAsync(reinterpret_cast<char*>(rows_begin) + row * stride, 0, bytes, stream), "clear");
}

}  // namespace natator::cuda
