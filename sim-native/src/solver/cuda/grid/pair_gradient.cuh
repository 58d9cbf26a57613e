#pragma once

#include "solver/cuda/vec3.cuh"

namespace natator::cuda {

/// G_ij as the water's lists keep it: as it is, or packed where it is of floats.
template <class Real>
struct PairGradient {
    Vec4<Real> kept;

    /// A gradient as it is kept; it becomes what value() gives.
    __device__ static PairGradient keep(const Vec3<Real>& gradient) { return {quad(gradient, Real(0))}; }
    __device__ static PairGradient none() { return {}; }
    __device__ Vec3<Real> value() const { return xyz(kept); }
};

/// Eight bytes for twelve, as every pass of the water waits for them: three integers of 19 bits, and the binary
/// exponent of the largest component in 7. Each is within 2^-18 of the largest component, and those of -G_ij are the
/// opposite, which keeps the momentum.
template <>
struct PairGradient<float> {
    uint2 kept;

    /// A gradient as it is kept; it becomes what value() gives.
    __device__ static PairGradient keep(Vec3<float>& gradient) {
        const float largest = fmaxf(fmaxf(fabsf(gradient.x), fabsf(gradient.y)), fabsf(gradient.z));
        const int exponent = min(max(static_cast<int>(__float_as_uint(largest) >> 23) - min_exponent, 0), 127);
        const unsigned upper = static_cast<unsigned>(exponent) << 25;
        const float one = unit(upper), to_integer = __uint_as_float((254u << 23) - __float_as_uint(one));  // 1 / one
        const auto whole = [&](float component) {
            return fminf(fmaxf(__fmaf_rn(component, to_integer, zero), zero - max_integer), zero + max_integer);
        };
        const Vec3<float> integer{whole(gradient.x), whole(gradient.y), whole(gradient.z)};
        gradient = {(integer.x - zero) * one, (integer.y - zero) * one, (integer.z - zero) * one};
        const unsigned x = last_bits(integer.x), y = last_bits(integer.y), z = last_bits(integer.z);
        return {{x | y << 19, y >> 13 | z << 6 | upper}};
    }
    /// What keep gives for 0.
    __device__ static PairGradient none() {
        constexpr unsigned of_zero = 1 << 18;
        return {{of_zero | of_zero << 19, of_zero >> 13 | of_zero << 6}};
    }

    __device__ Vec3<float> value() const {
        const float one = unit(kept.y);
        return {component(kept.x, one), component(__funnelshift_r(kept.x, kept.y, 19), one),
                component(kept.y >> 6, one)};
    }

private:
    static constexpr int max_integer = (1 << 18) - 1;
    /// what stands for 0: floats of 2^23 and more have no fraction
    static constexpr float zero = (1 << 23) + (1 << 18);
    static constexpr int min_exponent = 40;  // of 2^-87

    /// What the integers count: 2^-17 of the power of two at or below the largest component. Of the upper word.
    __device__ static float unit(unsigned upper) {
        return __uint_as_float((upper >> 2 & 0x3f800000u) + (static_cast<unsigned>(min_exponent - 17) << 23));
    }
    __device__ static unsigned last_bits(float integer) { return __float_as_uint(integer) & 0x7ffffu; }
    /// The last 19 bits, in units of `one`.
    __device__ static float component(unsigned bits, float one) {
        return (__uint_as_float((bits & 0x7ffffu) | 0x4b000000u) - zero) * one;
    }
};

/// u G, in the order that a state's hash stands for; of numbers in double it is dot's.
template <class Real>
__device__ Real along(const Vec3<Real>& gradient, const Vec3<Real>& u) {
    return dot_unfused(u, gradient);
}
__device__ inline float along(const Vec3<float>& gradient, const Vec3<float>& u) {
    return __fmaf_rn(u.x, gradient.x, __fmaf_rn(u.z, gradient.z, u.y * gradient.y));
}

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
