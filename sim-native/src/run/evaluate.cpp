#include "natator/evaluate.h"

#include <algorithm>
#include <cmath>

#include "companions.h"
#include "conservation_errors.h"
#include "laws.h"
#include "natator/cost.h"
#include "natator/measure.h"
#include "natator/model.h"
#include "perturb.h"
#include "physics/laws.h"
#include "settled_start.h"
#include "swim_record.h"

namespace natator {
namespace {

template <class Real>
void observe(const Body& body, const State<Real>& state, const FrameObserver& on_frame) {
    if (!on_frame) return;
    on_frame(state.time, body_places(body, state));
}

template <class Real>
Snapshot snapshot_of(const State<Real>& state, const std::vector<Real>& densities) {
    Snapshot snapshot;
    snapshot.time = state.time;
    for (const auto& position : state.position) snapshot.position.push_back(position.template cast<double>());
    for (const auto& velocity : state.velocity) snapshot.velocity.push_back(velocity.template cast<double>());
    snapshot.density.assign(densities.begin(), densities.end());
    return snapshot;
}

/// What a SwimRecord asks about a State.
template <class Real>
SwimRecord::Frame frame_of(const Model& model, const State<Real>& state, bool stops_at_planes, bool needs_body) {
    SwimRecord::Frame frame;
    frame.mean_x = mean_x(model.body, state);
    frame.tail_z = tail_z(model.body, state);
    frame.touches_plane = stops_at_planes && touches_plane(model, state);
    if (needs_body) frame.body = body_places_in_tank(model.body, state);
    return frame;
}

/// Runs frame by frame to the duration or an early stop, from the places of `start`: the model, or the model perturbed.
template <class Real>
Evaluation evaluate_as(const Scene& scene, const Model& model, const Model& start, const Gait& gait,
                       const EvaluationOptions& options) {
    const SnapshotRequest& snapshot = options.snapshot;
    const auto frames = static_cast<int>(std::lround(scene.duration / scene.time_step));

    SwimRecord record(scene, model);
    Solver<Real> solver(model, options.execution);
    const SettledStateCache* starts = options.execution.starts;
    Evaluation result;
    if (frames == 0) starts = nullptr;  // the figures of a run without frames are those of settling
    State<Real> state = settled_start(start, scene.settling, solver, starts, result.instability);
    LawWatch laws(model);
    laws.drive_by(gait);
    if (!result.instability) result.instability = laws.start(measure_laws(model, state));
    if (!result.instability) observe(model.body, state, options.on_frame);

    const State<Real> begin = model.companions.empty() ? State<Real>{} : state;
    bool snapshot_due = static_cast<bool>(snapshot.take);
    const bool stops_at_planes = scene.stopping.plane_contact;
    record.start(frame_of(model, state, false, record.needs_body()));
    while (!result.instability && result.stopped == StopReason::completed && result.frames < frames) {
        result.instability = solver.frame(state, gait);
        if (result.instability) break;
        state.time = ++result.frames * scene.time_step;  // free of summed rounding
        result.instability = laws.look(measure_laws(model, state), solver.muscle_work(), state.time);
        if (result.instability) break;
        const auto over = record.add(frame_of(model, state, stops_at_planes, record.needs_body()));
        if (over) result.stopped = *over;
        state.origin = record.origin();
        observe(model.body, state, options.on_frame);
        const bool last = over || result.frames == frames;
        if (snapshot_due && (snapshot.at ? state.time > *snapshot.at - scene.time_step / 1000 : last)) {
            snapshot_due = false;
            snapshot.take(model, snapshot_of(state, solver.densities()));
        }
        if (record.tank_is_due()) {
            const Vector3<Real> before = state.position.front();
            record.move_tank(state);
            solver.shift_water((before - state.position.front()).template cast<double>());
            laws.begin_anew();
        }
    }
    const std::vector<Real> densities = solver.densities();
    if (!result.instability) {
        result.errors = conservation_errors(model, state, densities);
        result.instability = laws.look_at_compression(result.errors.density_error_mean, state.time);
    }
    result.distance = record.path().back() - record.path().front();
    result.simulated = result.frames * scene.time_step;
    if (result.instability) {
        result.stopped = StopReason::unstable;
    } else {
        result.swimming = swimming_numbers(
            model, gait, scene.through_water(result.distance, result.simulated), result.simulated, record.tail());
        if (result.swimming) result.swimming->cavities = cavities(model, state, densities);
        if (has_muscle_work(model)) result.work = solver.muscle_work();
        if (!model.body.particles.empty()) result.course = course_of(model, model.body, state, result.distance);
        result.companions = companion_results(scene, model, begin, state);
        record.tell(result);
    }
    result.hash = state_hash(state);
    return result;
}

}  // namespace

double Evaluation::fitness() const {
    if (instability) return 0;
    if (goals.empty()) return distance;
    double sum = 0;
    for (const GoalResult& goal : goals) sum += goal.weight * goal.score;
    return sum;
}

Evaluation evaluate(const Scene& scene, const Gait& gait, const EvaluationOptions& options) {
    check_gait(gait, scene.creature ? scene.creature->actuators() : 0);
    const Model model = build_model(scene);
    check_evaluation_cost(scene, model, {.doubles = options.precision == Precision::double_precision, .several_threads = options.execution.threads > 1});
    Model start = model;  // volumes, and all else that is measured at rest, are those of the model
    perturb(options.perturbation, start);
    EvaluationOptions own = options;
    if (options.perturbation.amplitude != 0) own.execution.starts = nullptr;  // such starts are as many as seeds
    return options.precision == Precision::double_precision ? evaluate_as<double>(scene, model, start, gait, own)
                                                            : evaluate_as<float>(scene, model, start, gait, own);
}

}  // namespace natator
