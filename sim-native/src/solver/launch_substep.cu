#include "cuda/grid/substep.cuh"
#include "solver/cuda/laws.cuh"
#include "solver/cuda/measure.cuh"
#include "solver/flex/cuda/flex_kernels.cuh"

namespace natator::cuda {
namespace {

template <class Real>
__device__ void densities_on_grid(const ModelView<Real>& model, const Slots<Real>& slots, int s, Real* density) {
    density += static_cast<std::size_t>(blockIdx.y) * model.fluid;
    density[slots.number()[s]] = model.plan.water ? slots.water.density[slots.water.slot_before[s]]
                                                  : compression_of(model, slots, s, xyz(slots.position()[s])) + 1;
}

template <class Real>
__device__ void neighbour_counts_on_grid(const ModelView<Real>& model, const Slots<Real>& slots, int s, int* counts) {
    counts += static_cast<std::size_t>(blockIdx.y) * model.particles;
    int& count = counts[slots.number()[s]];
    if (model.plan.water)
        count = slots.water.count[slots.water.slot_before[s]];
    else
        count =
            (s < model.fluid ? slots.neighbour_count()[s] : 0) + (model.plan.contacts ? slots.contact_count()[s] : 0);
}

template <class Real>
__device__ void pressures_on_grid(const ModelView<Real>& model, const Slots<Real>& slots, int s, Real* pressures) {
    const int before = slots.water.slot_before[s];
    Real pressure = slots.water.impulse_sum[before] / slots.h;
    if (const auto& carried = model.water.carried; carried.any())
        pressure += carried.pressure(xyz(slots.water.position[before]), model.water.density);
    pressures[static_cast<std::size_t>(blockIdx.y) * model.fluid + slots.number()[s]] = pressure;
}

template <class Real>
__device__ void body_places_on_grid(const ModelView<Real>& model, const Slots<Real>& slots, int b, Vec4<Real>* places) {
    places += static_cast<std::size_t>(blockIdx.y) * model.body;
    places[b] = slots.position()[slots.slot_of_solid()[model.body_particle[b]]];
}

template <class Real>
__device__ void measure_on_grid(const ModelView<Real>& model, const Slots<Real>& slots) {
    measure_path(model, slots, &slots.shared().mean_x);
    measure_tail(model, slots, &slots.shared().tail_z);
    const bool touches = touches_plane(model, slots);
    if (threadIdx.x == 0) slots.shared().touches = touches;
}

inline constexpr int law_threads = 128;

/// The measures of the laws, each block its own particles; those of the body by the first. Sums are in the same order
/// always.
template <class Real>
__device__ void measure_laws_on_grid(const ModelView<Real>& model, const Slots<Real>& slots) {
    __shared__ physics::LawMeasures parts[law_threads];
    const int own = threadIdx.x, step = static_cast<int>(gridDim.x) * law_threads;
    physics::LawMeasures sum;
    for (int s = static_cast<int>(blockIdx.x) * law_threads + own; s < model.particles; s += step) {
        const Vec4<Real> v = slots.arrays.state_velocity[s];
        add(sum, measures_of(model, number_in(v.w), slots.position()[s], xyz(v)));
    }
    for (int b = own; blockIdx.x == 0 && b < model.body; b += law_threads) add(sum, reach_of(model, slots, b));
    parts[own] = sum;
    for (int half = law_threads / 2; half > 0; half /= 2) {
        __syncthreads();
        if (own < half) add(parts[own], parts[own + half]);
    }
    if (own == 0) slots.shared().laws[blockIdx.x] = parts[0];
}

/// Adds a substep's work of each swimmer's muscles to the update's. One warp, always in the same order.
template <class Real>
__device__ void work_on_grid(const ModelView<Real>& model, const Slots<Real>& slots) {
    const Real* const before = slots.rest_length() - model.springs;
    for (int swimmer = 0; swimmer < model.swimmers; ++swimmer) {
        double sum = 0;
        const int end = model.swimmer_springs_begin[swimmer + 1];
#pragma unroll 4
        for (int k = model.swimmer_springs_begin[swimmer] + static_cast<int>(threadIdx.x); k < end; k += 32)
            sum += physics::spring_work(double(model.relaxation_factor) * slots.spring_lambda()[k], double(slots.h),
                                        double(slots.rest_length()[k]) - double(before[k]));
        sum = sum_of_warp(sum);
        double& work = slots.shared().muscle_work[swimmer];
        if (threadIdx.x == 0) work = slots.substep == 0 ? sum : work + sum;
    }
}

template <class Real>
__device__ void keep_on_grid(const ModelView<Real>& model, const Slots<Real>& slots, int s, Vec4<Real>* position,
                             Vec4<Real>* velocity, ClusterFit<Real>* fits) {
    const std::size_t state = blockIdx.y, place = state * model.particles + s;
    position[place] = slots.arrays.state_position[s];
    velocity[place] = slots.arrays.state_velocity[s];
    for (int c = s; c < model.clusters; c += model.particles) fits[state * model.clusters + c] = slots.fit()[c];
}

template <class Real>
__device__ void rest_on_grid(const ModelView<Real>&, const Slots<Real>& slots, int s) {
    slots.arrays.state_velocity[s] = {0, 0, 0, slots.arrays.state_velocity[s].w};
}

template <class Real>
__device__ void far_slot_on_grid(const ModelView<Real>& model, const Slots<Real>& slots) {
    for (Vec4<Real>* const array :
         {slots.arrays.state_position, slots.position(), slots.scratch_position(), slots.start()})
        array[model.particles] = far_away<Real>();
}

template <class Real>
__device__ void record_on_grid(const ModelView<Real>&, const Slots<Real>& slots, int s, Vec4<Real>* to) {
    if (blockIdx.y == 0) to[s] = quad(xyz(slots.position()[s]), as_number<Real>(slots.number()[s]));
}

/// With the State's positions in place of those of the last iteration: they differ for particles of infinite mass.
template <class Real>
GridLaunch<Real> at_the_end(GridLaunch<Real> launch) {
    launch.slots.arrays.position = launch.slots.arrays.state_position;
    return launch;
}

}  // namespace

template <class Real>
void launch_substep(const GridLaunch<Real>& launch) {
    if (launch.model.scheme == Scheme::flex)
        launch_substep_of<Real, Scheme::flex>(launch);
    else
        launch_substep_of<Real, Scheme::conserving>(launch);
    if (launch.trace.velocity)
        check(cudaMemcpyAsync(launch.trace.velocity + std::size_t(launch.slots.substep) * launch.model.particles,
                              launch.slots.arrays.state_velocity, launch.model.particles * sizeof(Vec4<Real>),
                              cudaMemcpyDeviceToDevice, launch.stream),
              "copy");
}

template <class Real>
void record_positions(const GridLaunch<Real>& launch, Vec4<Real>* to, int row) {
    if (to)
        launch.template report_slots<record_on_grid<Real>>(launch.model.particles,
                                                           to + static_cast<std::size_t>(row) * launch.model.particles);
}

template <class Real>
void launch_densities(const GridLaunch<Real>& launch, Real* density) {
    at_the_end(launch).template report_slots<densities_on_grid<Real>>(launch.model.fluid, density);
}

template <class Real>
void launch_neighbour_counts(const GridLaunch<Real>& launch, int* counts) {
    launch.template report_slots<neighbour_counts_on_grid<Real>>(launch.model.particles, counts);
}

template <class Real>
void launch_pressures(const GridLaunch<Real>& launch, Real* pressures) {
    launch.template report_slots<pressures_on_grid<Real>>(launch.model.fluid, pressures);
}

template <class Real>
void launch_body_places(const GridLaunch<Real>& launch, Vec4<Real>* places) {
    at_the_end(launch).template report_slots<body_places_on_grid<Real>>(launch.model.body, places);
}

template <class Real>
void launch_measure(const GridLaunch<Real>& launch) {
    at_the_end(launch).template report_states<measure_on_grid<Real>, BlockTeam::threads>();
    at_the_end(launch).template report_states<measure_laws_on_grid<Real>, law_threads>(
        law_blocks(launch.model.particles));
}

template <class Real>
void launch_work(const GridLaunch<Real>& launch) {
    if (launch.model.scheme == Scheme::flex || launch.model.springs == 0) return;
    launch.template each_state<work_on_grid<Real>, 32>(1);
    check(cudaGetLastError(), "launch");
}

template <class Real>
void launch_keep(const GridLaunch<Real>& launch, Vec4<Real>* position, Vec4<Real>* velocity, ClusterFit<Real>* fits) {
    launch.template each_slot<keep_on_grid<Real>>(launch.model.particles, position, velocity, fits);
    check(cudaGetLastError(), "launch");
}

template <class Real>
void launch_rest(const GridLaunch<Real>& launch) {
    launch.template each_particle<rest_on_grid<Real>>();
    check(cudaGetLastError(), "launch");
}

template <class Real>
void launch_far_slot(const GridLaunch<Real>& launch) {
    launch.template report_states<far_slot_on_grid<Real>, 1>();
}

#define NATATOR_INSTANTIATE(Real)                                                                    \
    template void launch_substep(const GridLaunch<Real>&);                                           \
    template void record_positions(const GridLaunch<Real>&, Vec4<Real>*, int);                       \
    template void launch_densities(const GridLaunch<Real>&, Real*);                                  \
    template void launch_neighbour_counts(const GridLaunch<Real>&, int*);                            \
    template void launch_pressures(const GridLaunch<Real>&, Real*);                                  \
    template void launch_body_places(const GridLaunch<Real>&, Vec4<Real>*);                          \
    template void launch_measure(const GridLaunch<Real>&);                                           \
    template void launch_work(const GridLaunch<Real>&);                                              \
    template void launch_keep(const GridLaunch<Real>&, Vec4<Real>*, Vec4<Real>*, ClusterFit<Real>*); \
    template void launch_rest(const GridLaunch<Real>&);                                              \
    template void launch_far_slot(const GridLaunch<Real>&)
NATATOR_INSTANTIATE(float);
NATATOR_INSTANTIATE(double);
#undef NATATOR_INSTANTIATE

}  // namespace natator::cuda
