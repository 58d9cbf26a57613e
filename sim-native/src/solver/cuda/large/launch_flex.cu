#include "effect_kernels.cuh"

namespace natator::cuda {

namespace {

template <class Real>
struct FlexLaunches : LaunchEffects<Scheme::flex, Real> {
    static constexpr Grouping grouping = Grouping::together;
    static constexpr bool effects = true;

    void compute_density_and_fits() {
        const int fits = blocks_for(this->model.clusters, large_threads / 32);
        density_large
            <<<this->launch.grid(this->blocks + fits), large_threads, 0, this->launch.stream>>>(
                this->model, this->slots);
    }
    void apply_corrections() {
        corrections_large
            <<<this->launch.grid(this->blocks), large_threads, 0, this->launch.stream>>>(this->model, this->slots);
    }
    void update_velocities() {
        if (this->model.plan.viscosity)
            movements_large
                <<<this->launch.grid(this->blocks), large_threads, 0, this->launch.stream>>>(this->model, this->slots);
        velocities_large
            <<<this->launch.grid(this->blocks), large_threads, 0, this->launch.stream>>>(this->model, this->slots);
    }
};

}  // namespace

template <class Real, Scheme scheme>
void launch_substep_of(const LargeLaunch<Real>& launch) {
    static_assert(scheme == Scheme::flex);
    launch_by<FlexLaunches<Real>>(launch);
}

template void launch_substep_of<float, Scheme::flex>(const LargeLaunch<float>&);
template void launch_substep_of<double, Scheme::flex>(const LargeLaunch<double>&);

}  // namespace natator::cuda
