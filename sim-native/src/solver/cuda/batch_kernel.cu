// A batch of States of one Model of scheme flex: a block per State, a whole update per turn, everything between two updates on the
// device. Blocks take (update, State) pairs from a queue, so that 150 States keep 132 multiprocessors busy.
#include "batch_kernel.cuh"

#include <algorithm>

#include "device_buffer.h"
#include "layout.cuh"

namespace natator::cuda {
namespace {

template <class Real>
const void* kernel(const ModelView<Real>& model, bool on_chip) {
    return model.plan.effects() ? batch_kernel<Real, true>(on_chip) : batch_kernel<Real, false>(on_chip);
}

}  // namespace

template <class Real>
int resident_blocks(const ModelView<Real>& model, bool on_chip) {
    if (on_chip && model.plan.effects()) return 0;  // no such kernel: they are rare, and take long to compile
    int device = 0, most_chip_bytes = 0, processors = 0, per_processor = 0;
    check(cudaGetDevice(&device), "current device");
    check(cudaDeviceGetAttribute(&most_chip_bytes, cudaDevAttrMaxSharedMemoryPerBlockOptin, device), "shared memory");
    check(cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device), "multiprocessors");
    cudaFuncAttributes attributes{};
    check(cudaFuncGetAttributes(&attributes, kernel(model, on_chip)), "kernel");
    const int most_bytes = most_chip_bytes - static_cast<int>(attributes.sharedSizeBytes);
    const std::size_t bytes = layout_of(model, on_chip).chip_bytes;
    if (bytes > static_cast<std::size_t>(most_bytes)) return 0;
    // The limit belongs to the kernel, for all Models and threads: one of this Model alone could come between another's limit and
    // its launch.
    check(cudaFuncSetAttribute(kernel(model, on_chip), cudaFuncAttributeMaxDynamicSharedMemorySize, most_bytes),
          "shared memory");
    check(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&per_processor, kernel(model, on_chip), threads, bytes),
          "occupancy");
    return processors * per_processor;
}

template <class Real>
void launch_batch(const BatchView<Real>& batch, bool on_chip, int blocks) {
    BatchView<Real> argument = batch;
    void* arguments[] = {&argument};
    const int most = std::min(blocks, batch.states);
    check(cudaLaunchKernel(kernel(batch.model, on_chip), dim3(most), dim3(threads), arguments, batch.layout.chip_bytes,
                           nullptr),
          "launch");
}

template int resident_blocks(const ModelView<float>&, bool);
template int resident_blocks(const ModelView<double>&, bool);
template void launch_batch(const BatchView<float>&, bool, int);
template void launch_batch(const BatchView<double>&, bool, int);

}  // namespace natator::cuda
