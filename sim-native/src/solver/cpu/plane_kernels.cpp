// Compiled once per instruction set, like fluid_kernels.cpp and by the same rules, but without fused products: every
// set gives the same bits. A Lane is one number, which is the definition and what double runs, or a vector of floats.
#include "plane_kernels.h"

#include "lanes.h"

namespace natator::cpu::NATATOR_ISA {
namespace {

constexpr int lanes = 16;

inline float square_root(float v) {
    return __builtin_sqrtf(v);
}
inline double square_root(double v) {
    return __builtin_sqrt(v);
}

/// One slot at a time.
template <class Real>
struct Single {
    using Lane = Real;
    static constexpr int slots = 1;
    static Lane get(const Real* from) { return *from; }
    static void put(Real* to, Lane value) { *to = value; }
    static Lane one_where(unsigned bits) { return static_cast<Real>(bits & 1u); }
};

/// A vector of slots at a time.
struct Vector {
    using Lane = Floats;
    static constexpr int slots = width;
    static Lane get(const float* from) { return load(from); }
    static void put(float* to, Lane value) { store(to, value); }
    static Lane one_where(unsigned bits) { return ones(bits); }
};

/// Calls work(first slot, 1 where chosen and else 0) for all slots of a block.
template <class Group, class Work>
inline void for_each_group(int block, unsigned chosen, const Work& work) {
    for (int slot = block * lanes; slot < (block + 1) * lanes; slot += Group::slots, chosen >>= Group::slots)
        work(slot, Group::one_where(chosen));
}

template <class Lane, class Other>
inline Lane dot(const Lane (&a)[3], const Other (&b)[3]) {
    return a[0] * b[0] + (a[1] * b[1] + a[2] * b[2]);  // in the order of Eigen's dot product of 3-vectors
}

template <class Real>
unsigned near_plane(const NearPlanes<Real>& slots, int block, const PlaneView<Real>& plane) {
    const Real* const x = slots.position[0] + block * lanes;
    const Real* const y = slots.position[1] + block * lanes;
    const Real* const z = slots.position[2] + block * lanes;
    unsigned near[lanes];
    for (int lane = 0; lane < lanes; ++lane) {
        const Real position[3] = {x[lane], y[lane], z[lane]};
        near[lane] = dot(position, plane.normal) + plane.offset <= plane.distance ? 1u << lane : 0;
    }
    unsigned all = 0;
    for (int lane = 0; lane < lanes; ++lane) all |= near[lane];
    return all;
}

/// Takes friction of a contact this deep off what a particle has moved in the substep.
template <class Lane, class Real>
inline void rub(Lane (&to)[3], const Lane (&moved)[3], Lane depth, const PlaneView<Real>& plane) {
    const Lane along = dot(moved, plane.normal);
    Lane tangential[3];
    for (int axis = 0; axis < 3; ++axis) tangential[axis] = moved[axis] - along * plane.normal[axis];
    const Lane m = square_root(dot(tangential, tangential));
    const Lane sliding = plane.dynamic_friction * depth;
    const Lane held = m < plane.static_friction * depth ? m : (m < sliding ? m : sliding);
    const Lane part = held / (m > 0 ? m : Lane{} + 1);
    for (int axis = 0; axis < 3; ++axis) to[axis] -= part * tangential[axis];
}

template <class Group, bool displaced, class Real>
void leave_plane(const NearPlanes<Real>& slots, int block, unsigned chosen, const PlaneView<Real>& plane) {
    using Lane = typename Group::Lane;
    Real* const* const moving = displaced ? slots.displacement : slots.position;
    for_each_group<Group>(block, chosen, [&](int slot, Lane one) {
        Lane from[3], to[3], base[3] = {}, position[3], moved[3];
        for (int axis = 0; axis < 3; ++axis) {
            from[axis] = Group::get(moving[axis] + slot);
            if (displaced) base[axis] = Group::get(slots.base[axis] + slot);
            position[axis] = displaced ? base[axis] + from[axis] : from[axis];
        }
        const Lane depth = one * (plane.distance - (dot(position, plane.normal) + plane.offset));
        for (int axis = 0; axis < 3; ++axis) {
            to[axis] = from[axis] + depth * plane.normal[axis];
            moved[axis] = (displaced ? base[axis] + to[axis] : to[axis]) - Group::get(slots.start[axis] + slot);
        }
        if (plane.friction) rub(to, moved, depth, plane);
        for (int axis = 0; axis < 3; ++axis) {
            const Lane now = depth > 0 ? to[axis] : from[axis];
            Group::put(moving[axis] + slot, now);
            if (displaced) Group::put(slots.position[axis] + slot, base[axis] + now);
        }
    });
}

template <class Group, class Real>
void leave(const NearPlanes<Real>& slots, int block, unsigned chosen, const PlaneView<Real>& plane) {
    if (slots.base[0])
        leave_plane<Group, true>(slots, block, chosen, plane);
    else
        leave_plane<Group, false>(slots, block, chosen, plane);
}

/// 1 - q of particles, between 0 and 1; 0 where not chosen.
template <class Group, class Real>
inline typename Group::Lane nearness(const PlanePressure<Real>& slots, int slot, typename Group::Lane one,
                                     const PlaneView<Real>& plane) {
    using Lane = typename Group::Lane;
    const Lane position[3] = {Group::get(slots.position[0] + slot), Group::get(slots.position[1] + slot),
                              Group::get(slots.position[2] + slot)};
    const Lane distance = dot(position, plane.normal) + plane.offset;
    const Lane t = one * (1 - (distance + slots.gap) * slots.inverse_radius);
    const Lane positive = t > 0 ? t : Lane{};
    return positive < 1 ? positive : Lane{} + 1;
}

/// Minus the derivative of a plane's part of the density by the distance, t = 1 - q.
template <class Lane, class Real>
inline Lane slope(Lane t, const PlanePressure<Real>& slots) {
    return slots.scale * slots.inverse_radius * t * t * t * t * (Real(1) / 4 - t / 5);
}

template <class Group, class Real>
void add_density(const PlanePressure<Real>& slots, int block, unsigned chosen, const PlaneView<Real>& plane) {
    using Lane = typename Group::Lane;
    for_each_group<Group>(block, chosen, [&](int slot, Lane one) {
        const Lane t = nearness<Group>(slots, slot, one, plane);
        const Lane density = slots.scale * t * t * t * t * t * (Real(1) / 20 - t / 30);
        Group::put(slots.density + slot, Group::get(slots.density + slot) + density);
        const Lane down = slope(t, slots);
        for (int axis = 0; axis < 3; ++axis) {
            Real* const gradient = slots.gradient[axis] + slot;
            Group::put(gradient, Group::get(gradient) - down * plane.normal[axis]);
        }
    });
}

template <class Group, class Real>
void press(const PlanePressure<Real>& slots, int block, unsigned chosen, const PlaneView<Real>& plane) {
    using Lane = typename Group::Lane;
    for_each_group<Group>(block, chosen, [&](int slot, Lane one) {
        const Lane down = slope(nearness<Group>(slots, slot, one, plane), slots);
        const Lane push = Group::get(slots.inverse_mass + slot) * Group::get(slots.lambda + slot) * down;
        for (int axis = 0; axis < 3; ++axis) {
            Real* const correction = slots.correction[axis] + slot;
            Group::put(correction, Group::get(correction) - push * plane.normal[axis]);
        }
    });
}

}  // namespace

template <class Real>
PlaneKernels<Real> scalar_plane_kernels() {
    return {&near_plane<Real>, &leave<Single<Real>, Real>, &add_density<Single<Real>, Real>,
            &press<Single<Real>, Real>};
}
template PlaneKernels<float> scalar_plane_kernels<float>();
template PlaneKernels<double> scalar_plane_kernels<double>();

template <>
PlaneKernels<double> plane_kernels<double>() {
    return scalar_plane_kernels<double>();
}

template <>
PlaneKernels<float> plane_kernels<float>() {
    return {&near_plane<float>, &leave<Vector, float>, &add_density<Vector, float>, &press<Vector, float>};
}

}  // namespace natator::cpu::NATATOR_ISA
