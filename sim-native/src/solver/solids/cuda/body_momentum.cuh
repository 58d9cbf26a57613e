#pragma once

// Scheme conserving: the velocities of a substep, but for the water's.
#include "physics/body_momentum.h"
#include "solver/cuda/grid/slots.cuh"

namespace natator::cuda {

__device__ inline void sum_over_warp(Vec3<double>& v) {
    v = {sum_of_warp(v.x), sum_of_warp(v.y), sum_of_warp(v.z)};
}

/// A warp per free body, the sums in double; one block. `scratch_position` holds velocities, before and after.
template <class Real>
__device__ void keep_body_momentum(const ModelView<Real>& model, const Slots<Real>& slots) {
    const int warp = threadIdx.x / 32, lane = threadIdx.x % 32;
    const auto at = [](const Vec4<Real>& x) { return physics::cast<double>(xyz(x)); };
    for (int k = warp; k < model.free_bodies; k += slots.size() / 32) {
        // Calls work(slot, solid, mass) for this lane's share of the body.
        const auto for_own = [&](const auto& work) {
#pragma unroll 4
            for (int e = model.free_body_begin[k] + lane; e < model.free_body_begin[k + 1]; e += 32) {
                const int solid = model.free_body_particle[e];
                work(slots.slot_of_solid()[solid], solid,
                     1 / static_cast<double>(model.inverse_mass[model.fluid + solid]));
            }
        };
        physics::BodyCentres centres;
        for_own([&](int s, int, double mass) { add(centres, mass, at(slots.start()[s]), at(slots.position()[s])); });
        centres.mass = sum_of_warp(centres.mass);
        sum_over_warp(centres.start);
        sum_over_warp(centres.now);
        const Vec3<double> start_centre = centres.start / centres.mass, centre = centres.now / centres.mass;
        physics::BodyMoments moments;
        for_own([&](int s, int solid, double mass) {
            const Vec3<double> impulse = mass / static_cast<double>(slots.h) * at(slots.internal()[solid]);
            add(moments, mass, impulse, at(slots.start()[s]) - start_centre, at(slots.position()[s]) - centre);
        });
        sum_over_warp(moments.momentum);
        sum_over_warp(moments.moment);
        physics::Symmetric3<double>& inertia = moments.inertia;
        for (double* const entry : {&inertia.xx, &inertia.yy, &inertia.zz, &inertia.xy, &inertia.xz, &inertia.yz})
            *entry = sum_of_warp(*entry);
        const physics::BodyMotion motion = motion_of(centres, moments);
        for_own([&](int s, int, double) {
            const Vec4<Real> v = slots.scratch_position()[s];
            const Vec3<Real> change = physics::cast<Real>(velocity_at(motion, at(slots.position()[s])));
            slots.scratch_position()[s] = quad(xyz(v) + change, v.w);
        });
    }
}

/// The velocity that the displacement of slot s means, with its inverse mass.
template <class Real>
__device__ Vec4<Real> constrained_velocity(const Slots<Real>& slots, int s) {
    const Vec4<Real> predicted = slots.predicted_velocity()[s];
    return quad(xyz(predicted) + (1 / slots.h) * xyz(slots.displacement()[s]), predicted.w);
}

/// The velocity that slot s leaves the substep with, where `scratch_position` holds what the constraints left.
template <class Real>
__device__ Vec3<Real> final_velocity(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const Real kept = model.plan.damping ? 1 / (1 + slots.h * model.damping) : Real(1);
    const Vec3<Real> v = kept * xyz(slots.scratch_position()[s]);
    return model.plan.clamp_speed ? clamped(v, model.max_speed) : v;
}

}  // namespace natator::cuda
