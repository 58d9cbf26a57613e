// Forces that the thesis leaves off, as in cpu/effects, between water and water. All act on the velocities that the
// divergence solve has left. Ghosts take part, so that walls pull neither along nor back: what a particle and its
// neighbour's ghost do to each other along a wall is equal and opposite to what the neighbour and its ghost do.
#include "physics/water_effects.h"

#include "water.h"

namespace natator::cpu {

/// Calls visit(other, difference, r) for the fluid within the interaction radius of a slot.
template <class Real>
template <class Visit>
void Water<Real>::for_each_fluid_within_radius(int slot, const Visit& visit) const {
    const Vec3<Real> x = position_.at(slot);
    for_each_neighbour_of(slot, [&](int, int other) {
        const Vec3<Real> difference = x - position_.at(other);
        const Real r = norm(difference);
        if (r > 0 && r < effect_radius_ && is_fluid_slot(other)) visit(other, difference, r);
    });
}

/// Calls work(slot) for the slots of the fluid, of its own particles.
template <class Real>
template <class Work>
void Water<Real>::for_fluid_slots(ThreadTeam& team, const Work& work) {
    team.for_parts(particles_, min_part * lanes, [&](int, int begin, int end) {
        for (int slot = begin; slot < end; ++slot)
            if (is_fluid_slot(slot)) work(slot);
    });
}

template <class Real>
void Water<Real>::add_cohesion(ThreadTeam& team) {
    constexpr Real thesis_substep = static_cast<Real>(physics::thesis_substep);
    const Real inverse_radius = 1 / effect_radius_;
    const Real slope = static_cast<Real>(physics::cohesion_slope(static_cast<double>(spacing_ * inverse_radius)));
    const Real strength = static_cast<Real>(model_.parameters.cohesion) * effect_radius_;
    const Real step = h_ / (thesis_substep * thesis_substep) * strength;
    for_fluid_slots(team, [&](int slot) {
        Vec3<Real> sum{};
        for_each_fluid_within_radius(slot, [&](int other, const Vec3<Real>& difference, Real r) {
            sum +=
                physics::cohesion_part(difference, r, inverse_radius, slope, inverse_mass_[slot], inverse_mass_[other]);
        });
        push(slot, -step * sum);
    });
}

template <class Real>
void Water<Real>::add_surface_tension(ThreadTeam& team) {
    const Real step = h_ * static_cast<Real>(model_.parameters.surface_tension);
    field_.resize(position_.x.size());
    for_fluid_slots(team, [&](int slot) {
        Vec3<Real> sum{};
        for_each_neighbour_of(slot, [&](int entry, int) { sum += gradient_.at(entry); });
        field_.set(slot, physics::colour_normal(sum, effect_radius_, volume_[slot]));
    });
    for (std::size_t k = 0; k < ghost_owner_.size(); ++k)
        field_.set(static_cast<int>(ghost_begin_ + k),
                   vec3<Real>((ghosts_.matrix(ghost_transform_[k]) * eigen(field_.at(ghost_owner_[k]))).eval()));
    for_fluid_slots(team, [&](int slot) {
        Vec3<Real> sum{};
        for_each_fluid_within_radius(slot, [&](int other, const Vec3<Real>&, Real) {
            sum += physics::tension_part(field_.at(slot), field_.at(other), inverse_mass_[slot], inverse_mass_[other]);
        });
        push(slot, -step * sum);
    });
}

template <class Real>
void Water<Real>::add_vorticity_confinement(ThreadTeam& team) {
    const Real step = h_ * static_cast<Real>(model_.parameters.vorticity_confinement);
    field_.resize(position_.x.size());
    strength_.assign(position_.x.size(), 0);
    for (int slot = 0; slot < particles_; ++slot) field_.set(slot, {});
    for_fluid_slots(team, [&](int slot) {
        const Vec3<Real> v = packed_velocity(slot);
        Vec3<Real> sum{};
        for_each_neighbour_of(slot, [&](int entry, int other) {
            sum += physics::vorticity_part(packed_velocity(other) - v, gradient_.at(entry));
        });
        field_.set(slot, 1 / volume_[slot] * sum);
        strength_[slot] = norm(field_.at(slot));
    });
    for (std::size_t k = 0; k < ghost_owner_.size(); ++k) strength_[ghost_begin_ + k] = strength_[ghost_owner_[k]];
    for_fluid_slots(team, [&](int slot) {
        Vec3<Real> towards_stronger{};
        for_each_neighbour_of(slot, [&](int entry, int other) {
            if (is_fluid_slot(other)) towards_stronger += (strength_[other] - strength_[slot]) * gradient_.at(entry);
        });
        push(slot, physics::confinement(towards_stronger, field_.at(slot), step));
    });
}

template <class Real>
void Water<Real>::drag_free_surface(ThreadTeam& team) {
    const Real step = h_ * static_cast<Real>(model_.parameters.free_surface_drag);
    for_fluid_slots(team,
                    [&](int slot) { velocity_.set(slot, physics::dragged(velocity_.at(slot), density_[slot], step)); });
}

template <class Real>
void Water<Real>::add_forces(ThreadTeam& team) {
    const SolverParameters& p = model_.parameters;
    if (p.free_surface_drag > 0) drag_free_surface(team);
    if (p.cohesion > 0) add_cohesion(team);
    if (p.surface_tension > 0) add_surface_tension(team);
    if (p.vorticity_confinement > 0) add_vorticity_confinement(team);
}

template void Water<float>::add_forces(ThreadTeam&);
template void Water<double>::add_forces(ThreadTeam&);

}  // namespace natator::cpu
