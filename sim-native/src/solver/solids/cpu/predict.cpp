#include "conserving_stages.h"
#include "physics/dfsph.h"
#include "physics/plane.h"

namespace natator::cpu {

template <class Real>
Vec3<Real> ConservingStages<Real>::before_planes(Vec3<Real> x, Real distance) const {
    for (const physics::PlaneSurface<Real>& plane : planes_) x = put_before(plane, distance, x);
    return x;
}

template <class Real>
Real ConservingStages<Real>::wall_distance(int particle) const {
    return model_.is_fluid(particle)
               ? static_cast<Real>(physics::min_wall_distance * model_.parameters.fluid_rest_distance)
               : constants_.collision_distance;
}

template <class Real>
void ConservingStages<Real>::wrap_fluid() {
    for (const physics::PeriodicAxis<Real>& periodic : periodic_axes_)
        for (const int i : ws_.fluid_ids)
            if (inverse_mass_[i] > 0) state_->position[i] = eigen(wrapped(periodic, vec3(state_->position[i])));
}

template <class Real>
void ConservingStages<Real>::put_before_planes() {
    if (planes_.empty()) return;
    for_each_particle([this](int i) {
        if (inverse_mass_[i] > 0)
            state_->position[i] = eigen(before_planes(vec3(state_->position[i]), wall_distance(i)));
    });
}

template <class Real>
void ConservingStages<Real>::find_water_neighbours() {
    wrap_fluid();
    put_before_planes();
    water_->find_neighbours(*state_, h_, *this->team_);
}

/// x* = x + h v* + shift; with water v* is the velocity that it has made of v, and gravity.
template <class Real>
void ConservingStages<Real>::predict() {
    if (!water_) {
        put_before_planes();
        return Substep<Real>::predict();
    }
    water_->add_gravity(*this->team_);
    for_each_particle([this](int i) {
        Vec3<Real> v = water_->velocity(i);
        if (plan_.clamp_speed) v = clamped(v, constants_.max_speed);
        ws_.unsorted_velocity[i] = eigen(v);
        ws_.unsorted_position[i] = eigen(vec3(state_->position[i]) + h_ * v + water_->shift(i));
    });
}

template void ConservingStages<float>::find_water_neighbours();
template void ConservingStages<double>::find_water_neighbours();
template void ConservingStages<float>::wrap_fluid();
template void ConservingStages<double>::wrap_fluid();
template void ConservingStages<float>::predict();
template void ConservingStages<double>::predict();
template Vec3<float> ConservingStages<float>::before_planes(Vec3<float>, float) const;
template Vec3<double> ConservingStages<double>::before_planes(Vec3<double>, double) const;
template float ConservingStages<float>::wall_distance(int) const;
template double ConservingStages<double>::wall_distance(int) const;

}  // namespace natator::cpu
