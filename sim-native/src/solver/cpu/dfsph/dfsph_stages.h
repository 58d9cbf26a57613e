#pragma once

#include "../conserving/conserving_stages.h"
#include "water.h"

namespace natator::cpu {

/// The stages of scheme `dfsph`: each iteration is a pass of the water's density solve, on velocities, and then one of the
/// solids' constraints as in scheme `conserving`, so that both see what the other has done.
template <class Real>
class DfsphStages : public ConservingStages<Real> {
public:
    static constexpr Scheme scheme = Scheme::dfsph;

    DfsphStages(const Model& model, const Plan& plan) : ConservingStages<Real>(model, plan), water_(model) {}

    void predict();
    template <class AfterStage>
    void find_neighbours(const AfterStage&) {
        if (this->plan_.contacts) this->find_contacts();
        if (this->plan_.planes) find_plane_contacts();
    }
    void find_plane_contacts();
    void solve_density_constraint();
    void update_velocities();

    /// At the last substep's start, by particle, in units of rest density; 0 for solids.
    std::vector<Real> densities() const;
    std::vector<Real> pressures() const;
    std::vector<int> neighbour_counts() const;

    /// See Solver::forces.
    void keep_forces() { water_.keep_forces(); }
    void clear_forces() { water_.clear_forces(); }
    std::vector<Vector3<Real>> forces() const { return water_.forces(); }

private:
    /// Of a particle as the iterations have left it, length/s.
    Vec3<Real> present_velocity(int particle) const {
        const int slot = this->ws_.slot_of[particle];
        return this->ws_.predicted.at(slot) + 1 / this->h_ * this->displacement_.at(slot);
    }
    /// What a particle keeps from planes, length.
    Real wall_distance(int particle) const;

    Water<Real> water_;
};

}  // namespace natator::cpu
