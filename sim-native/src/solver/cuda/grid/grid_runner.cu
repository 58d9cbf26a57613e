#include "grid_runner.h"

#include <algorithm>
#include <limits>

#include "base/side_by_side.h"
#include "natator/model.h"
#include "rows.h"
#include "solver/cuda/event.h"

namespace natator::cuda {

template <class Real>
struct GridRunner<Real>::Graph {
    cudaGraphExec_t exec = nullptr;
    ~Graph() {
        if (exec) cudaGraphExecDestroy(exec);
    }
};

namespace {

/// What a stream was asked for while it captured.
struct CapturedGraph {
    cudaGraph_t graph = nullptr;
    ~CapturedGraph() {
        if (graph) cudaGraphDestroy(graph);
    }
};

}  // namespace

template <class Real>
GridRunner<Real>::GridRunner(const Model& model, int states, const GridOptions& options)
    : host_model_(model),
      device_model_(model, true),
      base_{.model = device_model_.view(),
            .states = states,
            .stream = stream_.get(),
            .keeps_forces = options.keeps_forces && device_model_.view().plan.water},
      memory_(model, device_model_, states, options, base_.stream),
      lattice_(LatticeBodies<Real>::of(model, states)),
      muscles_(states),
      end_(states) {
    base_.slots = memory_.slots();
    base_.scan_room = memory_.scan_room();
    launch_far_slot(base_);
    wait_for_uploads();  // the stream does not wait for the Model's by itself
}

template <class Real>
GridRunner<Real>::~GridRunner() = default;

template <class Real>
void GridRunner<Real>::make_room(ListRoom needed) {
    if (memory_.has_room(needed)) return;
    graphs_.clear();  // they know the old place
    memory_.make_room(needed);
    base_.slots = memory_.slots();
}

/// Was there room for what the last update found? If not, makes more than that.
template <class Real>
bool GridRunner<Real>::had_room() {
    ListRoom needed;
    for (int k = 0; k < base_.states; ++k) {
        needed.lists = std::max(needed.lists, end_[k].needed.lists);
        needed.copies = std::max(needed.copies, end_[k].needed.copies);
    }
    if (memory_.has_room(needed)) return true;
    const int share = base_.model.plan.water ? 8 : 4;  // all slots of the water together vary less than a particle does
    make_room({needed.lists + needed.lists / share, needed.copies + needed.copies / share});
    return false;
}

template <class Real>
void GridRunner<Real>::wait() const {
    check(cudaStreamSynchronize(base_.stream), "run");
}

/// Without a processor, which others may need meanwhile.
template <class Real>
void GridRunner<Real>::wait_asleep() const {
    const Event end(cudaEventBlockingSync | cudaEventDisableTiming);
    end.record(base_.stream);
    end.wait();
}

template <class Real>
void GridRunner<Real>::upload(int k, const State<Real>& state) {
    memory_.upload(k, state);
    muscles_[k].spring_rest_length = state.spring_rest_length;
}

template <class Real>
void GridRunner<Real>::upload_all(const std::vector<const State<Real>*>& states) {
    memory_.upload_all(states);
    for (std::size_t k = 0; k < states.size(); ++k) muscles_[k].spring_rest_length = states[k]->spring_rest_length;
}

template <class Real>
void GridRunner<Real>::download_all(const std::vector<State<Real>*>& states) {
    memory_.download_all(states);
    for (std::size_t k = 0; k < states.size(); ++k) states[k]->spring_rest_length = muscles_[k].spring_rest_length;
}

/// Scheme flex sets the muscles once for a frame, the others for the end of every substep.
template <class Real>
void GridRunner<Real>::set_muscles(const Update& update) {
    const std::size_t springs = base_.model.springs, of_state = springs * (update.substeps + 1);
    const std::size_t size = of_state * base_.states;
    if (size > rest_lengths_.size()) {
        graphs_.clear();  // they know the old place
        rest_lengths_ = HostBuffer<Real>(size);
        device_rest_lengths_ = DeviceBuffer<Real>(size);
    }
    const bool by_substep = base_.model.scheme != Scheme::flex;
    side_by_side(
        base_.states,
        [&](std::size_t state) {
            const Muscles* const by =
                update.muscles.empty() || memory_.is_idle(static_cast<int>(state)) ? nullptr : &update.muscles[state];
            const std::vector<Real>& before = muscles_[state].spring_rest_length;
            std::copy(before.begin(), before.end(), rest_lengths_.data() + state * of_state);
            for (int k = 0; k < update.substeps; ++k) {
                if (by && (by_substep || k == 0)) {
                    const double end = by->start_time + update.time_step * (k + 1) / update.substeps;
                    const double time = by_substep ? end : by->start_time;
                    actuate(host_model_, by->drive(time), time, muscles_[state]);
                }
                const std::vector<Real>& lengths = muscles_[state].spring_rest_length;
                std::copy(lengths.begin(), lengths.end(), rest_lengths_.data() + state * of_state + (k + 1) * springs);
            }
        },
        base_.states / short_calls + 1);
}

template <class Real>
GridLaunch<Real> GridRunner<Real>::launch_of(const Update& update, int substep) const {
    GridLaunch<Real> launch = base_;
    launch.slots.substep = substep;
    launch.slots.h = static_cast<Real>(update.time_step) / static_cast<Real>(update.substeps);
    launch.slots.rest_lengths = device_rest_lengths_.data() + std::size_t(substep + 1) * base_.model.springs;
    launch.slots.rest_length_stride = std::size_t(update.substeps + 1) * base_.model.springs;
    return launch;
}

/// The first substeps of an update, whose rest lengths are there.
template <class Real>
void GridRunner<Real>::launch_substeps(const Update& update, int substeps, StageClock* clock,
                                       const Trace<Real>& trace) const {
    check(cudaMemsetAsync(base_.slots.arrays.shared, 0xff, base_.states * sizeof(GridShared<Real>), base_.stream),
          "clear");
    if (base_.keeps_forces)
        clear_rows(base_.slots.water.impulse_on, base_.slots.stride, base_.model.solids, base_.states, base_.stream);
    if (clock) clock->mark(Stage::load);
    for (int k = 0; k < substeps; ++k) {
        GridLaunch<Real> substep = launch_of(update, k);
        substep.clock = clock;
        substep.trace = trace;
        if (lattice_) {
            memory_.keep_running(substep);
            lattice_->launch_push(substep);
        }
        launch_substep(substep);
        if (!update.settling) launch_work(substep);
        if (!lattice_) continue;
        lattice_->launch_follow(substep);
        substep.mark(Stage::water_motion);
    }
}

template <class Real>
void GridRunner<Real>::launch(const Update& update, StageClock* clock, const Trace<Real>& trace) const {
    const std::size_t of_state = std::size_t(update.substeps + 1) * base_.model.springs;
    copy_row(device_rest_lengths_.data(), rest_lengths_.data(), of_state * base_.states, base_.stream);
    if (lattice_)
        lattice_->launch_upload(base_);
    else
        memory_.keep_before();
    launch_substeps(update, update.substeps, clock, trace);
    if (lattice_) lattice_->launch_download(base_);
    if (update.settling) launch_rest(base_);
    launch_measure(base_);
    copy_row(end_.data(), base_.slots.arrays.shared, base_.states, base_.stream);
    if (clock) clock->mark(Stage::measure);
}

template <class Real>
cudaGraphExec_t GridRunner<Real>::graph_of(const Update& update) {
    std::unique_ptr<Graph>& known = graphs_[{update.time_step, update.substeps, update.settling}];
    if (known) return known->exec;
    CapturedGraph captured;
    check(cudaStreamBeginCapture(base_.stream, cudaStreamCaptureModeThreadLocal), "capture");
    try {
        launch(update, nullptr, {});
    } catch (...) {  // a thread that goes on capturing could do nothing else
        cudaStreamEndCapture(base_.stream, &captured.graph);
        throw;
    }
    check(cudaStreamEndCapture(base_.stream, &captured.graph), "capture");
    auto graph = std::make_unique<Graph>();
    check(cudaGraphInstantiate(&graph->exec, captured.graph, cudaGraphInstantiateFlagUseNodePriority), "graph");
    known = std::move(graph);
    return known->exec;
}

template <class Real>
void GridRunner<Real>::prepare(const Update& update) {
    const std::vector<State<Real>> muscles = muscles_;
    set_muscles(update);
    muscles_ = muscles;  // the update itself is still to come
    check(cudaGraphUpload(graph_of(update), base_.stream), "graph");
    wait();
}

template <class Real>
physics::LawMeasures GridRunner<Real>::laws_of(int k) const {
    physics::LawMeasures all;
    for (int block = 0; block < law_blocks(base_.model.particles); ++block) physics::add(all, end_[k].laws[block]);
    return all;
}

template <class Real>
typename GridRunner<Real>::End GridRunner<Real>::end_of(int k) const {
    End end;
    end.laws = laws_of(k);
    end.mean_x = end_[k].mean_x;
    end.tail_z = end_[k].tail_z;
    end.muscle_work.assign(end_[k].muscle_work, end_[k].muscle_work + base_.model.swimmers);
    end.touches_plane = end_[k].touches != 0;
    if (end_[k].bad == none_bad) return end;
    end.finite = false;
    end.fault = end_[k].fault;
    end.bad_substep = static_cast<int>(end_[k].bad >> 32);
    end.bad_particle = static_cast<int>(end_[k].bad & 0xffffffffu);
    return end;
}

template <class Real>
std::vector<typename GridRunner<Real>::End> GridRunner<Real>::run(const Update& update, StageProfile* profile,
                                                                  const Trace<Real>& trace) {
    std::optional<Turns::Turn> turn(update.turns ? &update.turns->preparing : nullptr);
    if (!update.from.empty()) upload_all(update.from);
    set_muscles(update);
    std::optional<StageClock> clock;
    if (lattice_) lattice_->stage();
    turn.emplace(update.turns ? &update.turns->computing : nullptr);
    for (;;) {
        clock.reset();
        if (profile) clock.emplace(base_.stream);
        if (profile || trace.predicted)
            launch(update, clock ? &*clock : nullptr, trace);
        else
            check(cudaGraphLaunch(graph_of(update), base_.stream), "launch");
        update.turns ? wait_asleep() : wait();
        if (had_room()) break;
        for (int k = 0; k < base_.states; ++k)
            memory_.restore_before(k);  // and once more, with room for all neighbours
    }
    turn.reset();
    if (lattice_) lattice_->take_back();
    if (clock) clock->add_to(*profile);
    std::vector<End> ends;
    for (int k = 0; k < base_.states; ++k) ends.push_back(end_of(k));
    for (int k = 0; k < base_.states; ++k)
        if (!ends[k].finite && ends[k].fault == fault_of_body) go_to(k, ends[k].bad_substep, update);
    return ends;
}

/// Takes State k, which `update` has changed, to the start of a substep of it.
template <class Real>
void GridRunner<Real>::go_to(int k, int substep, const Update& update) {
    memory_.restore_before(k);
    wait();
    if (substep == 0 || lattice_) return;
    const std::vector<bool> idle = memory_.idle();
    std::vector<bool> others(idle.size(), true);
    others[k] = false;
    memory_.set_idle(others);
    launch_substeps(update, substep, nullptr, {});
    wait();
    memory_.set_idle(idle);
}

template <class Real>
std::vector<typename GridRunner<Real>::Place> GridRunner<Real>::places() {
    launch_measure(base_);
    copy_row(end_.data(), base_.slots.arrays.shared, base_.states, base_.stream);
    wait();
    std::vector<Place> places;
    for (int k = 0; k < base_.states; ++k) places.push_back({end_[k].mean_x, end_[k].tail_z, laws_of(k)});
    return places;
}

template <class Real>
std::vector<Vec4<Real>> GridRunner<Real>::body_places() const {
    const DeviceBuffer<Vec4<Real>> places(std::size_t(base_.states) * base_.model.body);
    launch_body_places(base_, places.data());
    wait();
    return places.download();
}

template <class Real>
std::vector<Real> GridRunner<Real>::densities() {
    if (!base_.model.plan.fluid && !base_.model.plan.water) return {};
    const std::size_t size = std::size_t(base_.states) * base_.model.fluid;
    if (densities_.size() == 0) {
        device_densities_ = DeviceBuffer<Real>(size);
        densities_ = HostBuffer<Real>(size);
    }
    launch_densities(base_, device_densities_.data());
    copy_row(densities_.data(), device_densities_.data(), size, base_.stream);
    wait();
    return {densities_.data(), densities_.data() + size};
}

template <class Real>
std::vector<int> GridRunner<Real>::neighbour_counts() const {
    const DeviceBuffer<int> counts(std::size_t(base_.states) * base_.model.particles);
    launch_neighbour_counts(base_, counts.data());
    wait();
    return counts.download();
}

template <class Real>
std::vector<Real> GridRunner<Real>::pressures(Real h) const {
    if (!base_.model.plan.water) return {};
    const DeviceBuffer<Real> pressures(std::size_t(base_.states) * base_.model.fluid);
    GridLaunch<Real> launch = base_;
    launch.slots.h = h;
    launch_pressures(launch, pressures.data());
    wait();
    return pressures.download();
}

template <class Real>
std::vector<Vec4<Real>> GridRunner<Real>::impulses_on_solids() const {
    if (!base_.keeps_forces) return {};
    const std::size_t solids = base_.model.solids;
    const DeviceBuffer<Vec4<Real>> impulses(base_.states * solids);
    copy_rows(impulses.data(), solids * sizeof(Vec4<Real>), base_.slots.water.impulse_on, base_.slots.stride, solids,
              base_.states, base_.stream);
    wait();
    return impulses.download();
}

template <class Real>
double GridRunner<Real>::fetch_seconds(Fetch what) const {
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

template class GridRunner<float>;
template class GridRunner<double>;

}  // namespace natator::cuda
