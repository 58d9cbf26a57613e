#include "effect_kernels.cuh"

namespace natator::cuda {

namespace {

template <class Real>
struct FlexLaunches : LaunchEffects<Scheme::flex, Real> {
    using Base = LaunchEffects<Scheme::flex, Real>;
    using Base::launch, Base::model;
    static constexpr Grouping grouping = Grouping::fused;
    static constexpr bool effects = true;

    void compute_density_and_fits() {
        constexpr int blocks =
            sizeof(Real) == sizeof(float) ? 3 : 2;  // registers for fits would leave too few warps at a time
        launch.template each_thread<compute_density<Real, const Slots<Real>>, grid_threads, blocks>(
            model.particles + 32 * model.clusters);
    }
    void apply_corrections() {
        const int tasks = solid_tasks(model, Slots<Real>::shares_solids()) + fluid_tasks(model);
        launch.template each_thread<cuda::apply_corrections<Real, const Slots<Real>>, grid_threads, 6>(32 * tasks);
    }
    void update_velocities() {
        if (model.plan.viscosity) launch.template each_slot<movements_on_grid<Real>>(model.fluid);
        launch.template each_particle<velocities_on_grid<Real>, 6>();
    }
};

}  // namespace

template <class Real, Scheme scheme>
void launch_substep_of(const GridLaunch<Real>& launch) {
    static_assert(scheme == Scheme::flex);
    launch_by<FlexLaunches<Real>>(launch);
}

template void launch_substep_of<float, Scheme::flex>(const GridLaunch<float>&);
template void launch_substep_of<double, Scheme::flex>(const GridLaunch<double>&);

}  // namespace natator::cuda
