#pragma once

// The solids on the chip of the block that has them, for all iterations of a substep.
#include <cuda_pipeline.h>

#include "solid_arrays.cuh"
#include "solver/cuda/layout.cuh"

namespace natator::cuda {

#define NATATOR_CHIP_SOLIDS(X) NATATOR_SOLID_MODEL_ARRAYS(X) NATATOR_SOLID_STATE_ARRAYS(X)

/// Offsets of the arrays in shared memory, bytes.
struct SolidLayout {
#define NATATOR_OFFSET(type, name, ...) unsigned name;
    NATATOR_CHIP_SOLIDS(NATATOR_OFFSET)
#undef NATATOR_OFFSET
    unsigned bytes;
};

template <class Real>
SolidLayout layout_of_solids(const ModelView<Real>& size) {
    SolidLayout layout{};
    Pieces pieces;
#define NATATOR_PLACE(type, name, count) layout.name = pieces.take<type>(count);
    NATATOR_CHIP_SOLIDS(NATATOR_PLACE)
#undef NATATOR_PLACE
    layout.bytes = pieces.used();
    return layout;
}

template <class Real>
class SolidsOnChip {
public:
    __device__ SolidsOnChip(const SolidLayout& layout, char* chip) : at_(layout), chip_(chip) {}

    __device__ static int place(int solid) { return solid; }
#define NATATOR_ACCESSOR(type, name, ...) \
    __device__ type* name() const { return reinterpret_cast<type*>(chip_ + at_.name); }
    NATATOR_CHIP_SOLIDS(NATATOR_ACCESSOR)
#undef NATATOR_ACCESSOR

private:
    const SolidLayout& at_;
    char* chip_;
};

/// Begins to copy one element to the chip.
template <class T>
__device__ void fetch(T* on_chip, const T* from) {
    constexpr std::size_t piece = alignof(T) < 16 ? alignof(T) : 16;  // bytes
    for (std::size_t b = 0; b < sizeof(T); b += piece)
        __pipeline_memcpy_async(reinterpret_cast<char*>(on_chip) + b, reinterpret_cast<const char*>(from) + b, piece);
}

/// Ends with a barrier.
template <class Real>
__device__ void load_on_chip(const ModelView<Real>& size, const SolidsInMemory<Real>& memory,
                             const SolidsOnChip<Real>& chip) {
#define NATATOR_LOAD(type, name, count) \
    for_each_in_block(count, [&](int k) { fetch(chip.name() + k, memory.name() + k); });
    NATATOR_SOLID_MODEL_ARRAYS(NATATOR_LOAD)
    NATATOR_CHANGED_SOLID_ARRAYS(NATATOR_LOAD)
    NATATOR_KEPT_SOLID_ARRAYS(NATATOR_LOAD)
#undef NATATOR_LOAD
    for_each_in_block(size.solids, [&](int solid) {
        const int slot = memory.place(solid);
#define NATATOR_LOAD(type, name, ...) fetch(chip.name() + solid, memory.name() + slot);
        NATATOR_MOVED_SOLID_ARRAYS(NATATOR_LOAD)
        NATATOR_PLACED_SOLID_ARRAYS(NATATOR_LOAD)
#undef NATATOR_LOAD
    });
    __pipeline_commit();
    __pipeline_wait_prior(0);
    __syncthreads();
}

/// Each thread its own solids, behind a barrier.
template <class Real>
__device__ void store_from_chip(const ModelView<Real>& size, const SolidsOnChip<Real>& chip,
                                const SolidsInMemory<Real>& memory) {
#define NATATOR_STORE(type, name, count) for_each_in_block(count, [&](int k) { memory.name()[k] = chip.name()[k]; });
    NATATOR_CHANGED_SOLID_ARRAYS(NATATOR_STORE)
#undef NATATOR_STORE
    for_each_in_block(size.solids, [&](int solid) {
        const int slot = memory.place(solid);
#define NATATOR_STORE(type, name, ...) memory.name()[slot] = chip.name()[solid];
        NATATOR_MOVED_SOLID_ARRAYS(NATATOR_STORE)
#undef NATATOR_STORE
    });
}

}  // namespace natator::cuda
