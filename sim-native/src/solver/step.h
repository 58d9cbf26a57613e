#pragma once

#include "natator/solver.h"
#include "physics/dfsph.h"
#include "stage.h"

// One substep: the order of stages for all schemes and every backend. `Stages` is what a backend does in each of them:
// on the host cpu/substep.h with flex/cpu/ or solids/cpu/, flex/cuda/update.cuh by a team of threads, cuda/grid/ by
// kernels that the host launches. after(stage) is called behind each. In scheme `lattice` these are the stages of its
// solids; its water pushes them before (lattice::Coupling::push, on a GPU cuda::LatticeBodies) and steps after them
// (Coupling::follow).
#if defined(__CUDACC__)
#define NATATOR_ANY_SIDE _Pragma("nv_exec_check_disable")  // a step is of the side that its stages are of
#define NATATOR_STEP __host__ __device__
#else
#define NATATOR_ANY_SIDE
#define NATATOR_STEP
#endif

namespace natator {

/// How often a substep iterates over its constraints.
struct Iterations {
    int all;            ///< iterations of a substep; at least as many where it goes on until it has converged
    int of_solids = 1;  ///< times that solids are solved in each of them, except in scheme `flex`
    int max = 0;        ///< of Stages that go on until they have converged; 0: these go no further than `all`
};

/// How a backend goes through the constraints of an iteration.
enum class Grouping {
    separate,  ///< each group by itself
    /// scheme `flex`: first all that depends on positions alone, then all corrections; `conserving`: all solids
    fused,
};

/// The groups of constraints that act on solids, in the order of all schemes.
NATATOR_ANY_SIDE
template <class Stages, class AfterStage>
NATATOR_STEP void solve_solids(Stages& stages, const Plan& plan, const AfterStage& after) {
    if (plan.contacts) {
        stages.solve_contacts();
        after(Stage::contacts);
    }
    if (plan.springs) {
        stages.solve_springs();
        after(Stage::springs);
    }
    if (plan.clusters) {
        stages.solve_clusters();
        after(Stage::shape_matching);
    }
}

/// One constraint iteration of scheme `flex`: every correction is computed from the same positions and summed
/// (Jacobi), the sum is relaxed and applied, planes come last and one after the other.
NATATOR_ANY_SIDE
template <class Stages, class AfterStage>
NATATOR_STEP void iterate_flex(Stages& stages, const Plan& plan, const AfterStage& after) {
    if constexpr (Stages::grouping == Grouping::fused) {
        stages.compute_density_and_fits();
        after(Stage::density_and_fits);
        stages.apply_corrections();
        after(Stage::corrections);
    } else {
        stages.clear_corrections();
        if (plan.fluid) {
            stages.compute_density();
            after(Stage::density);
            stages.solve_density_constraint();
            after(Stage::density_constraint);
        }
        if (plan.cohesion) {
            stages.solve_cohesion();
            after(Stage::cohesion);
        }
        solve_solids(stages, plan, after);
        stages.relax_and_apply();
        after(Stage::relaxation);
        if (plan.planes) {
            stages.solve_planes();
            after(Stage::planes);
        }
    }
}

/// One iteration of scheme `conserving`: each group of constraints in turn, on the positions that the
/// last one left; those of the solids `solid_iterations` times. Backends that solve all solids at once
/// (Grouping::fused) read that number from the model.
NATATOR_ANY_SIDE
template <class Stages, class AfterStage>
NATATOR_STEP void iterate_conserving(Stages& stages, const Plan& plan, int solid_iterations, const AfterStage& after) {
    if (plan.water) {
        stages.compute_density_impulses();
        stages.apply_density_impulses();
        after(Stage::density_constraint);
    }
    if constexpr (Stages::grouping == Grouping::fused) {
        stages.solve_solids_together();
        after(Stage::solids);
    } else {
        for (int k = 0; k < solid_iterations; ++k) {
            solve_solids(stages, plan, after);
            if (plan.planes) {
                stages.solve_planes();
                after(Stage::planes);
            }
        }
    }
}

/// Scheme `conserving`, before anything moves: what the water does to the velocities that are there.
NATATOR_ANY_SIDE
template <class Stages, class AfterStage>
NATATOR_STEP void begin_water(Stages& stages, const Plan& plan, const AfterStage& after) {
    stages.find_water_neighbours();
    after(Stage::fluid_neighbours);
    stages.compute_water_gradients();
    after(Stage::density);
    if (stages.begin_overlap_separation()) {
        for (int pass = 0; pass < physics::separation_passes; ++pass) stages.separate_overlaps(pass);
        stages.end_overlap_separation();
    }
    after(Stage::overlaps);
    stages.solve_divergence();
    after(Stage::divergence);
    if (plan.viscosity) {
        stages.add_viscosity();
        after(Stage::viscosity);
    }
    if (plan.fluid_forces) {
        stages.add_fluid_forces();
        after(Stage::fluid_forces);
    }
}

/// Scheme `conserving`, once all passes are done: what the walls and the neighbours still do to the water, and where it
/// goes.
NATATOR_ANY_SIDE
template <class Stages, class AfterStage>
NATATOR_STEP void end_water(Stages& stages, const AfterStage& after) {
    if constexpr (Stages::grouping == Grouping::fused) {
        stages.end_water_passes();
    } else {
        stages.return_zeroth_order_correction();
        stages.apply_wall_pressure();
    }
    after(Stage::walls);
    stages.add_pressure_forces();
    stages.move_water();
    after(Stage::water_motion);
}

/// What acts on the velocities beyond the constraints, the same in all schemes; all of it is off in the thesis. Only
/// Stages with `effects` are called: a kernel without their code has registers to spare for the rest.
NATATOR_ANY_SIDE
template <class Stages, class AfterStage>
NATATOR_STEP void apply_effects(Stages& stages, const Plan& plan, const AfterStage& after) {
    if (plan.dissipation) {
        stages.damp_contacts();
        after(Stage::dissipation);
    }
    if constexpr (Stages::scheme == Scheme::flex) {
        if (plan.free_surface_drag) {
            stages.drag_free_surface();
            after(Stage::free_surface_drag);
        }
        if (plan.fluid_forces) {
            stages.apply_fluid_forces();
            after(Stage::fluid_forces);
        }
    }
    if (plan.adhesion) {
        stages.apply_adhesion();
        after(Stage::adhesion);
    }
    if (plan.restitution) {
        stages.apply_restitution();
        after(Stage::restitution);
    }
    if (plan.sleep) {
        stages.apply_sleep();
        after(Stage::sleep);
    }
}

NATATOR_ANY_SIDE
template <class Stages, class AfterStage>
NATATOR_STEP void substep(Stages& stages, const Plan& plan, Iterations iterations, const AfterStage& after) {
    if constexpr (Stages::scheme != Scheme::flex)
        if (plan.water) begin_water(stages, plan, after);
    stages.predict();
    after(Stage::predict);
    stages.sort_into_cells();
    after(Stage::cells);
    stages.find_neighbours(after);
    stages.begin_iterations();
    after(Stage::neighbours);
    for (int i = 0; i < iterations.all || i < iterations.max; ++i) {
        if constexpr (requires { stages.has_converged(); })
            if (i >= iterations.all && stages.has_converged()) break;
        if constexpr (Stages::scheme != Scheme::flex)
            iterate_conserving(stages, plan, iterations.of_solids, after);
        else
            iterate_flex(stages, plan, after);
        after(Stage::iteration);
    }
    if constexpr (Stages::scheme != Scheme::flex)
        if (plan.water) end_water(stages, after);
    stages.update_velocities();
    after(Stage::velocities);
    if constexpr (Stages::effects) apply_effects(stages, plan, after);
}

}  // namespace natator
