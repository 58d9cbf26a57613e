#include "scan.h"

#include <cub/block/block_scan.cuh>
#include <cub/device/device_scan.cuh>

#include "solver/cuda/device_buffer.h"

namespace natator::cuda {

std::size_t scan_bytes(int count) {
    std::size_t bytes = 0;
    int* const none = nullptr;
    check(cub::DeviceScan::ExclusiveSum(nullptr, bytes, none, none, count), "scan");
    return bytes;
}

namespace {

constexpr int scan_threads = 1024, scan_items = 8;
constexpr int most_by_block = 1 << 16;

/// A block for an array.
__global__ void __launch_bounds__(scan_threads) scan_by_block(int* values, int count, std::size_t stride) {
    using Scan = cub::BlockScan<int, scan_threads>;
    __shared__ typename Scan::TempStorage storage;
    int* const own = reinterpret_cast<int*>(reinterpret_cast<char*>(values) + blockIdx.x * stride);
    int before = 0;
    for (int first = 0; first < count; first += scan_threads * scan_items) {
        int items[scan_items];
        const int begin = first + static_cast<int>(threadIdx.x) * scan_items;
        for (int k = 0; k < scan_items; ++k) items[k] = begin + k < count ? own[begin + k] : 0;
        int sum = 0;
        Scan(storage).ExclusiveSum(items, items, sum);
        for (int k = 0; k < scan_items; ++k)
            if (begin + k < count) own[begin + k] = before + items[k];
        before += sum;
        __syncthreads();
    }
}

}  // namespace

void exclusive_scan(int* values, int count, int arrays, std::size_t stride, void* room, std::size_t bytes,
                    cudaStream_t stream) {
    if (count <= most_by_block) {
        scan_by_block<<<arrays, scan_threads, 0, stream>>>(values, count, stride);
        return;
    }
    for (int k = 0; k < arrays; ++k) {
        int* const own = reinterpret_cast<int*>(reinterpret_cast<char*>(values) + k * stride);
        check(cub::DeviceScan::ExclusiveSum(room, bytes, own, own, count, stream), "scan");
    }
}

}  // namespace natator::cuda
