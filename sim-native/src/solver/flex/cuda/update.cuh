#pragma once

// One update of one State by a team of threads, scheme flex.
#include "batch_kernel.cuh"
#include "flex.cuh"
#include "physics/muscle.h"
#include "solids_on_chip.cuh"
#include "solver/cuda/laws.cuh"
#include "solver/cuda/measure.cuh"
#include "solver/cuda/neighbours.cuh"
#include "solver/step.h"

namespace natator::cuda {

/// Rest lengths as the State or the Model has them, by the threads that have the springs. Ends with a barrier of them.
template <class Real, class Team>
__device__ void rest(const BatchView<Real>& batch, int state, Team& team) {
    const ModelView<Real>& model = batch.model;
    for (int s = team.solid_thread(); s < model.springs; s += team.solid_threads())
        team.rest_length()[s] =
            batch.rest_length ? batch.rest_length[state * model.springs + s] : model.spring[s].rest_length;
    team.solid_barrier();
}

/// Sets the muscles for update `number`, likewise.
template <class Real, class Team>
__device__ void actuate(const BatchView<Real>& batch, int state, int number, double time, Team& team) {
    const ModelView<Real>& model = batch.model;
    const GaitView& gait = batch.gait;
    if (!gait.frequency && !batch.muscle_length) return;
    for (int m = team.solid_thread(); m < model.muscles; m += team.solid_threads()) {
        const MuscleView muscle = model.muscle[m];
        if (batch.muscle_length) {
            const std::size_t row = static_cast<std::size_t>(state) * batch.updates + number;
            team.rest_length()[muscle.spring] = batch.muscle_length[row * model.muscles + m];
            continue;
        }
        const int a = state * model.actuators + muscle.actuator;
        const double activation = physics::activation(gait.frequency[state], gait.power[state], gait.phase[a], time);
        const double drive =
            physics::muscle_drive(gait.amplitude[a], activation, gait.offset ? gait.offset + a : nullptr);
        team.rest_length()[muscle.spring] =
            static_cast<Real>(physics::muscle_length(muscle.rest_length, muscle.lateral, drive));
    }
    team.solid_barrier();
}

template <class Real, class Team>
__device__ void record(const Team& team, int particles, Vec4<Real>* to, int row) {
    if (!to) return;
    for (int s = team.thread(); s < particles; s += team.size())
        to[static_cast<std::size_t>(row) * particles + s] =
            quad(xyz(team.position()[s]), as_number<Real>(team.number()[s]));
}

/// The stages of substep `number` of an update, by the threads of a team, with the code of effects or without.
template <bool with_effects, class R, class Team>
struct TeamStages {
    using Real = R;
    static constexpr Scheme scheme = Scheme::flex;
    static constexpr bool effects = with_effects;
    static constexpr Grouping grouping = Grouping::fused;

    const ModelView<Real>& model;
    const Trace<Real>& trace;
    Team& team;
    int number;
    int iteration = 0;
    /// tasks that the slots with contacts make, where a team has several blocks; a slot each where threads share
    int contact_tasks = 0;
    bool finite = true;  ///< of all velocities, before what acts behind them

