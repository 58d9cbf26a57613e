#pragma once

// One update of one State by a team of threads, scheme flex.
#include "batch_kernel.cuh"
#include "flex.cuh"
#include "measure.cuh"
#include "neighbours.cuh"
#include "physics/muscle.h"
#include "solver/step.h"

namespace natator::cuda {

/// Rest lengths as the State or the Model has them. Ends with a barrier.
template <class Real, class Block>
__device__ void rest(const BatchView<Real>& batch, int state, Block& block) {
    const ModelView<Real>& model = batch.model;
    for (int s = block.thread(); s < model.springs; s += block.size())
        block.rest_length()[s] =
            batch.rest_length ? batch.rest_length[state * model.springs + s] : model.spring[s].rest_length;
    block.barrier();
}

/// Ends with a barrier.
template <class Real, class Block>
__device__ void actuate(const ModelView<Real>& model, const GaitView& gait, int state, double time, Block& block) {
    if (!gait.frequency) return;
    for (int m = block.thread(); m < model.muscles; m += block.size()) {
        const MuscleView muscle = model.muscle[m];
        const int a = state * model.actuators + muscle.actuator;
        const double activation =
            physics::activation(gait.frequency[state], gait.power[state], gait.phase[a], time);
        double drive = gait.amplitude[a] * activation;
        if (gait.offset) drive += gait.offset[a];
        block.rest_length()[muscle.spring] =
            static_cast<Real>(physics::muscle_length(muscle.rest_length, muscle.lateral, drive));
    }
    block.barrier();
}

template <class Real, class Block>
__device__ void record(const Block& block, int particles, Quad<Real>* to, int row) {
    if (!to) return;
    for (int s = block.thread(); s < particles; s += block.size())
        to[static_cast<std::size_t>(row) * particles + s] =
            quad(xyz(block.position()[s]), as_number<Real>(block.number()[s]));
}

/// The stages of substep `number` of an update, by the threads of a block, with the code of effects or without.
template <bool with_effects, class R, class Block>
struct BlockStages {
    using Real = R;
    static constexpr Scheme scheme = Scheme::flex;
    static constexpr bool effects = with_effects;
    static constexpr Grouping grouping = Grouping::together;

    const ModelView<Real>& model;
    const Trace<Real>& trace;
    Block& block;
    int number;
    int iteration = 0;
    bool finite = true;  ///< of all velocities, before what acts behind them

    __device__ void predict() { cuda::predict(model, block); }
    __device__ void sort_into_cells() { cuda::sort_into_cells(model, block); }
    template <class AfterStage>
    __device__ void find_neighbours(const AfterStage&) {
        cuda::find_neighbours(model, block);
    }
    __device__ void begin_iterations() {
        if constexpr (effects)
            if (model.plan.dissipation) for_each(model.particles, [&](int s) { count_overlaps(model, block, s); });
    }
    __device__ void compute_density_and_fits() { compute_density(model, block, Real(0)); }
    __device__ void apply_corrections() {
        cuda::apply_corrections(model, block);
        block.barrier();
    }
    __device__ void update_velocities() {
        finite = cuda::update_velocities(model, block);
        finite = !block.any(!finite);
    }
    __device__ void damp_contacts() {
        for_each(model.particles, [&](int s) { damp(model, block, s); });
    }
    __device__ void drag_free_surface() {
        for_each(model.fluid, [&](int s) { drag(model, block, s); });
    }
    __device__ void apply_fluid_forces() {
        for_each(model.fluid, [&](int s) { measure_fluid(model, block, s); });
        for_each(model.fluid, [&](int s) { push_fluid_by_forces(model, block, s); });
    }
    __device__ void apply_adhesion() {
        for_each(model.particles, [&](int s) { cuda::apply_adhesion(model, block, s); });
    }
    __device__ void apply_restitution() {
        for_each(model.particles, [&](int s) { cuda::apply_restitution(model, block, s); });
    }
    __device__ void apply_sleep() {
        for_each(model.particles, [&](int s) { cuda::apply_sleep(model, block, s); });
    }

