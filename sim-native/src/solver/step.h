#pragma once

#include "natator/plan.h"

namespace natator {

/// The groups of constraints that act on solids, in the order of both schemes.
template <class Stages, class AfterStage>
void solve_solids(Stages& stages, const Plan& plan, const AfterStage& after) {
    if (plan.contacts) {
        stages.solve_contacts();
        after("contacts");
    }
    if (plan.springs) {
        stages.solve_springs();
        after("springs");
    }
    if (plan.clusters) {
        stages.solve_clusters();
        after("shape matching");
    }
}

/// One constraint iteration of scheme `flex`: every correction is computed from the same positions and summed
/// (Jacobi), the sum is relaxed and applied, planes come last and one after the other.
template <class Stages, class AfterStage>
void iterate_summed(Stages& stages, const Plan& plan, const AfterStage& after) {
    stages.clear_corrections();
    if (plan.fluid) {
        stages.compute_density();
        after("density");
        stages.solve_density_constraint();
        after("density constraint");
    }
    if (plan.cohesion) {
        stages.solve_cohesion();
        after("cohesion");
    }
    solve_solids(stages, plan, after);
    stages.relax_and_apply();
    after("relaxation");
    if (plan.planes) {
        stages.solve_planes();
        after("planes");
    }
}

/// One iteration of scheme `conserving`: each group of constraints in turn, on the positions that the last one left.
template <class Stages, class AfterStage>
void iterate_in_turn(Stages& stages, const Plan& plan, const AfterStage& after) {
    if (plan.fluid) {
        stages.solve_density_constraint();
        after("density constraint");
    }
    solve_solids(stages, plan, after);
    if (plan.planes) {
        stages.solve_planes();
        after("planes");
    }
}

/// What acts on the velocities beyond the constraints, the same in both schemes; all of it is off in the thesis.
template <class Stages, class AfterStage>
void apply_effects(Stages& stages, const Plan& plan, const AfterStage& after) {
    if (plan.dissipation) {
        stages.damp_contacts();
        after("dissipation");
    }
    if (plan.free_surface_drag) {
        stages.drag_free_surface();
        after("free-surface drag");
    }
    if (plan.fluid_forces) {
        stages.apply_fluid_forces();
        after("fluid forces");
    }
    if (plan.adhesion) {
        stages.adhere();
        after("adhesion");
    }
    if (plan.restitution) {
        stages.rebound();
        after("restitution");
    }
    if (plan.sleep) {
        stages.hold_slow_particles();
        after("sleep");
    }
}

/// One substep: this is the order of stages for both schemes and every backend. `after(name)` is called behind each.
template <class Stages, class AfterStage>
void substep(Stages& stages, const Plan& plan, int iterations, const AfterStage& after) {
    stages.predict();
    after("predict");
    if (plan.fluid || plan.contacts) stages.sort_into_cells();
    stages.gather_slots();
    after("cells");
    if (plan.fluid) {
        stages.find_fluid_neighbours();
        after("fluid neighbours");
    }
    if (plan.contacts) stages.find_contacts();
    if (plan.planes) stages.find_plane_contacts();
    if constexpr (Stages::scheme == Scheme::conserving) stages.begin_iterations();
    after("neighbours");
    for (int i = 0; i < iterations; ++i) {
        if constexpr (Stages::scheme == Scheme::conserving)
            iterate_in_turn(stages, plan, after);
        else
            iterate_summed(stages, plan, after);
        after("iteration");
    }
    stages.update_velocities();
    after("velocities");
    apply_effects(stages, plan, after);
}

}  // namespace natator
