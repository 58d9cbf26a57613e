#include "conserving_stages.h"

#include <algorithm>

namespace natator::cpu {

template <class Real>
ConservingStages<Real>::ConservingStages(const Model& model, const Plan& plan)
    : Substep<Real>(model, plan),
      density_kernels_(&cpu::density_kernels<Real>(instruction_set())),
      own_(model.parameters),
      springs_per_particle_(model.particles(), 0),
      spring_lambda_(model.springs.size()) {
    // Planes must hold whatever is pushed against them in the course of a substep, not just what starts close to them.
    constants_.plane_search_distance += constants_.radius;
    const std::size_t all = ws_.position.x.size();
    base_.resize(all);
    displacement_.resize(all);
    for (std::vector<int>& particles : free_bodies(model)) bodies_.push_back({.particles = std::move(particles)});
    if (plan_.fluid) {
        this->most_neighbours_ = own_.most_neighbours;
        for (auto* array : {&lambda_, &response_, &lambda_sum_, &solid_gradient_square_, &overlap_, &overlap_lambda_})
            array->resize(all);
        solid_gradient_.resize(all);
    }

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
        cluster_displacement_.emplace_back(split.mass.size());
        cluster_mass_.push_back(std::move(split.mass));
        cluster_offset_.emplace_back();
        for (const Vector3<Real>& offset : split.offset) cluster_offset_.back().push_back(vec3(offset));
    }
}

template <class Real>
void ConservingStages<Real>::begin_iterations() {
    base_ = ws_.position;
    overlap_push_ = own_.overlap_acceleration * h_ * h_;
    looked_for_overlap_ = overlapping_ = false;
    for (auto* array : {&displacement_, &ws_.correction})
        for (auto* coordinate : {&array->x, &array->y, &array->z})
            std::fill(coordinate->begin(), coordinate->end(), Real(0));
    std::fill(lambda_sum_.begin(), lambda_sum_.end(), Real(0));
    std::fill(internal_.begin(), internal_.end(), Vec3<Real>{});
    std::fill(spring_lambda_.begin(), spring_lambda_.end(), Real(0));
    for (auto& displacements : cluster_displacement_)
        std::fill(displacements.begin(), displacements.end(), Vec3<Real>{});
}

template <class Real>
void ConservingStages<Real>::apply_correction(int slot, Real share) {
    if (ws_.inverse_mass[slot] > 0) move(slot, constants_.relaxation_factor * share * ws_.correction.at(slot));
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

template class ConservingStages<float>;
template class ConservingStages<double>;

}  // namespace natator::cpu
