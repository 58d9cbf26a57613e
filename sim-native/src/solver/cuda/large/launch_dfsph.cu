#include "conserving_launches.cuh"
#include "water_effect_kernels.cuh"

namespace natator::cuda {
namespace {

/// The solids of scheme conserving in water. See cpu/dfsph/dfsph_stages.h.
template <class Real>
struct DfsphLaunches : ConservingLaunches<Real> {
    using Base = ConservingLaunches<Real>;
    using Base::blocks, Base::launch, Base::model, Base::slots;

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
    void add_effects() const {
        const bool fields = model.surface_tension > 0 || model.vorticity > 0;
        if (fields) each_pair(measure_water<Real>);
        if (fields || model.water.cohesion_strength > 0 || model.free_surface_drag > 0)
            each_pair(push_water_by_effects<Real>);
    }
    void predict() const {
        const int cells = model.water.grid.cells;
        const WaterArrays<Real>& water = slots.water;
        launch.clear(water.table, cells);
        each_particle(begin_water<Real>);
        launch.add_up(water.table, cells);
        each_particle(scatter_water<Real>);
        each_particle(order_water<Real>);
        each_pair(find_water_neighbours<Real>, search_threads);
        each_pair(water_moments<Real>);
        each_pair(water_gradients<Real>);
        pass<Pass::first_parting>();
        for (int k = 1; k < physics::parting_passes; ++k) pass<Pass::parting>();
        for (int k = 0; k < physics::divergence_passes; ++k) pass<Pass::divergence>();
        each_pair(water_viscosity<Real>);
        add_effects();
        launch.clear(slots.at.table, 2 * model.grid.cells);
        each_particle(predict_in_water<Real>);
    }
    void solve_density_constraint() const { pass<Pass::density>(); }
    template <class AfterStage>
    void solve_solids_beside_free_fluid(const AfterStage& after) const {
        if (model.solids == 0) return;
        solids_in_water<<<launch.grid(1), threads, 0, launch.stream>>>(model, slots);
        after(Stage::solids);
    }
    void update_velocities() {
        each_particle(move_water<Real>);
        Base::update_velocities();
    }
};

}  // namespace

template <class Real>
void launch_water_substep(const LargeLaunch<Real>& launch) {
    launch_by<DfsphLaunches<Real>>(launch);
}

template void launch_water_substep(const LargeLaunch<float>&);
template void launch_water_substep(const LargeLaunch<double>&);

}  // namespace natator::cuda