    /// Looks at all once more, if anything came behind the velocities.
    __device__ bool all_finite() {
        if constexpr (!effects) return finite;
        bool bad = false;
        for_each(model.particles, [&](int s) {
            const Vec3<Real> both = xyz(block.end_position()[s]) + velocity_of<Real>(block, s);
            bad |= !isfinite(both.x + both.y + both.z);
        });
        return !block.any(bad) && finite;
    }

    /// Ends with a barrier.
    template <class Work>
    __device__ void for_each(int count, const Work& work) {
        for (int s = block.thread(); s < count; s += block.size()) work(s);
        block.barrier();
    }
};

/// Books a block's time, and writes down what an observer sees.
template <class Stages>
struct AfterBlockStage {
    Stages& stages;
    __device__ void operator()(Stage stage) const {
        const int particles = stages.model.particles, iterations = stages.model.iterations;
        if (stage != Stage::iteration) stages.block.book(stage);
        if (stage == Stage::cells) record(stages.block, particles, stages.trace.predicted, stages.number);
        if (stage == Stage::iteration)
            record(stages.block, particles, stages.trace.iterated, stages.number * iterations + stages.iteration++);
    }
};

/// Particles of infinite mass keep their place. Ends with a barrier.
template <class Real, class Block>
__device__ void commit(const ModelView<Real>& model, const Trace<Real>& trace, Block& block, int number) {
    for (int s = block.thread(); s < model.particles; s += block.size()) {
        if (!(block.position()[s].w > 0)) block.position()[s] = block.start()[s];
        const Quad<Real> v = block.next_velocity()[s];
        block.velocity[s] = v;
        if (trace.velocity) trace.velocity[static_cast<std::size_t>(number) * model.particles + s] = v;
    }
    block.barrier();
}

/// Notes the lowest particle that is not finite, and gives the State its values from before the substep back.
template <class Real, class Block>
__device__ void note_instability(const ModelView<Real>& model, Block& block, double time, Progress& progress) {
    if (block.thread() == 0) {
        int lowest = model.particles;
        for (int s = 0; s < model.particles; ++s) {
            const Quad<Real> x = block.position()[s], v = block.next_velocity()[s];
            const bool finite = isfinite(x.x + x.y + x.z) && isfinite(v.x + v.y + v.z);
            if (!finite) lowest = min(lowest, static_cast<int>(block.number()[s]));
        }
        progress.stopped = static_cast<int>(StopReason::unstable);
        progress.bad_particle = lowest;
        progress.bad_time = time;
    }
    block.barrier();
    std::uint32_t* const slot_of = block.keys();
    for (int s = block.thread(); s < model.particles; s += block.size()) slot_of[block.number()[s]] = s;
    block.barrier();
    // Velocities are still in the order that slots had before the substep.
    for (int s = block.thread(); s < model.particles; s += block.size()) {
        block.position()[s] = block.start()[s];
        block.next_velocity()[slot_of[number_in(block.unsorted_position()[s].w)]] = block.velocity[s];
    }
    for (int k = block.thread(); k < model.clusters; k += block.size()) block.fit()[k] = block.fit_before()[k];
    block.barrier();
    for (int s = block.thread(); s < model.particles; s += block.size()) block.velocity[s] = block.next_velocity()[s];
    block.barrier();
}

/// What the last update of a State leaves for those who ask.
template <class Real, class Block>
__device__ void report(const BatchView<Real>& batch, int state, Block& block) {
    const ModelView<Real>& model = batch.model;
    if (batch.neighbours) {
        int* const counts = batch.neighbours + static_cast<std::size_t>(state) * model.particles;
        for (int s = block.thread(); s < model.particles; s += block.size())
            counts[block.number()[s]] = (s < model.fluid ? block.neighbour_count()[s] : 0) +
                                        (model.plan.contacts ? block.contact_count()[s] : 0);
    }
    if (!batch.density || !model.plan.fluid) return;
    compute_density(model, block, Real(-1));
    for (int s = block.thread(); s < model.fluid; s += block.size())
        batch.density[static_cast<std::size_t>(state) * model.fluid + block.number()[s]] = block.next()[s].w + 1;
}

/// Measures the frame that has ended and decides whether the State stops early. Ends with a barrier.
template <class Real, class Block>
__device__ void end_frame(const BatchView<Real>& batch, int state, int update, Block& block) {
    Progress& progress = batch.progress[state];
    double* const path = batch.path + static_cast<std::size_t>(state) * (batch.updates + 1);
    measure_path(batch.model, block, path + update + 1);
    const bool touches = batch.stop_at_planes && touches_plane(batch.model, block);
    if (block.thread() == 0) {
        progress.frames = update + 1;
        if (touches)
            progress.stopped = static_cast<int>(StopReason::touched_plane);
        else if (physics::without_progress(path, update + 1, batch.no_progress_frames))
            progress.stopped = static_cast<int>(StopReason::no_progress);
    }
    block.barrier();
}

/// Update `number` of a State.
template <bool effects, class Real, class Block>
__device__ void update(const BatchView<Real>& batch, int state, int number, Block& block) {
    const ModelView<Real>& model = batch.model;
    Quad<Real>* const position = batch.position + static_cast<std::size_t>(state) * model.particles;
    Quad<Real>* const velocity = batch.velocity + static_cast<std::size_t>(state) * model.particles;
    ClusterFit<Real>* const fit = batch.fit + state * model.clusters;
    Progress& progress = batch.progress[state];
    block.shared().watch.start(block.thread());
    block.velocity = velocity;
    for (int s = block.thread(); s < model.particles; s += block.size()) {
        const Quad<Real> x = position[s];
        const int i = number_in(x.w);
        block.position()[s] = quad(xyz(x), model.inverse_mass[i]);
        block.number()[s] = static_cast<std::uint16_t>(i);
        if (s >= model.fluid) block.slot_of_solid()[i - model.fluid] = static_cast<std::uint16_t>(s);
    }
    if (block.thread() == 0) block.position()[model.particles] = block.start()[model.particles] = far_away<Real>();
    for (int k = block.thread(); k < model.clusters; k += block.size()) block.fit()[k] = fit[k];
    block.h = static_cast<Real>(batch.time_step) / static_cast<Real>(batch.substeps);
    const bool last = number + 1 == batch.updates;
    const Trace<Real> trace = last ? batch.trace : Trace<Real>{};
    const double time = batch.start_time + (batch.settling ? 0 : number * batch.time_step);
    rest(batch, state, block);
    actuate(model, batch.gait, state, time, block);
    if (!batch.settling && number == 0)
        measure_path(model, block, batch.path + static_cast<std::size_t>(state) * (batch.updates + 1));
    block.book(Stage::load);

    for (int k = 0; k < batch.substeps; ++k) {
        using Stages = BlockStages<effects, Real, Block>;
        Stages stages{model, trace, block, k};
        natator::substep(stages, model.plan, {model.iterations}, AfterBlockStage<Stages>{stages});
        if (!stages.all_finite()) {
            note_instability(model, block, time + k * batch.time_step / batch.substeps, progress);
            break;
        }
        commit(model, trace, block, k);
        block.book(Stage::commit);
    }
    for (int s = block.thread(); s < model.particles; s += block.size()) {
        position[s] = quad(xyz(block.position()[s]), as_number<Real>(block.number()[s]));
        if (batch.settling) velocity[s] = {0, 0, 0, 0};
    }
    for (int k = block.thread(); k < model.clusters; k += block.size()) fit[k] = block.fit()[k];
    if (progress.stopped >= 0) return;
    if (!batch.settling) end_frame(batch, state, number, block);
    if (progress.stopped >= 0 || last) report(batch, state, block);
    block.book(Stage::measure);
}

}  // namespace natator::cuda
