#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <new>
#include <vector>

#include "physics/vec3.h"

namespace natator::cpu {

/// Allocates on cache-line boundaries, so that a block of 16 lanes never straddles two more lines than it must.
template <class T>
struct CacheLineAllocator {
    using value_type = T;
    static constexpr std::align_val_t alignment{64};

    CacheLineAllocator() = default;
    template <class U>
    CacheLineAllocator(const CacheLineAllocator<U>&) {}

    T* allocate(std::size_t n) { return static_cast<T*>(::operator new(n * sizeof(T), alignment)); }
    void deallocate(T* p, std::size_t) { ::operator delete(p, alignment); }
    bool operator==(const CacheLineAllocator&) const { return true; }
};

template <class T>
using AlignedVector = std::vector<T, CacheLineAllocator<T>>;

using physics::Vec3;

template <class Real>
Vec3<Real> vec3(const Eigen::Matrix<Real, 3, 1>& v) {
    return {v.x(), v.y(), v.z()};
}
template <class Real>
Eigen::Matrix<Real, 3, 1> eigen(const Vec3<Real>& v) {
    return {v.x, v.y, v.z};
}

/// Three coordinates, one array each.
template <class Real>
struct Vector3Array {
    AlignedVector<Real> x, y, z;

    void resize(std::size_t n, Real value = 0) {
        x.resize(n, value);
        y.resize(n, value);
        z.resize(n, value);
    }
    std::array<Real*, 3> pointers() { return {x.data(), y.data(), z.data()}; }
    Vec3<Real> at(int i) const { return {x[i], y[i], z[i]}; }
    void set(int i, const Vec3<Real>& value) {
        x[i] = value.x;
        y[i] = value.y;
        z[i] = value.z;
    }
    void add(int i, const Vec3<Real>& value) { set(i, at(i) + value); }
};

}  // namespace natator::cpu
