#include "large_runner.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "natator/actuate.h"
#include "rows.h"
#include "scan.h"
#include "solver/cuda/device_states.h"
#include "solver/cuda/event.h"

namespace natator::cuda {

template <class Real>
struct LargeRunner<Real>::Graph {
    cudaGraphExec_t exec = nullptr;
    ~Graph() {
        if (exec) cudaGraphExecDestroy(exec);
    }
};

namespace {

constexpr int usual_neighbours = 32;      // of fluid in scheme flex: a lattice has 18, and it packs closer by half
constexpr int usual_copies = 2;           // of a particle of the water, itself and ghosts, on average
constexpr int fluid_around_a_solid = 32;  // that has room for lists of contacts

template <class Real>
Real as_quad_number(int i) {
    if constexpr (sizeof(Real) == 4)
        return std::bit_cast<float>(i);
    else
        return std::bit_cast<double>(static_cast<long long>(i));
}

}  // namespace

template <class Real>
LargeRunner<Real>::LargeRunner(const Model& model, int states, ContactRoom room, bool keeps_forces)
    : host_model_(model), device_model_(model, true), muscles_(states), idle_(states, 0), end_(states) {
    base_.model = device_model_.view();
    base_.states = states;
    base_.slots.room = room;
    base_.keeps_forces = keeps_forces && base_.model.plan.water;
    check(cudaStreamCreateWithFlags(&base_.stream, cudaStreamNonBlocking), "stream");
    allocate();
    const std::size_t particles = base_.model.particles;
    before_.position = DeviceBuffer<Quad<Real>>(states * particles);
    before_.velocity = DeviceBuffer<Quad<Real>>(states * particles);
    before_.fit = DeviceBuffer<ClusterFit<Real>>(states * std::size_t(base_.model.clusters));
    launch_far_slot(base_);
    wait_for_uploads();  // the stream does not wait for the Model's by itself
}

template <class Real>
LargeRunner<Real>::~LargeRunner() {
    graphs_.clear();
    cudaStreamDestroy(base_.stream);
}

/// The arrays of a State one behind the other, and so for each State.
template <class Real>
void LargeRunner<Real>::allocate() {
    const ModelView<Real>& size = base_.model;
    const Plan& plan = size.plan;
    Slots<Real>& slots = base_.slots;
    const bool turns = size.scheme != Scheme::flex, keeps_forces = base_.keeps_forces;
    const std::size_t all = size.particles + 1, water = plan.water ? size.particles : 0;
    if (plan.contacts && plan.fluid) slots.room.fluid_rows = std::min(size.fluid, fluid_around_a_solid * size.solids);
    const struct {
        std::size_t next, cells, neighbours, fluid_contacts, solid_contacts;
    } room{all, std::size_t(2) * size.grid.cells, 0,
           std::size_t(slots.room.fluid_rows) * slots.room.fluid,
           plan.contacts ? std::size_t(size.solids) * slots.room.solid : 0};
    std::vector<std::pair<void**, std::size_t>> places;
    std::size_t bytes = 0;
    const auto give = [&](auto*& array, std::size_t count) {
        constexpr std::size_t alignment = 256;
        places.emplace_back(reinterpret_cast<void**>(&array), bytes);
        bytes += (count * sizeof *array + alignment - 1) / alignment * alignment;
    };
#define NATATOR_GIVE(type, name, count, ...) give(slots.at.name, count);
    NATATOR_STATE_ARRAYS(NATATOR_GIVE)
#undef NATATOR_GIVE
#define NATATOR_GIVE(type, name, count) give(slots.water.name, count);
    NATATOR_WATER_ARRAYS(NATATOR_GIVE)
#undef NATATOR_GIVE
    memory_ = DeviceBuffer<char>(bytes * base_.states);
    for (const auto& [array, place] : places) *array = memory_.data() + place;
    slots.stride = bytes;
    shared_ = DeviceBuffer<LargeShared<Real>>(base_.states);
    slots.at.shared = shared_.data();
    device_idle_ = DeviceBuffer<int>(idle_);
    slots.at.idle = device_idle_.data();
    scan_room_ = DeviceBuffer<char>(scan_bytes(std::max(2 * size.grid.cells, size.water.grid.cells), base_.states));
    base_.scan_room = scan_room_.data();
    if (plan.water) {
        make_room_for_rows(blocks_for(size.particles, slots_of_row) *
                           blocks_for(usual_water_neighbours(host_model_.parameters.kernelSupport), water_lists));
        make_room_for_copies(std::min(size.water.most_copies, usual_copies) * size.particles);
    }
    if (plan.fluid) make_room_in_fluid(std::min(size.most_neighbours, usual_neighbours));
}

namespace {

/// A new array in a buffer, in place of the old one: both are never there.
template <class T>
void renew(DeviceBuffer<T>& buffer, std::size_t count, T*& array) {
    buffer = {};
    buffer = DeviceBuffer<T>(count);
    array = buffer.data();
}

}  // namespace

/// In the water's lists of each State.
template <class Real>
void LargeRunner<Real>::make_room_for_rows(int rows) {
    WaterArrays<Real>& water = base_.slots.water;
    const std::size_t entries = static_cast<std::size_t>(rows) * water_row * base_.states;
    graphs_.clear();  // they know the old place
    base_.slots.water_room.lists = rows;
    renew(neighbour_room_, entries, water.neighbour);
    renew(pair_room_, entries, water.pair);
}

/// Of the water's particles in each State: themselves and their ghosts.
template <class Real>
void LargeRunner<Real>::make_room_for_copies(int copies) {
    WaterArrays<Real>& water = base_.slots.water;
    const std::size_t all = static_cast<std::size_t>(copies) * base_.states;
    graphs_.clear();
    base_.slots.water_room.copies = copies;
    renew(key_room_, all, water.keys);
    renew(candidate_room_, all, water.candidate);
}

/// Likewise in the lists of scheme flex.
template <class Real>
void LargeRunner<Real>::make_room_in_fluid(int neighbours) {
    Slots<Real>& slots = base_.slots;
    graphs_.clear();
    slots.chunks = (neighbours + 3) / 4;
    slots.list_chunks = static_cast<std::size_t>(blocks_for(base_.model.fluid, 32)) * 32 * slots.chunks;
    renew(chunk_room_, slots.list_chunks * base_.states, slots.at.neighbour);
}

template <class Real>
void LargeRunner<Real>::make_room(ListRoom needed) {
    if (needed.copies > room().copies) make_room_for_copies(needed.copies);
    if (needed.lists <= room().lists) return;
    if (base_.model.plan.water)
        make_room_for_rows(needed.lists);
    else
        make_room_in_fluid(std::min(needed.lists, base_.model.most_neighbours));
}

/// Was there room for what the last update found? If not, makes more than that.
template <class Real>
bool LargeRunner<Real>::had_room() {
    ListRoom needed;
    for (int k = 0; k < base_.states; ++k) {
        needed.lists = std::max(needed.lists, end_[k].needed.lists);
        needed.copies = std::max(needed.copies, end_[k].needed.copies);
    }
    if (needed.lists <= room().lists && needed.copies <= room().copies) return true;
    const int share = base_.model.plan.water ? 8 : 4;  // all slots of the water together vary less than a particle does
    make_room({needed.lists + needed.lists / share, needed.copies + needed.copies / share});
    return false;
}

namespace {

template <class T>
void copy(T* to, const T* from, std::size_t count, cudaStream_t stream) {
    if (count > 0) check(cudaMemcpyAsync(to, from, count * sizeof(T), cudaMemcpyDefault, stream), "copy");
}

}  // namespace

/// Of all States, beside them.
template <class Real>
void LargeRunner<Real>::keep_before() const {
    const auto keep = [&](const auto& to, const auto* from, std::size_t count) {
        copy_rows(to.data(), count * sizeof *from, from, base_.slots.stride, count, base_.states, base_.stream);
    };
    const StateArrays<Real>& at = base_.slots.at;
    keep(before_.position, at.state_position, base_.model.particles);
    keep(before_.velocity, at.state_velocity, base_.model.particles);
    keep(before_.fit, at.fit, base_.model.clusters);
}

/// Of State k; what else there is of it is made anew in every substep.
template <class Real>
void LargeRunner<Real>::restore_before(int k) const {
    const Slots<Real> slots = base_.slots.state(k);
    const auto restore = [&](auto* to, const auto& from, std::size_t count) {
        copy(to, from.data() + k * count, count, base_.stream);
    };
    restore(slots.at.state_position, before_.position, base_.model.particles);
    restore(slots.at.state_velocity, before_.velocity, base_.model.particles);
    restore(slots.at.fit, before_.fit, base_.model.clusters);
}

template <class Real>
void LargeRunner<Real>::wait() const {
    check(cudaStreamSynchronize(base_.stream), "run");
}

template <class Real>
void LargeRunner<Real>::upload(int k, const State<Real>& state) {
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
    const Slots<Real> slots = base_.slots.state(k);
    const StateArrays<Real>& at = slots.at;
    copy(at.state_position, position.data(), particles, base_.stream);
    copy(at.state_velocity, velocity.data(), particles, base_.stream);
    copy(at.fit, fits.data(), fits.size(), base_.stream);
    copy(at.slot_of_solid, slot_of_solid.data(), slot_of_solid.size(), base_.stream);
    muscles_[k].spring_rest_length = state.spring_rest_length;
    wait();
}

template <class Real>
State<Real> LargeRunner<Real>::download(int k, const State<Real>& like) const {
    const std::size_t particles = base_.model.particles;
    std::vector<Quad<Real>> position(particles), velocity(particles);
    std::vector<ClusterFit<Real>> fits(base_.model.clusters);
    const Slots<Real> slots = base_.slots.state(k);
    const StateArrays<Real>& at = slots.at;
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

template <class Real>
void LargeRunner<Real>::set_idle(const std::vector<bool>& idle) {
    idle_.assign(idle.begin(), idle.end());
    device_idle_.upload(idle_);
}

/// Scheme flex sets the muscles once for a frame, the others for the end of every substep.
template <class Real>
void LargeRunner<Real>::set_muscles(const Update& update) {
    const std::size_t springs = base_.model.springs, of_state = springs * (update.substeps + 1);
    const std::size_t size = of_state * base_.states;
    if (size > rest_lengths_.size()) {
        graphs_.clear();  // they know the old place
        rest_lengths_ = HostBuffer<Real>(size);
        device_rest_lengths_ = DeviceBuffer<Real>(size);
    }
    const bool by_substep = base_.model.scheme != Scheme::flex;
    for (int state = 0; state < base_.states; ++state) {
        const Gait* const gait = update.gaits.empty() ? nullptr : update.gaits[state];
        const std::vector<Real>& before = muscles_[state].spring_rest_length;
        std::copy(before.begin(), before.end(), rest_lengths_.data() + state * of_state);
        for (int k = 0; k < update.substeps; ++k) {
            const double end = update.start_time + update.time_step * (k + 1) / update.substeps;
            if (gait && (by_substep || k == 0))
                actuate(host_model_, *gait, by_substep ? end : update.start_time, muscles_[state]);
            const std::vector<Real>& lengths = muscles_[state].spring_rest_length;
            std::copy(lengths.begin(), lengths.end(), rest_lengths_.data() + state * of_state + (k + 1) * springs);
        }
    }
}

template <class Real>
LargeLaunch<Real> LargeRunner<Real>::launch_of(const Update& update, int substep) const {
    LargeLaunch<Real> launch = base_;
    launch.slots.substep = substep;
    launch.slots.h = static_cast<Real>(update.time_step) / static_cast<Real>(update.substeps);
    launch.slots.rest_lengths = device_rest_lengths_.data() + std::size_t(substep + 1) * base_.model.springs;
    launch.slots.rest_length_stride = std::size_t(update.substeps + 1) * base_.model.springs;
    return launch;
}

/// The first substeps of an update, whose rest lengths are there.
template <class Real>
void LargeRunner<Real>::launch_substeps(const Update& update, int substeps, StageClock* clock,
                                        const Trace<Real>& trace) const {
    check(cudaMemsetAsync(base_.slots.at.shared, 0xff, base_.states * sizeof(LargeShared<Real>), base_.stream), "clear");
    if (base_.keeps_forces)
        clear_rows(base_.slots.water.impulse_on, base_.slots.stride, base_.model.solids, base_.states, base_.stream);
    if (clock) clock->mark(Stage::load);
    for (int k = 0; k < substeps; ++k) {
        LargeLaunch<Real> substep = launch_of(update, k);
        substep.clock = clock;
        substep.trace = trace;
        launch_substep(substep);
        if (!update.settling) launch_work(substep);
    }
}

template <class Real>
void LargeRunner<Real>::launch(const Update& update, StageClock* clock, const Trace<Real>& trace) const {
    const std::size_t of_state = std::size_t(update.substeps + 1) * base_.model.springs;
    copy(device_rest_lengths_.data(), rest_lengths_.data(), of_state * base_.states, base_.stream);
    keep_before();
    launch_substeps(update, update.substeps, clock, trace);
    if (update.settling) launch_rest(base_);
    launch_measure(base_);
    copy(end_.data(), base_.slots.at.shared, base_.states, base_.stream);
    if (clock) clock->mark(Stage::measure);
}

template <class Real>
cudaGraphExec_t LargeRunner<Real>::graph_of(const Update& update) {
    std::unique_ptr<Graph>& graph = graphs_[{update.time_step, update.substeps, update.settling}];
    if (!graph) {
        graph = std::make_unique<Graph>();
        cudaGraph_t captured = nullptr;
        check(cudaStreamBeginCapture(base_.stream, cudaStreamCaptureModeThreadLocal), "capture");
        try {
            launch(update, nullptr, {});
        } catch (...) {  // a thread that goes on capturing could do nothing else
            cudaStreamEndCapture(base_.stream, &captured);
            throw;
        }
        check(cudaStreamEndCapture(base_.stream, &captured), "capture");
        check(cudaGraphInstantiate(&graph->exec, captured, 0), "graph");
        cudaGraphDestroy(captured);
    }
    return graph->exec;
}

template <class Real>
void LargeRunner<Real>::prepare(const Update& update) {
    const std::vector<State<Real>> muscles = muscles_;
    set_muscles(update);
    muscles_ = muscles;  // the update itself is still to come
    check(cudaGraphUpload(graph_of(update), base_.stream), "graph");
    wait();
}

template <class Real>
typename LargeRunner<Real>::End LargeRunner<Real>::end_of(int k) const {
    End end;
    end.mean_x = end_[k].mean_x;
    end.tail_z = end_[k].tail_z;
    end.muscle_work = end_[k].muscle_work;
    end.touches_plane = end_[k].touches != 0;
    if (end_[k].bad == none_bad) return end;
    end.finite = false;
    end.bad_substep = static_cast<int>(end_[k].bad >> 32);
    end.bad_particle = static_cast<int>(end_[k].bad & 0xffffffffu);
    return end;
}

template <class Real>
std::vector<typename LargeRunner<Real>::End> LargeRunner<Real>::run(const Update& update, StageProfile* profile,
                                                                    const Trace<Real>& trace) {
    set_muscles(update);
    std::optional<StageClock> clock;
    for (;;) {
        clock.reset();
        if (profile) clock.emplace(base_.stream);
        if (profile || trace.predicted)
            launch(update, clock ? &*clock : nullptr, trace);
        else
            check(cudaGraphLaunch(graph_of(update), base_.stream), "launch");
        wait();
        if (had_room()) break;
        for (int k = 0; k < base_.states; ++k) restore_before(k);  // and once more, with room for all neighbours
    }
    if (clock) clock->add_to(*profile);
    std::vector<End> ends;
    for (int k = 0; k < base_.states; ++k) ends.push_back(end_of(k));
    for (int k = 0; k < base_.states; ++k)
        if (!ends[k].finite) go_to(k, ends[k].bad_substep, update);
    return ends;
}

/// Takes State k, which `update` has changed, to the start of a substep of it.
template <class Real>
void LargeRunner<Real>::go_to(int k, int substep, const Update& update) {
    restore_before(k);
    wait();
    if (substep == 0) return;
    const std::vector<bool> idle(idle_.begin(), idle_.end());
    std::vector<bool> others(idle.size(), true);
    others[k] = false;
    set_idle(others);
    launch_substeps(update, substep, nullptr, {});
    wait();
    set_idle(idle);
}

template <class Real>
std::vector<typename LargeRunner<Real>::Place> LargeRunner<Real>::places() {
    launch_measure(base_);
    copy(end_.data(), base_.slots.at.shared, base_.states, base_.stream);
    wait();
    std::vector<Place> places;
    for (int k = 0; k < base_.states; ++k) places.push_back({end_[k].mean_x, end_[k].tail_z});
    return places;
}

template <class Real>
std::vector<Quad<Real>> LargeRunner<Real>::body_places() const {
    const DeviceBuffer<Quad<Real>> places(std::size_t(base_.states) * base_.model.body);
    launch_body_places(base_, places.data());
    wait();
    return places.download();
}

template <class Real>
std::vector<Real> LargeRunner<Real>::densities() const {
    if (!base_.model.plan.fluid && !base_.model.plan.water) return {};
    const DeviceBuffer<Real> densities(std::size_t(base_.states) * base_.model.fluid);
    launch_densities(base_, densities.data());
    wait();
    return densities.download();
}

template <class Real>
std::vector<int> LargeRunner<Real>::neighbour_counts() const {
    const DeviceBuffer<int> counts(std::size_t(base_.states) * base_.model.particles);
    launch_neighbour_counts(base_, counts.data());
    wait();
    return counts.download();
}

template <class Real>
std::vector<Real> LargeRunner<Real>::pressure_impulses() const {
    if (!base_.model.plan.water) return {};
    const DeviceBuffer<Real> impulses(std::size_t(base_.states) * base_.model.fluid);
    launch_pressure_impulses(base_, impulses.data());
    wait();
    return impulses.download();
}

template <class Real>
std::vector<Quad<Real>> LargeRunner<Real>::impulses_on_solids() const {
    if (!base_.keeps_forces) return {};
    const std::size_t solids = base_.model.solids;
    const DeviceBuffer<Quad<Real>> impulses(base_.states * solids);
    copy_rows(impulses.data(), solids * sizeof(Quad<Real>), base_.slots.water.impulse_on, base_.slots.stride, solids,
              base_.states, base_.stream);
    wait();
    return impulses.download();
}

template <class Real>
double LargeRunner<Real>::fetch_seconds(Fetch what) const {
    constexpr int launches = 20;
    const DeviceBuffer<Real> sums(std::size_t(base_.states) * base_.model.particles);
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < launches && base_.model.plan.water; ++k) {
        const Event start, end;
        start.record(base_.stream);
        launch_fetch(base_, what, sums.data());
        end.record(base_.stream);
        wait();
        least = std::min(least, end.seconds_since(start));
    }
    return least;
}

template class LargeRunner<float>;
template class LargeRunner<double>;

}  // namespace natator::cuda
