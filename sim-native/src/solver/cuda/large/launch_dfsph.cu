#include "conserving_launches.cuh"
#include "scan.h"
#include "water_kernels.cuh"

namespace natator::cuda {
namespace {

/// The solids of scheme conserving in water. See cpu/dfsph/dfsph_stages.h.
template <class Real>
struct DfsphLaunches : ConservingLaunches<Real> {
    using Base = ConservingLaunches<Real>;
    using Base::blocks, Base::launch, Base::model, Base::slots;

    template <class Kernel>
    void each_particle(Kernel kernel) const {
        kernel<<<blocks, large_threads, 0, launch.stream>>>(model, slots);
    }
    void predict() const {
        const int cells = model.water.grid.cells;
        const WaterArrays<Real>& water = slots.at.water;
        check(cudaMemsetAsync(water.table, 0, cells * sizeof(int), launch.stream), "clear");
        each_particle(begin_water<Real>);
        exclusive_scan(water.table, cells, launch.scan_room, launch.scan_bytes, launch.stream);
        each_particle(scatter_water<Real>);
        each_particle(order_water<Real>);
        find_water_neighbours<<<blocks_for(model.particles, search_threads), search_threads, 0, launch.stream>>>(
            model, slots);
        each_particle(water_moments<Real>);
        each_particle(water_gradients<Real>);
        for (int pass = 0; pass < physics::divergence_passes; ++pass) {
            each_particle(water_impulses<Real>);
            each_particle(push_water_apart<false, Real>);
        }
        each_particle(push_water<Real>);
        check(cudaMemsetAsync(slots.at.table, 0, 2 * model.grid.cells * sizeof(int), launch.stream), "clear");
        each_particle(predict_in_water<Real>);
    }
    void solve_density_constraint() const {
        each_particle(water_impulses<Real>);
        each_particle(push_water_apart<true, Real>);
    }
    template <class AfterStage>
    void solve_solids_beside_free_fluid(const AfterStage& after) const {
        if (model.solids == 0) return;
        solids_in_water<<<1, threads, 0, launch.stream>>>(model, slots);
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
