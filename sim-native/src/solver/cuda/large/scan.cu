#include "scan.h"

#include <cub/device/device_scan.cuh>

#include "solver/cuda/device_buffer.h"

namespace natator::cuda {

std::size_t scan_bytes(int count) {
    std::size_t bytes = 0;
    int* const none = nullptr;
    check(cub::DeviceScan::ExclusiveSum(nullptr, bytes, none, none, count), "scan");
    return bytes;
}

void exclusive_scan(int* values, int count, void* room, std::size_t bytes, cudaStream_t stream) {
    check(cub::DeviceScan::ExclusiveSum(room, bytes, values, values, count, stream), "scan");
}

}  // namespace natator::cuda
