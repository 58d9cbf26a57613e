#pragma once

#include <cuda_runtime.h>

#include <cstddef>

namespace natator::cuda {

/// Bytes of room that exclusive_scan needs for so many values.
std::size_t scan_bytes(int count);

/// Replaces values[0..count) by the sums of all before each; so too for the other arrays side by side, whose begins are
/// `stride` bytes apart.
void exclusive_scan(int* values, int count, int arrays, std::size_t stride, void* room, std::size_t bytes,
                    cudaStream_t stream);

}  // namespace natator::cuda