    __device__ void predict() { cuda::predict(model, team); }
    __device__ void sort_into_cells() { cuda::sort_into_cells(model, team); }
    template <class AfterStage>
    __device__ void find_neighbours(const AfterStage&) {
        if constexpr (Team::shares_slots)
            find_neighbours_by_lanes(model, team);
        else
            cuda::find_neighbours(model, team);
    }
    __device__ void begin_iterations() {
        if constexpr (Team::of_several_blocks) {
            contact_tasks =
                Team::shares_slots ? team.shared().contact_slot_count : contact_task_count<Real>(model, team);
            if (team.has_solids())
                load_solids(model, team);
            else if constexpr (Team::shares_slots)
                load_contacts(model, team, contact_tasks);
        }
        if constexpr (effects)
            if (model.plan.dissipation) for_each(model.particles, [&](int s) { count_overlaps(model, team, s); });
    }
    __device__ void compute_density_and_fits() {
        if constexpr (Team::of_several_blocks)
            if (team.splits_solids()) return compute_density_beside_solids(model, team, contact_tasks);
        if constexpr (!Team::shares_slots) compute_density(model, team);  // those always split
    }
    __device__ void apply_corrections() {
        correct();
        if constexpr (Team::of_several_blocks)
            if (team.has_solids()) return team.arrive();
        team.barrier();
    }
    __device__ void correct() {
        if constexpr (Team::of_several_blocks)
            if (team.splits_solids()) return apply_corrections_beside_solids(model, team);
        if constexpr (!Team::shares_slots) cuda::apply_corrections(model, team);
    }
    __device__ void update_velocities() {
        wait_for_fluid();
        clear_cells(model, team);
        if constexpr (Team::shares_slots)
            finite = update_velocities_by_lanes(model, team);
        else
            finite = cuda::update_velocities(model, team);
        finite = !team.any(!finite);
    }
    /// The block of the solids went through the iterations without waiting for the others' corrections.
    __device__ void wait_for_fluid() {
        if constexpr (Team::of_several_blocks)
            if (team.has_solids()) team.wait();
    }
    __device__ void damp_contacts() {
        for_each(model.particles, [&](int s) { damp(model, team, s); });
    }
    __device__ void drag_free_surface() {
        for_each(model.fluid, [&](int s) { drag(model, team, s); });
    }
    __device__ void apply_fluid_forces() {
        for_each(model.fluid, [&](int s) { measure_fluid(model, team, s); });
        for_each(model.fluid, [&](int s) { push_fluid_by_forces(model, team, s); });
    }
    __device__ void apply_adhesion() {
        for_each(model.particles, [&](int s) { cuda::apply_adhesion(model, team, s); });
    }
    __device__ void apply_restitution() {
        for_each(model.particles, [&](int s) { cuda::apply_restitution(model, team, s); });
    }
    __device__ void apply_sleep() {
        for_each(model.particles, [&](int s) { cuda::apply_sleep(model, team, s); });
    }

    /// Looks at all once more, if anything came behind the velocities.
    __device__ bool all_finite() {
        if constexpr (!effects) return finite;
        bool bad = false;
        for_each(model.particles, [&](int s) {
            const Vec3<Real> both = xyz(team.end_position()[s]) + velocity_of<Real>(team, s);
            bad |= !isfinite(both.x + both.y + both.z);
        });
        return !team.any(bad) && finite;
    }

