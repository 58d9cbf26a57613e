#pragma once

// How the pairs of the water are kept in device memory. Sums over them wait for that memory and for little else, so a
// float's G_ij is kept in half precision: 10 bytes a pair with its entry instead of 16. Rounding is the same for G and -G, so
// forces stay equal and opposite; and divergence and pressure use the same numbers. A double's is kept as it is.
#include <cuda_fp16.h>

#include "solver/cuda/model_view.h"

namespace natator::cuda {

template <class Real>
struct KeptNumber;

template <>
struct KeptNumber<float> {
    using Type = __half;
    static constexpr float most = 65504;
    __device__ static __half kept(float value) { return __float2half_rn(fminf(fmaxf(value, -most), most)); }
    __device__ static float read(__half value) { return __half2float(value); }
};
template <>
struct KeptNumber<double> {
    using Type = double;
    __device__ static double kept(double value) { return value; }
    __device__ static double read(double value) { return value; }
};

template <class Real>
using Kept = typename KeptNumber<Real>::Type;

/// Numbers that lie side by side and are read in one go.
template <class T, int count>
struct alignas(count * sizeof(T)) Together {
    T value[count];
};

template <int count, class T>
__device__ Together<T, count> read_together(const T* from) {
    return *reinterpret_cast<const Together<T, count>*>(from);
}

}  // namespace natator::cuda
