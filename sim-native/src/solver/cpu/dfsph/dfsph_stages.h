#pragma once

#include "../conserving/conserving_stages.h"
#include "water.h"

namespace natator::cpu {

/// The stages of scheme `dfsph`: the water first, by pressure solves on velocities, then the solids' constraints as in
/// scheme `conserving`, from where the water has pushed them.
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

    /// At the last substep's start, by particle, in units of rest density; 0 for solids.
    std::vector<Real> densities() const;
    std::vector<Real> pressures() const;
    std::vector<int> neighbour_counts() const;

private:
    Water<Real> water_;
};

}  // namespace natator::cpu
