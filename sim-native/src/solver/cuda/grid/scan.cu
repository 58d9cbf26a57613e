#include "scan.h"

#include <cub/block/block_scan.cuh>

#include "solver/cuda/device_buffer.h"

namespace natator::cuda {
namespace {

constexpr int scan_threads = 1024, scan_items = 8, tile = scan_threads * scan_items;
constexpr int max_by_block = 4 * tile;  // more are faster by several

constexpr int tiles_of(int count) {
    return (count + tile - 1) / tile;
}

/// Numbers from one array's sums of tiles to the next one's: a multiple of 4, for those are read four at a time.
constexpr int sums_stride(int count) {
    return (tiles_of(count) + 3) / 4 * 4;
}

using BlockScan = cub::BlockScan<int, scan_threads>;

/// Replaces the values of one tile, from `first` on, by `before` and the sums of all before each in it. Returns the sum
/// of all of them, to every thread. Arrays begin at multiples of 16 bytes.
__device__ int scan_tile(BlockScan::TempStorage& storage, int* values, int count, int first, int before) {
    int items[scan_items];
    const int begin = first + static_cast<int>(threadIdx.x) * scan_items;
    int4* const fours = reinterpret_cast<int4*>(values + begin);
    const bool whole = begin + scan_items <= count;
    for (int k = 0; k < scan_items; k += 4) {
        if (whole)
            reinterpret_cast<int4&>(items[k]) = fours[k / 4];
        else
            for (int e = k; e < k + 4; ++e) items[e] = begin + e < count ? values[begin + e] : 0;
    }
    int sum = 0;
    BlockScan(storage).ExclusiveSum(items, items, sum);
    for (int k = 0; k < scan_items; k += 4) {
        if (whole)
            fours[k / 4] = {before + items[k], before + items[k + 1], before + items[k + 2], before + items[k + 3]};
        else
            for (int e = k; e < k + 4; ++e)
                if (begin + e < count) values[begin + e] = before + items[e];
    }
    return sum;
}

__device__ int* array_of(int* values, std::size_t stride) {
    return reinterpret_cast<int*>(reinterpret_cast<char*>(values) + blockIdx.y * stride);
}

/// A block for an array.
__global__ void __launch_bounds__(scan_threads) scan_by_block(int* values, int count, std::size_t stride) {
    __shared__ BlockScan::TempStorage storage;
    int before = 0;
    for (int first = 0; first < count; first += tile) {
        before += scan_tile(storage, array_of(values, stride), count, first, before);
        __syncthreads();
    }
}

/// A block for a tile: each by itself, and their sums by array.
__global__ void __launch_bounds__(scan_threads) scan_tiles(int* values, int count, std::size_t stride, int* sums) {
    __shared__ BlockScan::TempStorage storage;
    const int sum = scan_tile(storage, array_of(values, stride), count, static_cast<int>(blockIdx.x) * tile, 0);
    if (threadIdx.x == 0) sums[blockIdx.y * sums_stride(count) + blockIdx.x] = sum;
}

/// Once these are scanned: adds to each tile what is before it.
__global__ void __launch_bounds__(scan_threads)
    add_before(int* values, int count, std::size_t stride, const int* sums) {
    const int before = sums[blockIdx.y * sums_stride(count) + blockIdx.x];
    const int begin = static_cast<int>(blockIdx.x) * tile, end = min(begin + tile, count);
    for (int k = begin + static_cast<int>(threadIdx.x); k < end; k += scan_threads)
        array_of(values, stride)[k] += before;
}

}  // namespace

std::size_t scan_bytes(int count, int arrays) {
    return sizeof(int) * static_cast<std::size_t>(arrays) * sums_stride(count);
}

void exclusive_scan(int* values, int count, int arrays, std::size_t stride, void* room, cudaStream_t stream) {
    const dim3 by_array{1, static_cast<unsigned>(arrays)};
    if (count <= max_by_block) {
        scan_by_block<<<by_array, scan_threads, 0, stream>>>(values, count, stride);
        return;
    }
    const int tiles = tiles_of(count);
    int* const sums = static_cast<int*>(room);
    const dim3 by_tile{static_cast<unsigned>(tiles), static_cast<unsigned>(arrays)};
    scan_tiles<<<by_tile, scan_threads, 0, stream>>>(values, count, stride, sums);
    scan_by_block<<<by_array, scan_threads, 0, stream>>>(sums, tiles, sums_stride(count) * sizeof(int));
    add_before<<<by_tile, scan_threads, 0, stream>>>(values, count, stride, sums);
}

}  // namespace natator::cuda