    /// Ends with a barrier.
    template <class Work>
    __device__ void for_each(int count, const Work& work) {
        for (int s = team.thread(); s < count; s += team.size()) work(s);
        team.barrier();
    }
};

/// Books a team's time, and writes down what an observer sees.
template <class Stages>
struct AfterTeamStage {
    Stages& stages;
    __device__ void operator()(Stage stage) const {
        const int particles = stages.model.particles, iterations = stages.model.iterations;
        if (stage != Stage::iteration) stages.team.book(stage);
        if (stage == Stage::cells) record(stages.team, particles, stages.trace.predicted, stages.number);
        if (stage == Stage::iteration && stages.trace.iterated) {
            stages.wait_for_fluid();
            record(stages.team, particles, stages.trace.iterated, stages.number * iterations + stages.iteration++);
            stages.team.barrier();
        }
    }
};

/// Particles of infinite mass keep their place.
template <class Real, class Team>
__device__ void commit(const ModelView<Real>& model, const Trace<Real>& trace, Team& team, int number) {
    for (int s = team.thread(); s < model.particles; s += team.size()) {
        if (!(team.position()[s].w > 0)) team.position()[s] = team.start()[s];
        const Vec4<Real> v = team.scratch_velocity()[s];
        team.velocity[s] = v;
        if (trace.velocity) trace.velocity[static_cast<std::size_t>(number) * model.particles + s] = v;
    }
}

/// Notes the lowest particle that is not finite, and gives the State its values from before the substep back.
template <class Real, class Team>
__device__ void note_instability(const ModelView<Real>& model, Team& team, double time, Progress& progress) {
    if (team.thread() == 0) {
        int lowest = model.particles;
        for (int s = 0; s < model.particles; ++s) {
            const Vec4<Real> x = team.position()[s], v = team.scratch_velocity()[s];
            const bool finite = isfinite(x.x + x.y + x.z) && isfinite(v.x + v.y + v.z);
            if (!finite) lowest = min(lowest, static_cast<int>(team.number()[s]));
        }
        progress.stopped = static_cast<int>(StopReason::unstable);
        progress.bad_particle = lowest;
        progress.bad_time = time;
    }
    team.barrier();
    std::uint32_t* const slot_of = team.keys();
    for (int s = team.thread(); s < model.particles; s += team.size()) slot_of[team.number()[s]] = s;
    team.barrier();
    // Velocities are still in the order that slots had before the substep.
    for (int s = team.thread(); s < model.particles; s += team.size()) {
        team.position()[s] = team.start()[s];
        team.scratch_velocity()[slot_of[number_in(team.unsorted_position()[s].w)]] = team.velocity[s];
    }
    for (int k = team.thread(); k < model.clusters; k += team.size()) team.fit()[k] = team.fit_before()[k];
    team.barrier();
    for (int s = team.thread(); s < model.particles; s += team.size()) team.velocity[s] = team.scratch_velocity()[s];
    team.barrier();
}

/// What the last update of a State leaves for those who ask.
template <class Real, class Team>
__device__ void report(const BatchView<Real>& batch, int state, Team& team) {
    const ModelView<Real>& model = batch.model;
    if (batch.neighbours) {
        int* const counts = batch.neighbours + static_cast<std::size_t>(state) * model.particles;
        for (int s = team.thread(); s < model.particles; s += team.size())
            counts[team.number()[s]] =
                (s < model.fluid ? team.neighbour_count()[s] : 0) + (model.plan.contacts ? team.contact_count()[s] : 0);
    }
    if (!batch.density || !model.plan.fluid) return;
    for (int s = team.thread(); s < model.fluid; s += team.size())
        batch.density[static_cast<std::size_t>(state) * model.fluid + team.number()[s]] =
            compression_of(model, team, s, xyz(team.position()[s])) + 1;
}

/// Notes the law that a State has broken at the end of a frame, or of settling, if there is one. Begins and ends with a
/// barrier.
template <class Real, class Team>
__device__ void look_at_laws(const BatchView<Real>& batch, int state, double time, Team& team) {
    team.barrier();
    if (!batch.limits) return;
    const ModelView<Real>& model = batch.model;
    const physics::LawLimits limits = batch.limits[state];
    const auto measured = [&](int s) {
        const Vec3<Real> v = batch.settling ? Vec3<Real>{} : xyz(team.velocity[s]);
        return measures_of(model, team.number()[s], team.position()[s], v);
    };
    bool bad = false;
    for (int s = team.thread(); s < model.particles; s += team.size())
        bad |= breach(measured(s), limits).law != physics::Law::none;
    for (int b = team.thread(); b < model.body; b += team.size())
        bad |= breach(reach_of(model, team, b), limits).law != physics::Law::none;
    if (!team.any(bad)) return;
    if (team.thread() == 0) {
        physics::LawMeasures all;
        for (int s = 0; s < model.particles; ++s) add(all, measured(s));
        for (int b = 0; b < model.body; ++b) add(all, reach_of(model, team, b));
        const physics::Breach found = breach(all, limits);
        Progress& progress = batch.progress[state];
        progress.stopped = static_cast<int>(StopReason::unstable);
        progress.broken = found.law;
        progress.bad_particle = found.particle;
        progress.bad_time = time;
    }
    team.barrier();
}

/// Measures the frame that has ended and decides whether the State stops early. Ends with a barrier.
template <class Real, class Team>
__device__ void end_frame(const BatchView<Real>& batch, int state, int update, Team& team) {
    look_at_laws(batch, state, batch.start_time + (update + 1) * batch.time_step, team);
    Progress& progress = batch.progress[state];
    double* const path = batch.path + static_cast<std::size_t>(state) * (batch.updates + 1);
    measure_path(batch.model, team, path + update + 1);
    const bool touches = batch.stop_at_planes && touches_plane(batch.model, team);
    if (team.thread() == 0) {
        progress.frames = update + 1;
        if (progress.stopped >= 0)
            ;  // unstable
        else if (touches)
            progress.stopped = static_cast<int>(StopReason::touched_plane);
        else if (physics::without_progress(path, update + 1, batch.no_progress_frames))
            progress.stopped = static_cast<int>(StopReason::no_progress);
    }
    team.barrier();
}

/// Update `number` of a State.
template <bool effects, class Real, class Team>
__device__ void update(const BatchView<Real>& batch, int state, int number, Team& team) {
    const ModelView<Real>& model = batch.model;
    Vec4<Real>* const position = batch.position + static_cast<std::size_t>(state) * model.particles;
    Vec4<Real>* const velocity = batch.velocity + static_cast<std::size_t>(state) * model.particles;
    ClusterFit<Real>* const fit = batch.fit + state * model.clusters;
    Progress& progress = batch.progress[state];
    team.shared().watch.start(team.thread());
    team.velocity = velocity;
    for (int s = team.thread(); s < model.particles; s += team.size()) {
        const Vec4<Real> x = position[s];
        const int i = number_in(x.w);
        team.position()[s] = quad(xyz(x), model.inverse_mass[i]);
        team.number()[s] = static_cast<std::uint16_t>(i);
        if (s >= model.fluid) team.slot_of_solid()[i - model.fluid] = static_cast<std::uint16_t>(s);
    }
    if (team.thread() == 0)
        team.position()[model.particles] = team.start()[model.particles] = team.scratch_position()[model.particles] =
            far_away<Real>();
    for (int k = team.thread(); k < model.clusters; k += team.size()) team.fit()[k] = fit[k];
    team.h = static_cast<Real>(batch.time_step) / static_cast<Real>(batch.substeps);
    const bool last = number + 1 == batch.updates;
    const Trace<Real> trace = last ? batch.trace : Trace<Real>{};
    const double time = batch.start_time + (batch.settling ? 0 : number * batch.time_step);
    if (!team.splits_solids() || team.has_solids()) {
        rest(batch, state, team);
        actuate(batch, state, number, time, team);
        if constexpr (Team::of_several_blocks) load_constraints_of_solids(model, team);
    }
    if (!batch.settling && number == 0) {
        team.barrier();
        measure_path(model, team, batch.path + static_cast<std::size_t>(state) * (batch.updates + 1));
    }
    team.book(Stage::load);

    for (int k = 0; k < batch.substeps; ++k) {
        using Stages = TeamStages<effects, Real, Team>;
        Stages stages{model, trace, team, k};
        natator::substep(stages, model.plan, {model.iterations}, AfterTeamStage<Stages>{stages});
        if (!stages.all_finite()) {
            note_instability(model, team, time + k * batch.time_step / batch.substeps, progress);
            break;
        }
        commit(model, trace, team, k);
        team.book(Stage::commit);
    }
    for (int s = team.thread(); s < model.particles; s += team.size()) {
        position[s] = quad(xyz(team.position()[s]), as_number<Real>(team.number()[s]));
        if (batch.settling) velocity[s] = {0, 0, 0, 0};
    }
    for (int k = team.thread(); k < model.clusters; k += team.size()) fit[k] = team.fit()[k];
    if (progress.stopped >= 0) return;
    if (!batch.settling) end_frame(batch, state, number, team);
    if (batch.settling && last) look_at_laws(batch, state, 0, team);
    if (progress.stopped >= 0 || last) report(batch, state, team);
    team.book(Stage::measure);
}

}  // namespace natator::cuda
