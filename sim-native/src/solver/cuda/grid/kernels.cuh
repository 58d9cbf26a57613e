#pragma once

#include "slots.cuh"

namespace natator::cuda {

inline constexpr int grid_threads = 256;  ///< of a block

__device__ inline int own_index() {
    return static_cast<int>(blockIdx.x * blockDim.x + threadIdx.x);
}

/// Which States a kernel works on.
enum class Of { running, all };

template <Of states, class Real>
__device__ bool left_out(const Slots<Real>& slots) {
    return states == Of::running && slots.failed();
}

// The kernels of the whole grid are these four: what they do is a device function. The y of the grid is the State's
// number. Of 0 least blocks nothing is asked: of 1, the compiler would take as many registers as one block may have.

/// Calls work(model, slots, s, more...) for the slots s below `count`, by `lanes` threads each.
template <auto work, Of which, int lanes, int block, int min_blocks, class Real, class... More>
__global__ void __launch_bounds__(block, min_blocks)
    for_each_slot(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states, int count,
                  More... more) {
    const Slots<Real> slots = states.state(blockIdx.y);
    const int s = own_index() / lanes;
    if (s < count && !left_out<which>(slots)) work(model, slots, s, more...);
}

/// The same by a grid of any size, in States that have some density far above rest.
template <auto work, Of which, int lanes, int block, class Real>
__global__ void __launch_bounds__(block) for_each_crowded_slot(const __grid_constant__ ModelView<Real> model,
                                                               const __grid_constant__ Slots<Real> states, int count) {
    const Slots<Real> slots = states.state(blockIdx.y);
    if (left_out<which>(slots) || !slots.shared().high) return;
    const int step = static_cast<int>(gridDim.x * blockDim.x) / lanes;
    for (int s = own_index() / lanes; s < count; s += step) work(model, slots, s);
}

/// Arrays of a State's water, at which a block looks on its chip.
template <auto... arrays>
struct WaterOnChip {
    template <class Real>
    static std::size_t bytes(const Slots<Real>& slots, int count) {
        return (0 + ... + sizeof(*(slots.water.*arrays))) * count;
    }
    template <class Real>
    __device__ static void copy(Slots<Real>& slots, int count, char* chip) {
        const auto copy_one = [&](auto*& array) {
            auto* const own = reinterpret_cast<std::remove_reference_t<decltype(array)>>(chip);
            for (int k = static_cast<int>(threadIdx.x); k < count; k += static_cast<int>(blockDim.x)) own[k] = array[k];
            array = own;
            chip += count * sizeof(*own);
        };
        (copy_one(slots.water.*arrays), ...);
        __syncthreads();
    }
};

/// for_each_slot by a grid of any size, whose blocks have a State's arrays on their chip: work may not change them.
template <auto work, int lanes, int block, class Arrays, class Real, class... More>
__global__ void __launch_bounds__(block)
    for_each_slot_on_chip(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states,
                          int count, More... more) {
    extern __shared__ __align__(16) char chip_of_arrays[];
    Slots<Real> slots = states.state(blockIdx.y);
    if (left_out<Of::running>(slots)) return;
    Arrays::copy(slots, count, chip_of_arrays);
    const int step = static_cast<int>(gridDim.x * blockDim.x) / lanes;
    for (int s = own_index() / lanes; s < count; s += step) work(model, slots, s, more...);
}

/// Calls work(model, slots, more...) by every thread.
template <auto work, Of which, int block, int min_blocks, class Real, class... More>
__global__ void __launch_bounds__(block, min_blocks)
    for_each_state(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states,
                   More... more) {
    const Slots<Real> slots = states.state(blockIdx.y);
    if (!left_out<which>(slots)) work(model, slots, more...);
}

}  // namespace natator::cuda
