#include "conserving_kernels.cuh"
#include "effect_kernels.cuh"
#include "water_effect_kernels.cuh"

namespace natator::cuda {
namespace {

/// See cpu/conserving/conserving_stages.h.
template <class Real>
struct ConservingLaunches : LaunchEffects<Scheme::conserving, Real> {
    using Base = LaunchEffects<Scheme::conserving, Real>;
    using Base::blocks, Base::launch, Base::model, Base::slots;
    static constexpr Grouping grouping = Grouping::together;
    static constexpr bool effects = true;

    template <class Kernel>
    void each_particle(Kernel kernel) const {
        kernel<<<launch.grid(blocks), large_threads, 0, launch.stream>>>(model, slots);
    }
    template <class Kernel>
    void each_pair(Kernel kernel, int block = large_threads) const {
        kernel<<<launch.grid(blocks_for(model.particles * pair_lanes, block)), block, 0, launch.stream>>>(model, slots);
    }
    template <Pass which>
    void pass() const {
        each_pair(water_impulses<which, Real>);
        each_pair(push_water_apart<which, Real>);
    }

    void find_water_neighbours() const {
        const int cells = model.water.grid.cells;
        const WaterArrays<Real>& water = slots.water;
        launch.clear(water.table, cells);
        each_particle(begin_water<Real>);
        launch.add_up(water.table, cells);
        each_particle(scatter_water<Real>);
        each_particle(order_water<Real>);
        each_pair(find_water_neighbours_large<Real>, search_threads);
    }
    void compute_water_gradients() const {
        each_pair(water_moments<Real>);
        each_pair(water_gradients<Real>);
    }
    void solve_divergence() const {
        pass<Pass::first_parting>();
        for (int k = 1; k < physics::parting_passes; ++k) pass<Pass::parting>();
        for (int k = 0; k < physics::divergence_passes; ++k) pass<Pass::divergence>();
    }
    void add_viscosity() const { each_pair(water_viscosity<Real>); }
    void add_fluid_forces() const {
        if (model.plan.surface_tension || model.plan.vorticity) each_pair(measure_water<Real>);
        each_pair(push_water_by_effects<Real>);
    }
    void predict() const {
        if (!model.plan.water) return launch_predict<Real, Scheme::conserving>(launch);
        launch.clear(slots.at.table, 2 * model.grid.cells);
        each_particle(predict_in_water<Real>);
    }
    void begin_iterations() {
        each_particle(begin_large<Real>);
        Base::begin_iterations();
    }
    void solve_density_constraint() const { pass<Pass::density>(); }
    void solve_solids_together() const {
        if (model.solids > 0) solids_large<<<launch.grid(1), threads, 0, launch.stream>>>(model, slots);
    }
    void update_velocities() const {
        if (model.plan.water) {
            if (model.planes > 0) each_pair(hold_at_walls<Real>);
            each_particle(move_water<Real>);
        }
        each_particle(constrained_velocities<Real>);
        if (model.free_bodies > 0)
            body_momentum_large<<<launch.grid(1), threads, 0, launch.stream>>>(model, slots);
        each_particle(velocities_in_turn_large<Real>);
    }
};

}  // namespace

template <class Real, Scheme scheme>
void launch_substep_of(const LargeLaunch<Real>& launch) {
    static_assert(scheme == Scheme::conserving);
    launch_by<ConservingLaunches<Real>>(launch);
}

template void launch_substep_of<float, Scheme::conserving>(const LargeLaunch<float>&);
template void launch_substep_of<double, Scheme::conserving>(const LargeLaunch<double>&);

}  // namespace natator::cuda
