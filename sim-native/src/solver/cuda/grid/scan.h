#pragma once

#include <cuda_runtime.h>

#include <cstddef>

namespace natator::cuda {

/// Bytes of room that exclusive_scan needs for so many arrays of so many values.
std::size_t scan_bytes(int count, int arrays);

/// Replaces values[0..count) by the sums of all before each; so too for the other arrays side by side, whose begins are
/// `stride` bytes apart, in the same launches. All begin at multiples of 16 bytes.
void exclusive_scan(int* values, int count, int arrays, std::size_t stride, void* room, cudaStream_t stream);

}  // namespace natator::cuda
