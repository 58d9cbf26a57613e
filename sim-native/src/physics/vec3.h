#pragma once

#include "number.h"

namespace natator::physics {

template <class T>
struct Vec3 {
    T x{}, y{}, z{};
};

inline namespace NATATOR_SET {

template <class T>
NATATOR_HD Vec3<T> operator+(const Vec3<T>& a, const Vec3<T>& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
NATATOR_HD Vec3<T> operator-(const Vec3<T>& a, const Vec3<T>& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
/// v times a number or, lane by lane, times a vector of numbers; a plane's normal is the same in all lanes.
template <class S, class T>
NATATOR_HD auto operator*(S s, const Vec3<T>& v) {
    return Vec3<decltype(s * v.x)>{s * v.x, s * v.y, s * v.z};
}
template <class T>
NATATOR_HD Vec3<T> operator/(const Vec3<T>& v, T divisor) {
#if defined(__CUDA_ARCH__)
    return (1 / divisor) * v;  // divisions are dear there
#else
    return {v.x / divisor, v.y / divisor, v.z / divisor};
#endif
}
template <class T>
NATATOR_HD Vec3<T>& operator+=(Vec3<T>& a, const Vec3<T>& b) {
    return a = a + b;
}
template <class T>
NATATOR_HD Vec3<T>& operator-=(Vec3<T>& a, const Vec3<T>& b) {
    return a = a - b;
}

/// Adds s v; on a GPU with one rounding, wherever the compiler would have computed the product.
template <class S, class T>
NATATOR_HD void add_product(Vec3<T>& sum, S s, const Vec3<T>& v) {
#if defined(__CUDA_ARCH__)
    sum = {fma(s, v.x, sum.x), fma(s, v.y, sum.y), fma(s, v.z, sum.z)};
#else
    sum += s * v;
#endif
}

/// The order of the sum is part of what a state's hash stands for; of numbers in double it is another one, for the same
/// reason.
template <class T, class U>
NATATOR_HD T dot(const Vec3<T>& a, const Vec3<U>& b) {
    return a.x * b.x + (a.y * b.y + a.z * b.z);
}
NATATOR_HD double dot(const Vec3<double>& a, const Vec3<double>& b) {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
/// The dot product with fixed rounding: on a GPU the same bits in every kernel, where the compiler may else fuse either
/// product.
template <class T, class U>
NATATOR_HD T dot_unfused(const Vec3<T>& a, const Vec3<U>& b) {
#if defined(__CUDA_ARCH__)
    if constexpr (sizeof(T) == sizeof(double)) return fma(a.z, b.z, fma(a.x, b.x, a.y * b.y));
    return fma(a.x, b.x, fma(a.y, b.y, a.z * b.z));
#else
    return dot(a, b);
#endif
}
template <class T>
NATATOR_HD Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class T>
NATATOR_HD T norm(const Vec3<T>& v) {
    return square_root(dot(v, v));
}
/// The vector, shortened to `max_length` where it is longer.
template <class T, class R>
NATATOR_HD Vec3<T> clamped(const Vec3<T>& v, R max_length) {
    const T length = norm(v);
    const T scale = length > max_length ? max_length / length : one<T>();
    return scale * v;
}
/// a where `chosen`, else b.
template <class Chosen, class T>
NATATOR_HD Vec3<T> select(Chosen chosen, const Vec3<T>& a, const Vec3<T>& b) {
    return {chosen ? a.x : b.x, chosen ? a.y : b.y, chosen ? a.z : b.z};
}
template <class S, class T>
NATATOR_HD Vec3<S> cast(const Vec3<T>& v) {
    return {static_cast<S>(v.x), static_cast<S>(v.y), static_cast<S>(v.z)};
}

}  // namespace NATATOR_SET
}  // namespace natator::physics
