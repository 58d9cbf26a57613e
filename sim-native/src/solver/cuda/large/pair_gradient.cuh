#pragma once

#include <cstdint>

#include "solver/cuda/vec3.cuh"

namespace natator::cuda {

/// G_ij as the water's lists keep it: as it is, or packed where it is of floats.
template <class Real>
struct PairGradient {
    Quad<Real> kept;

    PairGradient() = default;
    __device__ explicit PairGradient(const Vec3<Real>& gradient) : kept(quad(gradient, Real(0))) {}
    __device__ Vec3<Real> value() const { return xyz(kept); }
};

/// Eight bytes for twelve, as every pass of the water waits for them: three integers of 19 bits, and the binary exponent of
/// the largest component in 7. Each is within 2^-18 of the largest component, and those of -G_ij are the opposite, which keeps
/// the momentum.
template <>
struct PairGradient<float> {
    uint2 kept;

    PairGradient() = default;
    __device__ explicit PairGradient(const Vec3<float>& gradient) {
        const float largest = fmaxf(fmaxf(fabsf(gradient.x), fabsf(gradient.y)), fabsf(gradient.z));
        const int exponent = min(max(static_cast<int>(__float_as_uint(largest) >> 23) - least_exponent, 0), 127);
        const float to_integer = 1 / unit(static_cast<unsigned>(exponent) << 25);
        const auto packed = [&](float component) {
            const int whole = min(max(__float2int_rn(component * to_integer), -most), most);
            return static_cast<std::uint64_t>(whole + offset);
        };
        const std::uint64_t bits = packed(gradient.x) | packed(gradient.y) << 19 | packed(gradient.z) << 38 |
                                   static_cast<std::uint64_t>(exponent) << 57;
        kept = {static_cast<unsigned>(bits), static_cast<unsigned>(bits >> 32)};
    }

    __device__ Vec3<float> value() const {
        const float one = unit(kept.y);
        return {component(kept.x, one), component(__funnelshift_r(kept.x, kept.y, 19), one), component(kept.y >> 6, one)};
    }

private:
    static constexpr int offset = 1 << 18, most = offset - 1;
    static constexpr int least_exponent = 40;  // of 2^-87

    /// What the integers count: 2^-17 of the power of two at or below the largest component. Of the upper word.
    __device__ static float unit(unsigned upper) {
        return __uint_as_float((upper >> 2 & 0x3f800000u) + (static_cast<unsigned>(least_exponent - 17) << 23));
    }
    /// The last 19 bits, less their offset, in units of `one`: 2^23 and more are floats without a fraction.
    __device__ static float component(unsigned bits, float one) {
        return (__uint_as_float((bits & 0x7ffffu) | 0x4b000000u) - static_cast<float>((1 << 23) + offset)) * one;
    }
};

/// A value that is read but once in a kernel: other data shall stay in the caches.
template <class T>
__device__ T read_once(const T* place) {
    return *place;
}
__device__ inline unsigned read_once(const unsigned* place) {
    return __ldcs(place);
}
__device__ inline PairGradient<float> read_once(const PairGradient<float>* place) {
    PairGradient<float> gradient;
    gradient.kept = __ldcs(&place->kept);
    return gradient;
}

}  // namespace natator::cuda
