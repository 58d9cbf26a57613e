// What the water does to solids, summed only where someone asks. Pressure impulses need no sums of their own: pairs
// keep their gradients through a substep, so all of its passes together are one with the sums of their impulses, and
// the zeroth_order_correction that is given back once they are over.
#include "physics/dfsph.h"
#include "physics/water_force.h"
#include "water.h"

namespace natator::cpu {

/// Calls visit(slot, particle) if forces are kept.
template <class Real>
template <class Visit>
void Water<Real>::for_each_solid_slot(const Visit& visit) const {
    for (int i = 0; i < static_cast<int>(impulse_on_.size()); ++i)
        if (!model_.is_fluid(i)) visit(slot_of_[i], i);
}

template <class Real>
void Water<Real>::clear_forces() {
    impulse_on_.assign(impulse_on_.size(), {});
    impulse_time_ = 0;
}

/// Adds the viscous impulses on solids, of the same velocities as the kernel add_viscosity.
template <class Real>
void Water<Real>::add_viscous_forces(Real strength, Real limit) {
    const Real softening = view().softening;
    for_each_solid_slot([&](int slot, int particle) {
        const Real own = volume_[slot] * mobility_[slot];
        physics::ViscousSums<Real> sums;
        for_each_neighbour_of(slot, [&](int entry, int other) {
            if (!is_fluid_slot(other)) return;
            const Real share = physics::viscous_share(own, volume_[other] * mobility_[other], limit) *
                               physics::wall_viscosity_factor(Real(1), Real(0));
            sums.add(position_.at(slot) - position_.at(other), packed_velocity(other) - velocity_.at(slot), softening,
                     share, gradient_.at(entry));
        });
        impulse_on_[particle] += strength * sums.impulse;
    });
}

template <class Real>
void Water<Real>::add_pressure_forces() {
    const WaterView<Real> all = view();
    const physics::WendlandKernel<Real> kernel{all.inverse_radius, all.kernel_scale, all.slope_scale};
    for_each_solid_slot([&](int slot, int particle) {
        if (carried_.any())
            impulse_on_[particle] += h_ * carried_.lift(position_.at(slot), fluid_density_, volume_[slot]);
        const auto side = [&](int of) -> physics::PairSide<Real> {
            const Real* const zeroth_order_correction = &packed_zeroth_order_[4 * static_cast<std::size_t>(of)];
            return {volume_[of],
                    impulse_sum_[of < ghost_begin_ ? of : ghost_owner_[of - ghost_begin_]],
                    {zeroth_order_correction[0], zeroth_order_correction[1], zeroth_order_correction[2]}};
        };
        const physics::PairSide<Real> own = side(slot);
        for_each_neighbour_of(slot, [&](int entry, int other) {
            if (!is_fluid_slot(other)) return;
            const Real weight = kernel.value(length_of(position_.at(slot) - position_.at(other)));
            impulse_on_[particle] += pressure_impulse_between(own, side(other), gradient_.at(entry), weight);
        });
    });
    impulse_time_ += h_;
}

template <class Real>
std::vector<Vector3<Real>> Water<Real>::forces() const {
    std::vector<Vector3<Real>> forces;
    for (const Vec3<Real>& impulse : impulse_on_)
        forces.push_back(impulse_time_ > 0 ? (eigen(impulse) / impulse_time_).eval() : Vector3<Real>::Zero().eval());
    return forces;
}

template void Water<float>::clear_forces();
template void Water<double>::clear_forces();
template void Water<float>::add_viscous_forces(float, float);
template void Water<double>::add_viscous_forces(double, double);
template void Water<float>::add_pressure_forces();
template void Water<double>::add_pressure_forces();
template std::vector<Vector3<float>> Water<float>::forces() const;
template std::vector<Vector3<double>> Water<double>::forces() const;

}  // namespace natator::cpu
