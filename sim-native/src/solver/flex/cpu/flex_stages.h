#pragma once

#include "solver/cpu/substep.h"

namespace natator::cpu {

/// The stages of scheme `flex`: NVIDIA Flex 1.2.0 as it was measured (tests/conformance/README.md). All corrections of
/// an iteration are computed from the same positions, summed, relaxed and applied at once.
template <class Real>
class FlexStages : public Substep<Real> {
public:
    static constexpr Scheme scheme = Scheme::flex;
    using Substep<Real>::Substep;

    template <class AfterStage>
    void find_neighbours(const AfterStage& after) {
        this->find_neighbours_of(*this, plan_, after);
    }
    void begin_iterations() {}
    void clear_corrections();
    void compute_density();
    void solve_density_constraint();
    void solve_cohesion();
    void solve_contacts();
    void solve_springs();
    void solve_clusters();
    void relax_and_apply();
    void solve_planes();
    void update_velocities();

    /// Density at the present positions by particle, in units of rest density; 0 for solids and infinite masses.
    std::vector<Real> densities() {
        if (plan_.fluid) compute_density();
        return this->densities_by_particle();
    }

    /// Behind an iteration.
    void measure_constraints(Residuals& residuals);

    /// Empty: the density constraint of scheme `flex` has no multiplier.
    std::vector<Real> pressures() const { return {}; }

private:
    void add_correction(int slot, const Vec3<Real>& correction) {
        ws_.correction.add(slot, correction);
        ws_.constraint_count[slot] += 1;
    }

    using Substep<Real>::model_;
    using Substep<Real>::plan_;
    using Substep<Real>::constants_;
    using Substep<Real>::ws_;
    using Substep<Real>::state_;
    using Substep<Real>::h_;
    using Substep<Real>::cluster_offset_;
    using Substep<Real>::cluster_rotation_;
    using Substep<Real>::cluster_centre_;
    using Substep<Real>::kernels_;
    using Substep<Real>::motion_kernels_;
    using Substep<Real>::fluid_view;
    using Substep<Real>::position_of_slot;
};

}  // namespace natator::cpu
