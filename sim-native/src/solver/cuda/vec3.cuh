#pragma once

#include "physics/vec3.h"

namespace natator::cuda {

using physics::Vec3;

/// A position or velocity with a fourth value beside it, read and written by one instruction.
template <class Real>
struct alignas(4 * sizeof(Real)) Vec4 {
    Real x, y, z, w;
};

template <class Real>
__device__ Vec3<Real> xyz(const Vec4<Real>& q) {
    return {q.x, q.y, q.z};
}
template <class Real>
__device__ Vec4<Real> quad(const Vec3<Real>& v, Real w) {
    return {v.x, v.y, v.z, w};
}

}  // namespace natator::cuda
