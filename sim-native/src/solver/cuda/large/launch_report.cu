#include "flex_kernels.cuh"
#include "solver/cuda/measure.cuh"
#include "substep.cuh"

namespace natator::cuda {
namespace {

template <class Real>
__global__ void densities_large(const __grid_constant__ ModelView<Real> model,
                                const __grid_constant__ Slots<Real> states, Real* density) {
    const Slots<Real> slots = states.state(blockIdx.y);
    const int s = own_index();
    if (s >= model.fluid) return;
    density += static_cast<std::size_t>(blockIdx.y) * model.fluid;
    if (model.plan.water) {
        density[s] = slots.water.density_of[s];
        return;
    }
    const Vec3<Real> x = xyz(slots.position()[s]);
    density[slots.number()[s]] = compression_of(model, slots, s, x) + 1;
}

template <class Real>
__global__ void neighbour_counts_large(const __grid_constant__ ModelView<Real> model,
                                       const __grid_constant__ Slots<Real> states, int* counts) {
    const Slots<Real> slots = states.state(blockIdx.y);
    const int s = own_index();
    if (s >= model.particles) return;
    counts += static_cast<std::size_t>(blockIdx.y) * model.particles;
    if (model.plan.water) {
        counts[s] = slots.water.count_of[s];
        return;
    }
    counts[slots.number()[s]] =
        (s < model.fluid ? slots.neighbour_count()[s] : 0) + (model.plan.contacts ? slots.contact_count()[s] : 0);
}

template <class Real>
__global__ void measure_large(const __grid_constant__ ModelView<Real> model,
                              const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    measure_path(model, slots, &slots.shared().mean_x);
    measure_tail(model, slots, &slots.shared().tail_z);
    const bool touches = touches_plane(model, slots);
    if (threadIdx.x == 0) slots.shared().touches = touches;
}

/// Adds a substep's work of the muscles to the update's. One warp, always in the same order.
template <class Real>
__global__ void work_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    if (slots.failed()) return;
    const Real* const before = slots.rest_length() - model.springs;
    double sum = 0;
    for (int k = threadIdx.x; k < model.springs; k += 32)
        sum += physics::spring_work(double(model.relaxation_factor) * slots.spring_lambda()[k], double(slots.h),
                                    double(slots.rest_length()[k]) - double(before[k]));
    for (int step = 16; step > 0; step /= 2) sum += __shfl_xor_sync(0xffffffff, sum, step);
    double& work = slots.shared().muscle_work;
    if (threadIdx.x == 0) work = slots.substep == 0 ? sum : work + sum;
}

template <class Real>
__global__ void rest_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    const int s = own_index();
    if (s < model.particles && !*slots.at.idle) slots.at.state_velocity[s] = {0, 0, 0, slots.at.state_velocity[s].w};
}

template <class Real>
__global__ void far_slot_large(const __grid_constant__ ModelView<Real> model,
                               const __grid_constant__ Slots<Real> states) {
    const Slots<Real> slots = states.state(blockIdx.y);
    for (Quad<Real>* const array : {slots.at.state_position, slots.position(), slots.next(), slots.start()})
        array[model.particles] = far_away<Real>();
}

template <class Real>
__global__ void record_large(const __grid_constant__ ModelView<Real> model, const __grid_constant__ Slots<Real> states,
                             Quad<Real>* to) {
    const Slots<Real> slots = states.state(blockIdx.y);
    const int s = own_index();
    if (s < model.particles) to[s] = quad(xyz(slots.position()[s]), as_number<Real>(slots.number()[s]));
}

/// With the State's positions in place of those of the last iteration: they differ for particles of infinite mass.
template <class Real>
Slots<Real> at_the_end(const LargeLaunch<Real>& launch) {
    Slots<Real> slots = launch.slots;
    slots.at.position = slots.at.state_position;
    return slots;
}

template <class Real>
int blocks_of(const LargeLaunch<Real>& launch) {
    return blocks_for(launch.model.particles, large_threads);
}

}  // namespace

template <class Real>
void launch_substep(const LargeLaunch<Real>& launch) {
    if (launch.model.scheme == Scheme::conserving)
        launch_substep_of<Real, Scheme::conserving>(launch);
    else
        launch_substep_of<Real, Scheme::flex>(launch);
    if (launch.trace.velocity)
        check(cudaMemcpyAsync(launch.trace.velocity + std::size_t(launch.slots.substep) * launch.model.particles,
                              launch.slots.at.state_velocity, launch.model.particles * sizeof(Quad<Real>),
                              cudaMemcpyDeviceToDevice, launch.stream),
              "copy");
}

template <class Real>
void record_positions(const LargeLaunch<Real>& launch, Quad<Real>* to, int row) {
    if (!to) return;
    to += static_cast<std::size_t>(row) * launch.model.particles;
    record_large<<<blocks_of(launch), large_threads, 0, launch.stream>>>(launch.model, launch.slots, to);
}

template <class Real>
void launch_densities(const LargeLaunch<Real>& launch, Real* density) {
    densities_large
        <<<launch.grid(blocks_of(launch)), large_threads, 0, launch.stream>>>(
            launch.model, at_the_end(launch), density);
    check(cudaGetLastError(), "launch");
}

template <class Real>
void launch_neighbour_counts(const LargeLaunch<Real>& launch, int* counts) {
    neighbour_counts_large
        <<<launch.grid(blocks_of(launch)), large_threads, 0, launch.stream>>>(launch.model, launch.slots, counts);
    check(cudaGetLastError(), "launch");
}

template <class Real>
void launch_measure(const LargeLaunch<Real>& launch) {
    measure_large<<<launch.grid(1), threads, 0, launch.stream>>>(launch.model, at_the_end(launch));
    check(cudaGetLastError(), "launch");
}

template <class Real>
void launch_work(const LargeLaunch<Real>& launch) {
    if (launch.model.scheme == Scheme::flex || launch.model.springs == 0) return;
    work_large<<<launch.grid(1), 32, 0, launch.stream>>>(launch.model, launch.slots);
    check(cudaGetLastError(), "launch");
}

template <class Real>
void launch_rest(const LargeLaunch<Real>& launch) {
    rest_large<<<launch.grid(blocks_of(launch)), large_threads, 0, launch.stream>>>(launch.model, launch.slots);
    check(cudaGetLastError(), "launch");
}

template <class Real>
void launch_far_slot(const LargeLaunch<Real>& launch) {
    far_slot_large<<<launch.grid(1), 1, 0, launch.stream>>>(launch.model, launch.slots);
    check(cudaGetLastError(), "launch");
}

#define NATATOR_INSTANTIATE(Real)                                               \
    template void launch_substep(const LargeLaunch<Real>&);                     \
    template void record_positions(const LargeLaunch<Real>&, Quad<Real>*, int); \
    template void launch_densities(const LargeLaunch<Real>&, Real*);            \
    template void launch_neighbour_counts(const LargeLaunch<Real>&, int*);      \
    template void launch_measure(const LargeLaunch<Real>&);                     \
    template void launch_work(const LargeLaunch<Real>&);                        \
    template void launch_rest(const LargeLaunch<Real>&);                        \
    template void launch_far_slot(const LargeLaunch<Real>&)
NATATOR_INSTANTIATE(float);
NATATOR_INSTANTIATE(double);
#undef NATATOR_INSTANTIATE

}  // namespace natator::cuda
