#pragma once

// What the water does to solids, summed only where someone asks. See cpu/conserving/water_forces.cpp.
#include "physics/water_force.h"
#include "water_kernels.cuh"

namespace natator::cuda {

/// Adds an impulse to those on the solid in slot s.
template <class Real>
__device__ void add_impulse(const ModelView<Real>& model, const Slots<Real>& slots, int s, const Vec3<Real>& impulse) {
    Quad<Real>& sum = slots.water.impulse_on[number_in(slots.at.state_velocity[s].w) - model.fluid];
    sum = quad(xyz(sum) + impulse, Real(0));
}

/// As water_viscosity does, on the same velocities; of solid slot `model.fluid + k`.
template <class Real>
__device__ void add_viscous_forces(const ModelView<Real>& model, const Slots<Real>& slots, int k) {
    const int s = model.fluid + k;
    const WaterArrays<Real>& water = slots.water;
    const Quad<Real> here = water.position[s], moves = water.velocity[s];
    const Real strength = 10 * slots.h * model.water.dynamic_viscosity;
    const Real most = physics::viscous_limit(model.water.spacing, strength);
    physics::ViscousSums<Real> sums;
    for_each_water_pair(slots, s, [&](const Vec3<Real>& gradient, int other, unsigned borders) {
        if (other >= model.fluid) return;
        const Quad<Real> there = water.position[other];
        const Vec3<Real> difference = xyz(here) - ghost_of(model.water, xyz(there), borders);
        const Quad<Real> u = seen(model, water.velocity[other], borders);
        const Real share = physics::viscous_share(here.w * moves.w, there.w * u.w, most) *
                           physics::viscous_grip(Real(1), Real(0));
        sums.add(difference, xyz(u) - xyz(moves), model.water.softening, share, gradient);
    });
    const Vec3<Real> sum = sum_of_lanes(sums.impulse);
    if (own_lane() == 0) add_impulse(model, slots, s, strength * sum);
}

/// Of all passes of a substep together, and of the relief that was given back after them; of solid slot `model.fluid + k`.
template <class Real>
__device__ void add_pressure_forces(const ModelView<Real>& model, const Slots<Real>& slots, int k) {
    const int s = model.fluid + k;
    const WaterArrays<Real>& water = slots.water;
    const Quad<Real> here = water.position[s];
    const physics::PairSide<Real> own{here.w, water.impulse_sum[s], xyz(water.relief[s])};
    Vec3<Real> sum{};
    for_each_water_pair(slots, s, [&](const Vec3<Real>& gradient, int other, unsigned borders) {
        if (other >= model.fluid) return;
        const Quad<Real> there = water.position[other];
        const Vec3<Real> difference = xyz(here) - ghost_of(model.water, xyz(there), borders);
        const physics::PairSide<Real> its{there.w, water.impulse_sum[other],
                                          xyz(seen(model, water.relief[other], borders))};
        sum += pressure_impulse_between(own, its, gradient, model.water.kernel.value(physics::length_of(difference)));
    });
    sum = sum_of_lanes(sum);
    if (own_lane() == 0) add_impulse(model, slots, s, sum);
}

}  // namespace natator::cuda
