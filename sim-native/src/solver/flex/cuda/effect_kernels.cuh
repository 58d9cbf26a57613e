#pragma once

// What acts behind the velocities, by the whole grid.
#include "flex_kernels.cuh"
#include "solver/cuda/grid/substep.cuh"

namespace natator::cuda {

template <class Real>
__device__ void check_slot(const ModelView<Real>&, const Slots<Real>& slots, int s) {
    note_if_bad(slots, s, xyz(slots.end_position()[s]), velocity_of<Real>(slots, s));
}

/// Stages of a substep with their effects.
template <Scheme scheme, class Real>
struct LaunchEffects : LaunchStages<scheme, Real> {
    using LaunchStages<scheme, Real>::launch, LaunchStages<scheme, Real>::model;
    using Grid = Slots<Real>;

    void begin_iterations() {
        if (model.plan.dissipation) launch.template each_particle<count_overlaps<Real, Grid>>();
    }
    void damp_contacts() {
        if constexpr (scheme == Scheme::flex) return launch.template each_particle<damp<Real, Grid>>();
        launch.template each_particle<measure_damping<Real, Grid>>();
        launch.template each_particle<apply_change<Real, Grid>>();
    }
    void drag_free_surface() { launch.template each_slot<drag<Real, Grid>>(model.fluid); }
    void apply_fluid_forces() {
        launch.template each_slot<measure_fluid<Real, Grid>>(model.fluid);
        launch.template each_slot<push_fluid_by_forces<Real, Grid>>(model.fluid);
    }
    void apply_adhesion() { launch.template each_particle<cuda::apply_adhesion<Real, Grid>>(); }
    void apply_restitution() { launch.template each_particle<cuda::apply_restitution<Real, Grid>>(); }
    void apply_sleep() { launch.template each_particle<cuda::apply_sleep<Real, Grid>>(); }
};

/// Launches a substep.
template <class Stages>
void launch_by(const GridLaunch<typename Stages::Real>& launch) {
    Stages stages{{{launch}}};
    natator::substep(stages, launch.model.plan, {launch.model.iterations}, AfterLaunch<Stages>{stages});
    if (launch.model.plan.effects()) launch.template each_particle<check_slot<typename Stages::Real>>();
    check(cudaGetLastError(), "launch");
}

}  // namespace natator::cuda
