#pragma once

namespace natator::cuda {

template <class Real>
struct Vec3 {
    Real x, y, z;
};

/// A position or velocity with a fourth value beside it, read and written by one instruction.
template <class Real>
struct alignas(4 * sizeof(Real)) Quad {
    Real x, y, z, w;
};

template <class Real>
__device__ Vec3<Real> xyz(const Quad<Real>& q) {
    return {q.x, q.y, q.z};
}
template <class Real>
__device__ Quad<Real> quad(const Vec3<Real>& v, Real w) {
    return {v.x, v.y, v.z, w};
}
template <class Real>
__device__ Vec3<Real> operator+(const Vec3<Real>& a, const Vec3<Real>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class Real>
__device__ Vec3<Real> operator-(const Vec3<Real>& a, const Vec3<Real>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Real>
__device__ Vec3<Real> operator*(Real s, const Vec3<Real>& v) {
    return {s * v.x, s * v.y, s * v.z};
}
template <class Real>
__device__ Real dot(const Vec3<Real>& a, const Vec3<Real>& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Real>
__device__ Vec3<Real> cross(const Vec3<Real>& a, const Vec3<Real>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class Real>
__device__ Real norm(const Vec3<Real>& v) {
    return sqrt(dot(v, v));
}

/// The vector, shortened to `longest` if it is longer.
template <class Real>
__device__ Vec3<Real> clamped(const Vec3<Real>& v, Real longest) {
    const Real length = norm(v);
    return length > longest ? (longest / length) * v : v;
}

}  // namespace natator::cuda
