// What the formulas of this folder are written over: T is float, double, or a vector of either (pack.h), each lane of
// which is a particle. The same text is compiled for the host, once per instruction set, and for the device.
#pragma once

#if !defined(NATATOR_ISA)
#include <cmath>
#endif

#if defined(__CUDACC__)
#define NATATOR_HD __host__ __device__ inline
#elif defined(NATATOR_ISA)
#define NATATOR_HD [[gnu::always_inline]] inline  // in its own set's instructions, and fused as its source says
#else
#define NATATOR_HD inline
#endif

// The namespace of all functions here: sources that are compiled once per instruction set share no code with the rest.
#if defined(NATATOR_ISA)
#define NATATOR_SET NATATOR_ISA
#else
#define NATATOR_SET host
#endif

namespace natator::physics::inline NATATOR_SET {

/// The number in each lane of T.
template <class T>
struct ScalarOf {
    using Type = T;
};
template <class T>
using Scalar = typename ScalarOf<T>::Type;

NATATOR_HD float square_root(float v) {
#if defined(__CUDA_ARCH__)
    return sqrtf(v);
#else
    return __builtin_sqrtf(v);
#endif
}
NATATOR_HD double square_root(double v) {
#if defined(__CUDA_ARCH__)
    return sqrt(v);
#else
    return __builtin_sqrt(v);
#endif
}

#if !defined(NATATOR_ISA)
NATATOR_HD float exponential(float v) {
    return expf(v);
}
NATATOR_HD double exponential(double v) {
    return exp(v);
}
NATATOR_HD float cube_root(float v) {
    return cbrtf(v);
}
NATATOR_HD double cube_root(double v) {
    return cbrt(v);
}
#endif

#if defined(__CUDACC__)
__device__ inline float inverse_root(float v) {
    return rsqrtf(v);
}
__device__ inline double inverse_root(double v) {
    return rsqrt(v);
}
#endif

/// v where it is positive, else 0; also for NaN.
NATATOR_HD float positive_part(float v) {
#if defined(__CUDA_ARCH__)
    return fmaxf(v, 0);
#else
    return v > 0 ? v : 0;
#endif
}
NATATOR_HD double positive_part(double v) {
#if defined(__CUDA_ARCH__)
    return fmax(v, 0.0);
#else
    return v > 0 ? v : 0;
#endif
}

/// a b + c, with one rounding where the instruction set has that.
NATATOR_HD float fused(float a, float b, float c) {
#if (defined(__FMA__) || defined(NATATOR_NEON)) && !defined(__CUDA_ARCH__)
    return __builtin_fmaf(a, b, c);
#else
    return a * b + c;
#endif
}
NATATOR_HD double fused(double a, double b, double c) {
#if (defined(__FMA__) || defined(NATATOR_NEON)) && !defined(__CUDA_ARCH__)
    return __builtin_fma(a, b, c);
#else
    return a * b + c;
#endif
}

}  // namespace natator::physics::inline NATATOR_SET

#if defined(NATATOR_ISA)
#include "physics/pack.h"
#endif

namespace natator::physics::inline NATATOR_SET {

/// v^2 where v is positive, else 0; on a CPU rounded here, and not fused with what it is added to.
template <class T>
NATATOR_HD T positive_square(T v) {
#if defined(__CUDA_ARCH__)
    const T t = positive_part(v);
    return t * t;
#else
    return v > 0 ? v * v : T{};
#endif
}
/// Adds positive_square(v); on a GPU with one rounding, wherever the compiler would have computed the product.
template <class T>
NATATOR_HD void add_positive_square(T& sum, T v) {
#if defined(__CUDA_ARCH__)
    const T t = positive_part(v);
    sum = fma(t, t, sum);
#else
    sum += positive_square(v);
#endif
}
/// counter + 1 where v is positive.
template <class T>
NATATOR_HD T count_positive(T counter, T v) {
    return counter + (v > 0 ? T(1) : T(0));
}

/// 1 in every lane.
template <class T>
NATATOR_HD T one() {
    return T{} + 1;
}
template <class T>
NATATOR_HD T minimum(T a, T b) {
    return b < a ? b : a;
}

}  // namespace natator::physics::inline NATATOR_SET
