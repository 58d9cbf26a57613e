#include "dfsph_stages.h"

#include "physics/dfsph.h"

namespace natator::cpu {

/// Water does not touch planes otherwise: their mirror images hold it.
template <class Real>
Real DfsphStages<Real>::wall_distance(int particle) const {
    return this->model_.is_fluid(particle)
               ? static_cast<Real>(physics::least_wall_distance * this->model_.parameters.fluidRestDistance)
               : this->constants_.collision_distance;
}

/// x* = x + h v* + shift, v* without the density solve.
template <class Real>
void DfsphStages<Real>::predict() {
    if (!this->plan_.water) return ConservingStages<Real>::predict();
    auto& ws = this->ws_;
    for (int i = 0; i < ws.particles; ++i)
        if (this->inverse_mass_[i] > 0)
            this->state_->position[i] = eigen(this->before_planes(vec3(this->state_->position[i]), wall_distance(i)));
    water_.begin(*this->state_, this->h_, *this->team_);
    for (int i = 0; i < ws.particles; ++i) {
        Vec3<Real> v = water_.velocity(i);
        if (this->plan_.clamp_speed) v = clamped(v, this->constants_.max_speed);
        ws.predicted_velocity[i] = eigen(v);
        ws.predicted_position[i] = eigen(vec3(this->state_->position[i]) + this->h_ * v + water_.shift(i));
    }
}

/// Tells the water how the solids move by now, and the solids how it has pushed them.
template <class Real>
void DfsphStages<Real>::solve_density_constraint() {
    const auto& solids = this->ws_.solid_ids;
    for (const int i : solids) water_.set_velocity(i, present_velocity(i));
    if (!solids.empty()) water_.mirror_velocities();
    water_.push_apart(*this->team_);
    for (const int i : solids) {
        if (!(this->inverse_mass_[i] > 0)) continue;
        this->move(this->ws_.slot_of[i], this->h_ * (water_.velocity(i) - present_velocity(i)));
    }
}

/// The fluid goes where its velocities take it.
template <class Real>
void DfsphStages<Real>::update_velocities() {
    if (this->plan_.water) water_.add_pressure_forces();
    for (const int i : this->ws_.fluid_ids) {
        const int slot = this->ws_.slot_of[i];
        if (!(this->inverse_mass_[i] > 0)) continue;
        Vec3<Real> v = water_.velocity(i);
        if (this->plan_.clamp_speed) v = clamped(v, this->constants_.max_speed);
        this->displacement_.set(slot, this->h_ * (v - this->ws_.predicted.at(slot)));
        this->ws_.position.set(
            slot, this->before_planes(this->base_.at(slot) + this->displacement_.at(slot), wall_distance(i)));
    }
    ConservingStages<Real>::update_velocities();
}

template <class Real>
void DfsphStages<Real>::find_plane_contacts() {
    Substep<Real>::find_plane_contacts();
    const int first_solid = this->ws_.solid_begin / lanes;
    std::erase_if(this->ws_.plane_groups, [&](const auto& group) { return group.block < first_solid; });
}

template <class Real>
std::vector<Real> DfsphStages<Real>::densities() const {
    std::vector<Real> densities(this->ws_.particles, Real(0));
    for (const int i : this->ws_.fluid_ids)
        if (this->inverse_mass_[i] > 0) densities[i] = water_.density(i);
    return densities;
}

template <class Real>
std::vector<Real> DfsphStages<Real>::pressures() const {
    std::vector<Real> pressures(this->ws_.particles, Real(0));
    for (const int i : this->ws_.fluid_ids) pressures[i] = water_.pressure(i);
    return pressures;
}

template <class Real>
std::vector<int> DfsphStages<Real>::neighbour_counts() const {
    if (!this->plan_.water) return Substep<Real>::neighbour_counts();
    std::vector<int> counts(this->ws_.particles, 0);
    for (int i = 0; i < this->ws_.particles; ++i) counts[i] = water_.neighbours(i);
    return counts;
}

template class DfsphStages<float>;
template class DfsphStages<double>;

}  // namespace natator::cpu
