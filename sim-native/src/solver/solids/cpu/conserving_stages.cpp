#include "conserving_stages.h"

#include <algorithm>

#include "model/boundaries.h"

namespace natator::cpu {

template <class Real>
ConservingStages<Real>::ConservingStages(const Model& model, const Plan& plan)
    : Substep<Real>(model, plan),
      periodic_axes_(periodic_axes_of<Real>(model)),
      bodies_(free_bodies(model)),
      springs_per_particle_(model.particles(), 0),
      spring_lambda_(model.springs.size()) {
    if (plan_.water) water_.emplace(model);
    for (const Plane& plane : model.planes)
        planes_.push_back({vec3<Real>(plane.normal.template cast<Real>()), static_cast<Real>(plane.offset)});
    // Planes must hold whatever is pushed against them in the course of a substep, not just what starts close to them.
    constants_.plane_search_distance += constants_.radius;
    const std::size_t all = ws_.position.x.size();
    base_.resize(all);
    displacement_.resize(all);

    std::vector<bool> bonded(model.particles(), false);
    for (const Spring& spring : model.springs) {
        ++springs_per_particle_[spring.a];
        ++springs_per_particle_[spring.b];
        bonded[spring.a] = bonded[spring.b] = true;
    }
    for (const Cluster& cluster : model.clusters)
        for (const int i : cluster.particles) bonded[i] = true;
    for (int i = 0; i < model.particles(); ++i)
        if (bonded[i]) bonded_.push_back(i);
    internal_.assign(bonded_.empty() ? 0 : model.particles(), Vec3<Real>{});

    cluster_offset_.clear();
    for (SplitCluster<Real>& split : split_clusters<Real>(model)) {
        member_displacement_.emplace_back(split.mass.size());
        member_mass_.push_back(std::move(split.mass));
        cluster_offset_.emplace_back();
        for (const Vector3<Real>& offset : split.offset) cluster_offset_.back().push_back(vec3(offset));
    }
}

template <class Real>
void ConservingStages<Real>::begin_iterations() {
    base_ = ws_.position;
    overlap_push_ = static_cast<Real>(overlap_acceleration(model_.parameters)) * h_ * h_;
    for (auto* array : {&displacement_, &ws_.correction})
        for (auto* coordinate : {&array->x, &array->y, &array->z})
            std::fill(coordinate->begin(), coordinate->end(), Real(0));
    std::fill(internal_.begin(), internal_.end(), Vec3<Real>{});
    std::fill(spring_lambda_.begin(), spring_lambda_.end(), Real(0));
    for (auto& displacements : member_displacement_)
        std::fill(displacements.begin(), displacements.end(), Vec3<Real>{});
}

template <class Real>
void ConservingStages<Real>::apply_correction(int slot) {
    if (ws_.inverse_mass[slot] > 0) move(slot, constants_.relaxation_factor * ws_.correction.at(slot));
    ws_.correction.set(slot, {});
}

template <class Real>
void ConservingStages<Real>::apply_internal_corrections() {
    for (const int i : bonded_) {
        const int slot = ws_.slot_of[i];
        if (ws_.inverse_mass[slot] > 0) internal_[i] += constants_.relaxation_factor * ws_.correction.at(slot);
        apply_correction(slot);
    }
}

template <class Real>
std::vector<Real> ConservingStages<Real>::densities() const {
    std::vector<Real> densities(ws_.particles, Real(0));
    for (const int i : ws_.fluid_ids)
        if (inverse_mass_[i] > 0) densities[i] = water_->density(i);
    return densities;
}

template <class Real>
std::vector<Real> ConservingStages<Real>::pressures() const {
    std::vector<Real> pressures(ws_.particles, Real(0));
    for (const int i : ws_.fluid_ids) pressures[i] = water_->pressure(i);
    return pressures;
}

template <class Real>
std::vector<int> ConservingStages<Real>::neighbour_counts() const {
    if (!water_) return Substep<Real>::neighbour_counts();
    std::vector<int> counts(ws_.particles, 0);
    for (int i = 0; i < ws_.particles; ++i) counts[i] = water_->neighbours(i);
    return counts;
}

template class ConservingStages<float>;
template class ConservingStages<double>;

}  // namespace natator::cpu
