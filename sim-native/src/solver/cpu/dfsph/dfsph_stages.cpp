#include "dfsph_stages.h"

#include "physics/plane.h"

namespace natator::cpu {

/// Nearer to a mirror than this, in rest distances, a particle and its image overlap, and the kernel no longer parts
/// them.
constexpr double least_wall_distance = 0.3;

/// x + h v + shift. Water does not touch planes otherwise: their mirror images hold it.
template <class Real>
void DfsphStages<Real>::predict() {
    auto& ws = this->ws_;
    const Real held = std::min(static_cast<Real>(least_wall_distance * this->model_.parameters.fluidRestDistance),
                               this->constants_.collision_distance);
    std::vector<physics::PlaneSurface<Real>> surfaces;
    for (const Plane& plane : this->model_.planes)
        surfaces.push_back({vec3<Real>(plane.normal.template cast<Real>()), static_cast<Real>(plane.offset)});

    for (int i = 0; i < ws.particles; ++i) {
        if (!(this->inverse_mass_[i] > 0)) continue;
        const Real distance = this->model_.is_fluid(i) ? held : this->constants_.collision_distance;
        for (const auto& surface : surfaces)
            this->state_->position[i] = eigen(put_before(surface, distance, vec3(this->state_->position[i])));
    }
    water_.solve(*this->state_, this->h_, *this->team_);
    for (int i = 0; i < ws.particles; ++i) {
        Vec3<Real> v = water_.velocity(i);
        if (this->plan_.clamp_speed) v = clamped(v, this->constants_.max_speed);
        Vec3<Real> x = vec3(this->state_->position[i]) + this->h_ * v + water_.shift(i);
        if (this->model_.is_fluid(i) && this->inverse_mass_[i] > 0) {
            for (const auto& surface : surfaces) {
                const Real deeper = held - (dot(surface.normal, x) + surface.offset);
                if (!(deeper > 0)) continue;
                x += deeper * surface.normal;
                v += std::max(-dot(surface.normal, v), Real(0)) * surface.normal;
            }
        }
        ws.predicted_velocity[i] = eigen(v);
        ws.predicted_position[i] = eigen(x);
    }
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
    std::vector<int> counts(this->ws_.particles, 0);
    for (int i = 0; i < this->ws_.particles; ++i) counts[i] = water_.neighbours(i);
    return counts;
}

template class DfsphStages<float>;
template class DfsphStages<double>;

}  // namespace natator::cpu
