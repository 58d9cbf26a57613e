#pragma once

// What the water does to solids, summed only where someone asks. See water/cpu/water_forces.cpp.
#include "physics/water_force.h"
#include "water_kernels.cuh"

namespace natator::cuda {

/// Adds an impulse to those on the solid in slot s.
template <class Real>
__device__ void add_impulse(const ModelView<Real>& model, const Slots<Real>& slots, int s, const Vec3<Real>& impulse) {
    Vec4<Real>& sum = slots.water.impulse_on[number_in(slots.arrays.state_velocity[s].w) - model.fluid];
    sum = quad(xyz(sum) + impulse, Real(0));
}

/// Adds the viscous impulse of the water alone on solid slot `model.fluid + k`, of the same velocities as
/// water_viscosity.
template <Pairs pairs, class Real>
__device__ void add_viscous_forces(const ModelView<Real>& model, const Slots<Real>& slots, int k) {
    const int s = model.fluid + k;
    const WaterArrays<Real>& water = slots.water;
    const Real strength = viscous_strength(model, slots);
    ViscousPairs<Real> sums(model, water, s, strength);
    for_each_water_pair<pairs>(
        model, slots, s, model.particles, [&](const Vec3<Real>& gradient, int other, unsigned boundaries) {
            if (other < model.fluid)
                sums.add(gradient, boundaries, water.position[other], water.velocity[other], water.shear[other]);
        });
    const Vec3<Real> sum = sums.impulse();
    if (own_lane() == 0) add_impulse(model, slots, s, strength * sum);
}

/// Adds the pressure impulse on solid slot `model.fluid + k` in all passes of a substep, with the
/// zeroth_order_correction that was given back after them.
template <Pairs pairs, class Real>
__device__ void add_pressure_forces(const ModelView<Real>& model, const Slots<Real>& slots, int k) {
    const int s = model.fluid + k;
    const WaterArrays<Real>& water = slots.water;
    const Vec4<Real> here = water.position[s];
    const physics::PairSide<Real> own{here.w, water.impulse_sum[s], xyz(water.zeroth_order_correction[s])};
    Vec3<Real> sum{};
    for_each_water_pair<pairs>(
        model, slots, s, model.particles, [&](const Vec3<Real>& gradient, int other, unsigned boundaries) {
            if (other >= model.fluid) return;
            const Vec4<Real> there = water.position[other];
            const Vec3<Real> difference = xyz(here) - ghost_position(model.water, xyz(there), boundaries);
            const physics::PairSide<Real> its{there.w, water.impulse_sum[other],
                                              xyz(reflected(model, water.zeroth_order_correction[other], boundaries))};
            sum +=
                pressure_impulse_between(own, its, gradient, model.water.kernel.value(physics::length_of(difference)));
        });
    sum = sum_of_lanes(sum);
    if (const auto& carried = model.water.carried; carried.any())
        sum += slots.h * carried.lift(xyz(here), model.water.density, here.w);
    if (own_lane() == 0) add_impulse(model, slots, s, sum);
}

}  // namespace natator::cuda
