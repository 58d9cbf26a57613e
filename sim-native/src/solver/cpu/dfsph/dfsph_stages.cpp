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
    const auto before_planes = [&](Vec3<Real> x, Real distance) {
        for (const Plane& plane : this->model_.planes) {
            const physics::PlaneSurface<Real> surface{vec3<Real>(plane.normal.template cast<Real>()),
                                                      static_cast<Real>(plane.offset)};
            x = put_before(surface, distance, x);
        }
        return x;
    };
    for (int i = 0; i < ws.particles; ++i)
        if (this->inverse_mass_[i] > 0)
            this->state_->position[i] =
                eigen(before_planes(vec3(this->state_->position[i]),
                                    this->model_.is_fluid(i) ? held : this->constants_.collision_distance));

    water_.solve(*this->state_, this->h_, *this->team_);
    for (int i = 0; i < ws.particles; ++i) {
        const Vec3<Real> start = vec3(this->state_->position[i]);
        Vec3<Real> v = water_.velocity(i);
        if (this->plan_.clamp_speed) v = clamped(v, this->constants_.max_speed);
        Vec3<Real> x = start + this->h_ * v + water_.shift(i);
        if (this->model_.is_fluid(i)) {
            const Vec3<Real> put = before_planes(x, held);
            v += 1 / this->h_ * (put - x);
            x = put;
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
