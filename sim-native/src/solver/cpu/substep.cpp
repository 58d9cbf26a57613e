#include "substep.h"

#include "physics/effects.h"
#include "rest_packing.h"

namespace natator::cpu {
template <class Real>
Constants<Real>::Constants(const SolverParameters& p)
    : radius(Real(p.radius)),
      inverse_radius(1 / radius),
      search_distance(Real(p.radius) + Real(p.particle_collision_margin)),
      solid_rest_distance(Real(p.solid_rest_distance)),
      density_scale(0),
      dynamic_friction(Real(p.dynamic_friction)),
      static_friction(Real(p.static_friction)),
      particle_friction(Real(p.particle_friction)),
      collision_distance(Real(p.collision_distance)),
      plane_search_distance(Real(p.collision_distance) + Real(p.shape_collision_margin)),
      relaxation_factor(Real(p.relaxation_factor)),
      max_speed(Real(p.max_speed)),
      cohesion_slope(static_cast<Real>(physics::cohesion_slope(p.fluid_rest_distance / p.radius))),
      gradient_estimate(0) {
    if (p.fluid_rest_distance > 0)
        gradient_estimate = static_cast<Real>(
            3 / rest_packing_sum(p.fluid_rest_distance / p.radius, [](double q) { return (1 - q) * q; }));
    const double rest_sum = p.fluid_rest_distance > 0 ? rest_packing_sum(p.fluid_rest_distance / p.radius,
                                                                         [](double q) { return (1 - q) * (1 - q); })
                                                      : 0;
    if (rest_sum > 0) density_scale = static_cast<Real>(1 / rest_sum);
}

template <class Real>
Substep<Real>::Substep(const Model& model, const Plan& plan)
    : model_(model),
      plan_(plan),
      constants_(model.parameters),
      ws_(model),
      max_neighbours_(model.parameters.flex.maxNeighborsPerParticle),
      kernels_(&fluid_kernels<Real>(instruction_set())),
      neighbour_kernels_(&neighbour_kernels<Real>(instruction_set())),
      motion_kernels_(&motion_kernels<Real>(instruction_set())),
      plane_kernels_(&plane_kernels<Real>(instruction_set())) {
    new_velocity_.resize(model.particles());
    if (plan_.dissipation || plan_.fluid_forces) velocity_change_.resize(model.particles());
    if (plan_.dissipation) overlaps_.resize(ws_.slots);
    if (plan_.surface_tension) normal_.resize(ws_.fluid);
    if (plan_.vorticity) curl_.resize(ws_.fluid);
    for (const double w : model.inverse_mass) inverse_mass_.push_back(static_cast<Real>(w));
    for (const Spring& spring : model.springs) spring_rules_.emplace_back(spring);
    for (const Cluster& cluster : model.clusters) {
        cluster_offset_.emplace_back();
        for (const auto& offset : cluster.rest_offset)
            cluster_offset_.back().push_back(vec3<Real>(offset.cast<Real>()));
    }
    up_ = vec3<Real>(-model.parameters.gravity.normalized().template cast<Real>());
}

template <class Real>
void Substep<Real>::gather_slots() {
    cluster_rotation_ = state_->cluster_rotation;
    cluster_centre_.clear();
    for (const Vector3<Real>& centre : state_->cluster_centre) cluster_centre_.push_back(vec3(centre));
    for_each_slot([this](int slot) {
        const int i = ws_.particle_of[slot];
        ws_.position.set(slot, vec3(ws_.unsorted_position[i]));
        ws_.start.set(slot, vec3(state_->position[i]));
        ws_.predicted_velocity.set(slot, vec3(ws_.unsorted_velocity[i]));
        ws_.inverse_mass[slot] = inverse_mass_[i];
    });
}

template <class Real>
MotionView<Real> Substep<Real>::motion_view() {
    return {.first_block = 0,
            .end_block = ws_.all_blocks(),
            .position = {ws_.position.x.data(), ws_.position.y.data(), ws_.position.z.data()},
            .start = {ws_.start.x.data(), ws_.start.y.data(), ws_.start.z.data()},
            .predicted_velocity = {ws_.predicted_velocity.x.data(), ws_.predicted_velocity.y.data(),
                                   ws_.predicted_velocity.z.data()},
            .correction = {ws_.correction.x.data(), ws_.correction.y.data(), ws_.correction.z.data()},
            .constraint_count = ws_.constraint_count.data(),
            .velocity = {ws_.velocity.x.data(), ws_.velocity.y.data(), ws_.velocity.z.data()}};
}

template <class Real>
NearPlanes<Real> Substep<Real>::near_planes() {
    return {.position = {ws_.position.x.data(), ws_.position.y.data(), ws_.position.z.data()},
            .start = {ws_.start.x.data(), ws_.start.y.data(), ws_.start.z.data()},
            .base = {},
            .displacement = {}};
}

template <class Real>
PlaneView<Real> Substep<Real>::plane_view(int plane) const {
    const Vector3<Real> normal = model_.planes[plane].normal.template cast<Real>();
    return {.normal = {normal.x(), normal.y(), normal.z()},
            .offset = static_cast<Real>(model_.planes[plane].offset),
            .distance = constants_.collision_distance,
            .friction = plan_.plane_friction,
            .static_friction = constants_.static_friction,
            .dynamic_friction = constants_.dynamic_friction};
}

/// Does particle i feel particle j? Pairs of different groups always; pairs of one group if i has self_collide, and
/// not if it has self_collide_filter and the two are closer than the radius at rest.
template <class Real>
bool Substep<Real>::collides(int i, int j) const {
    if ((model_.phase[i] & phase::group_mask) != (model_.phase[j] & phase::group_mask)) return true;
    if (!(model_.phase[i] & phase::self_collide)) return false;
    if (!(model_.phase[i] & phase::self_collide_filter) || model_.rest_position.empty()) return true;
    return (model_.rest_position[i] - model_.rest_position[j]).norm() >= model_.parameters.radius;
}

template <class Real>
std::vector<Vector3<Real>> Substep<Real>::positions() const {
    std::vector<Vector3<Real>> positions;
    for (const int slot : ws_.slot_of) positions.push_back(eigen(position_of_slot(slot)));
    return positions;
}

template <class Real>
std::vector<Real> Substep<Real>::densities_by_particle() const {
    std::vector<Real> densities(ws_.particles, Real(0));
    if (!plan_.fluid) return densities;
    for (const int i : ws_.fluid_ids)
        if (inverse_mass_[i] > 0) densities[i] = ws_.density[ws_.slot_of[i]];
    return densities;
}

template <class Real>
std::vector<int> Substep<Real>::neighbour_counts() const {
    std::vector<int> counts(ws_.particles, 0);
    for (const int i : ws_.fluid_ids) counts[i] = ws_.neighbour_count[ws_.slot_of[i]];
    for (std::size_t k = 0; k < ws_.contact_slots.size(); ++k)
        counts[ws_.particle_of[ws_.contact_slots[k]]] += ws_.contact_begin[k + 1] - ws_.contact_begin[k];
    return counts;
}

template struct Constants<float>;
template struct Constants<double>;
template class Substep<float>;
template class Substep<double>;

}  // namespace natator::cpu
