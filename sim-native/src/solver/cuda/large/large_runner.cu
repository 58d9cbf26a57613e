#include "large_runner.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "natator/actuate.h"
#include "scan.h"
#include "solver/cuda/device_states.h"

namespace natator::cuda {

template <class Real>
struct LargeRunner<Real>::Graph {
    cudaGraphExec_t exec = nullptr;
    ~Graph() {
        if (exec) cudaGraphExecDestroy(exec);
    }
};

namespace {

/// Cells of about the search distance / 4, as on the CPU: memory is not short here.
int most_cells(const Model& model) {
    return 4096 + 16 * model.particles();
}

template <class Real>
Real as_quad_number(int i) {
    if constexpr (sizeof(Real) == 4)
        return std::bit_cast<float>(i);
    else
        return std::bit_cast<double>(static_cast<long long>(i));
}

}  // namespace

template <class Real>
LargeRunner<Real>::LargeRunner(const Model& model, ContactRoom room)
    : host_model_(model), device_model_(model, most_cells(model)) {
    base_.model = device_model_.view();
    base_.slots.room = room;
    check(cudaStreamCreateWithFlags(&base_.stream, cudaStreamNonBlocking), "stream");
    int least = 0, greatest = 0;
    check(cudaDeviceGetStreamPriorityRange(&least, &greatest), "priority");
    check(cudaStreamCreateWithPriority(&base_.side, cudaStreamNonBlocking, greatest), "stream");
    check(cudaEventCreateWithFlags(&base_.fork, cudaEventDisableTiming), "event");
    check(cudaEventCreateWithFlags(&base_.joint, cudaEventDisableTiming), "event");
    allocate();
    check(cudaMallocHost(&end_, sizeof *end_), "host memory");
    before_ = room_for_copy();
    launch_far_slot(base_);
    check(cudaDeviceSynchronize(), "upload");  // the stream does not wait for the Model's uploads by itself
}

template <class Real>
LargeRunner<Real>::~LargeRunner() {
    graphs_.clear();
    cudaFreeHost(rest_lengths_);
    cudaFreeHost(end_);
    cudaEventDestroy(base_.fork);
    cudaEventDestroy(base_.joint);
    cudaStreamDestroy(base_.side);
    cudaStreamDestroy(base_.stream);
}

template <class Real>
template <class T>
void LargeRunner<Real>::give(T*& array, std::size_t size) {
    memory_.emplace_back(size * sizeof(T));
    array = reinterpret_cast<T*>(memory_.back().data());
}

template <class Real>
void LargeRunner<Real>::allocate() {
    const ModelView<Real>& model = base_.model;
    const std::size_t particles = model.particles, fluid = model.fluid, solids = model.solids, all = particles + 1;
    Slots<Real>& slots = base_.slots;
    SlotArrays<Real>& at = slots.at;
    slots.chunks = (model.most_neighbours + 3) / 4;
    for (auto* const array : {&at.state_position, &at.state_velocity, &at.predicted, &at.drift_before, &at.position,
                              &at.next, &at.start, &at.base, &at.drift, &at.contact_push})
        give(*array, all);
    for (auto* const array : {&at.cell, &at.number, &at.contact_count, &at.plane_contact, &at.touched})
        give(*array, all);
    give(at.fit, model.clusters);
    give(at.keys, particles);
    give(at.table, std::size_t(2) * model.grid.cells);
    give(at.slot_of_solid, solids);
    give(at.neighbour, (fluid + 31) / 32 * 32 * slots.chunks);
    give(at.neighbour_count, fluid);
    give(at.fluid_contact, model.plan.contacts ? fluid * slots.room.fluid : 0);
    give(at.solid_contact, model.plan.contacts ? solids * slots.room.solid : 0);
    give(at.shared, 1);
    base_.scan_bytes = scan_bytes(std::max(2 * model.grid.cells, model.water.grid.cells));
    memory_.emplace_back(base_.scan_bytes);
    base_.scan_room = memory_.back().data();
    const Plan& plan = model.plan;
    give(at.density, plan.free_surface_drag ? fluid : 0);
    give(at.overlaps, plan.dissipation ? all : 0);
    give(at.change, plan.dissipation ? all : 0);
    give(at.normal, plan.surface_tension ? fluid : 0);
    give(at.curl, plan.vorticity ? fluid : 0);
    if (model.scheme == Scheme::flex) return;
    give(at.active, all);
    for (auto* const array : {&at.displacement, &at.boundary}) give(*array, all);
    for (auto* const array : {&at.lambda, &at.lambda_sum, &at.overlap, &at.overlap_lambda}) give(*array, all);
    give(at.internal, solids);
    give(at.spring_push, model.springs);
    give(at.spring_lambda, model.springs);
    give(at.member_displacement, model.members);
    give(at.member_push, model.members);
    give(at.motion, model.free_bodies);
    if (plan.water) allocate_water();
}

template <class Real>
void LargeRunner<Real>::allocate_water() {
    const ModelView<Real>& model = base_.model;
    const std::size_t particles = model.particles, copies = particles * model.water.most_copies;
    WaterArrays<Real>& water = base_.slots.at.water;
    give(water.table, model.water.grid.cells);
    give(water.keys, copies);
    give(water.candidate, copies);
    for (auto* const array : {&water.position, &water.velocity, &water.pushed, &water.correction, &water.shear,
                              &water.crowding})
        give(*array, particles);
    for (auto* const array : {&water.density, &water.response, &water.target, &water.impulse, &water.density_of})
        give(*array, particles);
    for (auto* const array : {&water.count, &water.count_of, &water.slot_before, &water.slot_of_solid})
        give(*array, particles);
    // A lattice has 4/3 pi (R/s)^3; solids and crowds have more, see make_room.
    make_room(static_cast<int>(5 * std::pow(host_model_.parameters.kernelSupport, 3)));
}

/// For so many neighbours in the water's lists.
template <class Real>
void LargeRunner<Real>::make_room(int neighbours) {
    WaterArrays<Real>& water = base_.slots.at.water;
    const std::size_t particles = base_.model.particles;
    const std::size_t entries = (particles + 31) / 32 * 32 * neighbours;
    graphs_.clear();  // they know the old place
    neighbour_room_ = {};
    water.most = neighbours;
    neighbour_room_ = DeviceBuffer<unsigned>(entries);
    water.neighbour = neighbour_room_.data();
    for (int axis = 0; axis < 3; ++axis) {
        gradient_room_[axis] = {};
        gradient_room_[axis] = DeviceBuffer<Real>(entries);
        water.gradient[axis] = gradient_room_[axis].data();
    }
}

template <class Real>
typename LargeRunner<Real>::Copy LargeRunner<Real>::room_for_copy() const {
    return {DeviceBuffer<Quad<Real>>(base_.model.particles), DeviceBuffer<Quad<Real>>(base_.model.particles),
            DeviceBuffer<ClusterFit<Real>>(base_.model.clusters)};
}

namespace {

template <class T>
void copy(T* to, const T* from, std::size_t count, cudaStream_t stream) {
    if (count > 0) check(cudaMemcpyAsync(to, from, count * sizeof(T), cudaMemcpyDefault, stream), "copy");
}

}  // namespace

template <class Real>
void LargeRunner<Real>::copy_to(const Copy& to) const {
    const SlotArrays<Real>& at = base_.slots.at;
    copy(to.position.data(), at.state_position, to.position.size(), base_.stream);
    copy(to.velocity.data(), at.state_velocity, to.velocity.size(), base_.stream);
    copy(to.fit.data(), at.fit, to.fit.size(), base_.stream);
}

template <class Real>
void LargeRunner<Real>::copy_back(const Copy& from) const {
    const SlotArrays<Real>& at = base_.slots.at;
    copy(at.state_position, from.position.data(), from.position.size(), base_.stream);
    copy(at.state_velocity, from.velocity.data(), from.velocity.size(), base_.stream);
    copy(at.fit, from.fit.data(), from.fit.size(), base_.stream);
}

template <class Real>
void LargeRunner<Real>::wait() const {
    check(cudaStreamSynchronize(base_.stream), "run");
}

template <class Real>
void LargeRunner<Real>::upload(const State<Real>& state) {
    const std::vector<int>& number_of = device_model_.number_of();
    const std::size_t particles = number_of.size();
    std::vector<Quad<Real>> position(particles), velocity(particles);
    for (std::size_t i = 0; i < particles; ++i) {
        const Vector3<Real>&x = state.position[i], &v = state.velocity[i];
        const int number = number_of[i];
        position[number] = {x.x(), x.y(), x.z(), static_cast<Real>(host_model_.inverse_mass[i])};
        velocity[number] = {v.x(), v.y(), v.z(), as_quad_number<Real>(number)};
    }
    std::vector<ClusterFit<Real>> fits(base_.model.clusters);
    for (std::size_t k = 0; k < fits.size(); ++k) {
        const Vector3<Real>& centre = state.cluster_centre[k];
        fits[k].centre = {centre.x(), centre.y(), centre.z()};
        for (int e = 0; e < 4; ++e) fits[k].rotation[e] = state.cluster_rotation[k].coeffs()[e];
    }
    std::vector<int> slot_of_solid(base_.model.solids);
    for (std::size_t k = 0; k < slot_of_solid.size(); ++k) slot_of_solid[k] = base_.model.fluid + static_cast<int>(k);
    const SlotArrays<Real>& at = base_.slots.at;
    copy(at.state_position, position.data(), particles, base_.stream);
    copy(at.state_velocity, velocity.data(), particles, base_.stream);
    copy(at.fit, fits.data(), fits.size(), base_.stream);
    copy(at.slot_of_solid, slot_of_solid.data(), slot_of_solid.size(), base_.stream);
    muscles_.spring_rest_length = state.spring_rest_length;
    wait();
}

template <class Real>
State<Real> LargeRunner<Real>::download(const State<Real>& like) const {
    const std::size_t particles = base_.model.particles;
    std::vector<Quad<Real>> position(particles), velocity(particles);
    std::vector<ClusterFit<Real>> fits(base_.model.clusters);
    const SlotArrays<Real>& at = base_.slots.at;
    copy(position.data(), at.state_position, particles, base_.stream);
    copy(velocity.data(), at.state_velocity, particles, base_.stream);
    copy(fits.data(), at.fit, fits.size(), base_.stream);
    wait();
    State<Real> state = like;
    state.position = by_particle(device_model_, position.data(), velocity.data());
    state.velocity = by_particle(device_model_, velocity.data(), velocity.data());
    for (std::size_t c = 0; c < fits.size(); ++c) {
        state.cluster_centre[c] = {fits[c].centre.x, fits[c].centre.y, fits[c].centre.z};
        for (int e = 0; e < 4; ++e) state.cluster_rotation[c].coeffs()[e] = fits[c].rotation[e];
    }
    return state;
}

/// Scheme flex sets the muscles once for a frame, scheme conserving for the end of every substep.
template <class Real>
void LargeRunner<Real>::set_muscles(const Update& update) {
    const std::size_t springs = base_.model.springs, size = springs * update.substeps;
    if (size > rest_lengths_size_) {
        graphs_.clear();  // they know the old place
        cudaFreeHost(rest_lengths_);
        rest_lengths_ = nullptr;
        check(cudaMallocHost(&rest_lengths_, size * sizeof(Real)), "host memory");
        device_rest_lengths_ = DeviceBuffer<Real>(size);
        rest_lengths_size_ = size;
    }
    const bool by_substep = base_.model.scheme != Scheme::flex;
    for (int k = 0; k < update.substeps; ++k) {
        const double end = update.start_time + update.time_step * (k + 1) / update.substeps;
        if (update.gait && (by_substep || k == 0))
            actuate(host_model_, *update.gait, by_substep ? end : update.start_time, muscles_);
        std::copy(muscles_.spring_rest_length.begin(), muscles_.spring_rest_length.end(), rest_lengths_ + k * springs);
    }
}

template <class Real>
LargeLaunch<Real> LargeRunner<Real>::launch_of(const Update& update, int substep) const {
    LargeLaunch<Real> launch = base_;
    launch.slots.substep = substep;
    launch.slots.h = static_cast<Real>(update.time_step) / static_cast<Real>(update.substeps);
    launch.slots.at.rest_length = device_rest_lengths_.data() + std::size_t(substep) * base_.model.springs;
    return launch;
}

/// The first `substeps` of an update, and its end if these are all.
template <class Real>
void LargeRunner<Real>::launch(const Update& update, int substeps, StageClock* clock, const Trace<Real>& trace) const {
    const cudaStream_t stream = base_.stream;
    LargeShared<Real>* const shared = base_.slots.at.shared;
    copy(device_rest_lengths_.data(), rest_lengths_, std::size_t(update.substeps) * base_.model.springs, stream);
    check(cudaMemsetAsync(shared, 0xff, sizeof *shared, stream), "clear");
    copy_to(before_);
    if (clock) clock->mark(Stage::load);
    LargeLaunch<Real> last = base_;
    for (int k = 0; k < substeps; ++k) {
        last = launch_of(update, k);
        last.clock = clock;
        last.trace = trace;
        launch_substep(last);
    }
    if (update.settling) launch_rest(base_);
    launch_measure(base_);
    copy(end_, shared, 1, stream);
    if (clock) clock->mark(Stage::measure);
}

template <class Real>
cudaGraphExec_t LargeRunner<Real>::graph_of(const Update& update) {
    std::unique_ptr<Graph>& graph = graphs_[{update.time_step, update.substeps, update.settling}];
    if (!graph) {
        graph = std::make_unique<Graph>();
        cudaGraph_t captured = nullptr;
        check(cudaStreamBeginCapture(base_.stream, cudaStreamCaptureModeThreadLocal), "capture");
        launch(update, update.substeps, nullptr, {});
        check(cudaStreamEndCapture(base_.stream, &captured), "capture");
        check(cudaGraphInstantiate(&graph->exec, captured, 0), "graph");
        cudaGraphDestroy(captured);
    }
    return graph->exec;
}

template <class Real>
void LargeRunner<Real>::prepare(const Update& update) {
    set_muscles(update);
    check(cudaGraphUpload(graph_of(update), base_.stream), "graph");
    wait();
}

template <class Real>
typename LargeRunner<Real>::End LargeRunner<Real>::run(const Update& update, StageProfile* profile,
                                                       const Trace<Real>& trace) {
    set_muscles(update);
    std::optional<StageClock> clock;
    for (;;) {
        clock.reset();
        if (profile) clock.emplace(base_.stream);
        if (profile || trace.predicted)
            launch(update, update.substeps, clock ? &*clock : nullptr, trace);
        else
            check(cudaGraphLaunch(graph_of(update), base_.stream), "launch");
        wait();
        if (end_->most_neighbours <= base_.slots.at.water.most) break;
        copy_back(before_);  // and once more, with room for all neighbours
        make_room(end_->most_neighbours + end_->most_neighbours / 4);
    }
    if (clock) clock->add_to(*profile);
    End end;
    end.mean_x = end_->mean_x;
    end.touches_plane = end_->touches != 0;
    if (end_->bad == none_bad) return end;
    end.finite = false;
    end.bad_substep = static_cast<int>(end_->bad >> 32);
    end.bad_particle = static_cast<int>(end_->bad & 0xffffffffu);
    copy_back(before_);
    Update good = update;
    good.settling = false;
    if (end.bad_substep > 0) launch(good, end.bad_substep, nullptr, {});
    wait();
    return end;
}

template <class Real>
double LargeRunner<Real>::mean_x() {
    launch_measure(base_);
    copy(end_, base_.slots.at.shared, 1, base_.stream);
    wait();
    return end_->mean_x;
}

template <class Real>
std::vector<Real> LargeRunner<Real>::densities() const {
    if (!base_.model.plan.fluid && !base_.model.plan.water) return {};
    const DeviceBuffer<Real> densities(base_.model.fluid);
    launch_densities(base_, densities.data());
    wait();
    return densities.download();
}

template <class Real>
std::vector<int> LargeRunner<Real>::neighbour_counts() const {
    const DeviceBuffer<int> counts(base_.model.particles);
    launch_neighbour_counts(base_, counts.data());
    wait();
    return counts.download();
}

template class LargeRunner<float>;
template class LargeRunner<double>;

}  // namespace natator::cuda
