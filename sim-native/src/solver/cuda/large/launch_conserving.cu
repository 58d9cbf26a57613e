#include "conserving_kernels.cuh"
#include "substep.cuh"

namespace natator::cuda {
namespace {

constexpr int touched_blocks = 32;  ///< what has contacts is little

template <class Real>
void launch_density_constraint(const LargeLaunch<Real>& launch, bool first) {
    const ModelView<Real>& model = launch.model;
    const int blocks = blocks_for(model.particles, large_threads);
    lambda_large<<<blocks, large_threads, 0, launch.stream>>>(model, launch.slots);
    if (first) {
        find_overlap_large<<<blocks, large_threads, 0, launch.stream>>>(model, launch.slots);
        limit_lambda_large<<<blocks, large_threads, 0, launch.stream>>>(model, launch.slots);
    }
    if (model.plan.contacts)
        touched_pressure_large<<<touched_blocks, large_threads, 0, launch.stream>>>(model, launch.slots);
}

}  // namespace

template <class Real, Scheme scheme>
void launch_substep_of(const LargeLaunch<Real>& launch) {
    static_assert(scheme == Scheme::conserving);
    const ModelView<Real>& model = launch.model;
    const Slots<Real>& slots = launch.slots;
    const Plan& plan = model.plan;
    const int blocks = blocks_for(model.particles, large_threads);
    launch_search<Real, scheme>(launch);
    begin_large<<<blocks, large_threads, 0, launch.stream>>>(model, slots);
    if (plan.fluid) {
        mark_one_sided<<<blocks, large_threads, 0, launch.stream>>>(model, slots);
        drop_marked<<<blocks, large_threads, 0, launch.stream>>>(model, slots);
    }
    launch.mark("neighbours");
    for (int i = 0; i < model.iterations; ++i) {
        if (plan.fluid) launch_density_constraint(launch, i == 0);
        if (model.solids > 0) {
            launch.mark("density constraint");
            solids_large<<<1, threads, 0, launch.part()>>>(model, slots);
            launch.mark("solids");
        }
        if (plan.fluid) free_pressure_large<<<blocks, large_threads, 0, launch.stream>>>(model, slots);
        launch.mark("density constraint");
        if (model.solids > 0) launch.join();
        record_positions(launch, launch.trace.iterated, slots.substep * model.iterations + i);
    }
    constrained_velocities<<<blocks, large_threads, 0, launch.stream>>>(model, slots);
    if (model.free_bodies > 0) body_momentum_large<<<1, threads, 0, launch.part()>>>(model, slots);
    if (plan.fluid) {
        rate_lambda_large<<<blocks, large_threads, 0, launch.stream>>>(model, slots);
        rate_push_large<<<blocks, large_threads, 0, launch.stream>>>(model, slots);
    }
    if (model.free_bodies > 0) launch.join();
    velocities_in_turn_large<<<blocks, large_threads, 0, launch.stream>>>(model, slots);
    launch.mark("velocities");
    check(cudaGetLastError(), "launch");
}

template void launch_substep_of<float, Scheme::conserving>(const LargeLaunch<float>&);
template void launch_substep_of<double, Scheme::conserving>(const LargeLaunch<double>&);

}  // namespace natator::cuda
