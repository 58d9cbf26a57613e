#include "conserving_stages.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "../rest_packing.h"

namespace natator::cpu {

double relative_compliance(double stiffness, double h) {
    constexpr double thesis_substep = 1.0 / 240;
    const double left_over = std::pow(1 - stiffness, 4);
    if (left_over >= 1) return std::numeric_limits<double>::infinity();
    return left_over / (1 - left_over) * (thesis_substep / h) * (thesis_substep / h);
}

template <class Real>
std::vector<typename ConservingStages<Real>::FreeBody> ConservingStages<Real>::free_bodies(const Model& model) {
    std::vector<int> parent(model.particles());
    std::iota(parent.begin(), parent.end(), 0);
    const auto root = [&parent](int i) {
        while (parent[i] != i) i = parent[i] = parent[parent[i]];
        return i;
    };
    for (const Spring& spring : model.springs) parent[root(spring.a)] = root(spring.b);
    for (const Cluster& cluster : model.clusters)
        for (const int i : cluster.particles) parent[root(i)] = root(cluster.particles.front());

    std::vector<std::vector<int>> members(model.particles());
    std::vector<bool> held(model.particles(), false);
    for (int i = 0; i < model.particles(); ++i) {
        members[root(i)].push_back(i);
        if (model.inverse_mass[i] == 0) held[root(i)] = true;
    }
    std::vector<FreeBody> bodies;
    for (int i = 0; i < model.particles(); ++i)
        if (members[i].size() > 1 && !held[i]) bodies.push_back({.particles = members[i]});
    return bodies;
}

template <class Real>
ConservingStages<Real>::ConservingStages(const Model& model, const Plan& plan)
    : Substep<Real>(model, plan),
      density_kernels_(&cpu::density_kernels<Real>(instruction_set())),
      kernel_scale_(0),
      gradient_scale_(0),
      bodies_(free_bodies(model)),
      springs_per_particle_(model.particles(), 0),
      spring_lambda_(model.springs.size()) {
    // Planes must hold whatever is pushed against them in the course of a substep, not just what starts close to them.
    constants_.plane_search_distance += constants_.radius;
    const std::size_t all = ws_.position.x.size();
    base_.resize(all);
    displacement_.resize(all);
    if (plan_.fluid) {
        const SolverParameters& p = model.parameters;
        const double neighbours =
            close_packing_sum(p.fluidRestDistance / p.radius, [](double q) { return std::pow(1 - q, 3); });
        const double close_neighbours = close_packing_sum(p.fluidRestDistance / p.radius, [](double) { return 1; });
        this->most_neighbours_ = std::max(p.maxNeighborsPerParticle, 4 * static_cast<int>(close_neighbours));
        rest_sum_ = static_cast<Real>(neighbours);
        kernel_scale_ = static_cast<Real>(1 / (1 + neighbours));
        gradient_scale_ = static_cast<Real>(3 / (p.radius * (1 + neighbours)));
        const double per_radius_cubed = std::pow(p.radius / p.fluidRestDistance, 3) * std::numbers::sqrt2;
        plane_scale_ = static_cast<Real>(2 * std::numbers::pi * per_radius_cubed / (1 + neighbours));
        plane_gap_ = static_cast<Real>(p.fluidRestDistance / 2 - p.collisionDistance);
        for (auto* array : {&lambda_, &response_, &lambda_sum_, &solid_gradient_square_, &overlap_, &overlap_lambda_})
            array->resize(all);
        solid_gradient_.resize(all);
    }

    std::vector<int> clusters_per_particle(model.particles(), 0);
    for (const Spring& spring : model.springs) {
        ++springs_per_particle_[spring.a];
        ++springs_per_particle_[spring.b];
    }
    for (const Cluster& cluster : model.clusters)
        for (const int i : cluster.particles) ++clusters_per_particle[i];
    for (int i = 0; i < model.particles(); ++i)
        if (springs_per_particle_[i] + clusters_per_particle[i] > 0) bonded_.push_back(i);
    internal_.assign(bonded_.empty() ? 0 : model.particles(), Vector3<Real>::Zero());

    for (std::size_t k = 0; k < model.clusters.size(); ++k) {
        const std::vector<int>& members = model.clusters[k].particles;
        cluster_mass_.emplace_back();
        Vector3<double> mean = Vector3<double>::Zero();
        double total = 0;
        for (std::size_t m = 0; m < members.size(); ++m) {
            const double w = model.inverse_mass[members[m]];
            const double mass = (w > 0 ? 1 / w : 1.0) / clusters_per_particle[members[m]];
            cluster_mass_[k].push_back(static_cast<Real>(mass));
            mean += mass * model.clusters[k].rest_offset[m];
            total += mass;
        }
        for (auto& offset : cluster_offset_[k]) offset -= (mean / total).template cast<Real>();
        cluster_displacement_.emplace_back(members.size());
    }
}

/// At which overlaps are pushed apart: maxAcceleration, but enough to win against gravity. Unlimited only nominally, so
/// that it can be multiplied.
template <class Real>
Real ConservingStages<Real>::overlap_acceleration(const SolverParameters& p) {
    return static_cast<Real>(std::min(std::max(p.maxAcceleration, 10 * p.gravity.norm()), 1e30));
}

template <class Real>
void ConservingStages<Real>::begin_iterations() {
    base_ = ws_.position;
    overlap_push_ = overlap_acceleration(model_.parameters) * h_ * h_;
    looked_for_overlap_ = overlapping_ = false;
    for (auto* array : {&displacement_, &ws_.correction})
        for (auto* coordinate : {&array->x, &array->y, &array->z})
            std::fill(coordinate->begin(), coordinate->end(), Real(0));
    std::fill(lambda_sum_.begin(), lambda_sum_.end(), Real(0));
    std::fill(internal_.begin(), internal_.end(), Vector3<Real>::Zero());
    std::fill(spring_lambda_.begin(), spring_lambda_.end(), Real(0));
    for (auto& displacements : cluster_displacement_)
        std::fill(displacements.begin(), displacements.end(), Vector3<Real>::Zero());
}

template <class Real>
void ConservingStages<Real>::apply_correction(int slot, Real share) {
    if (ws_.inverse_mass[slot] > 0) move(slot, constants_.relaxation_factor * share * ws_.correction.at(slot));
    ws_.correction.set(slot, Vector3<Real>::Zero());
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
