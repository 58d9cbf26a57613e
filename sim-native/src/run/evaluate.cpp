#include "natator/evaluate.h"

#include "evaluation_run.h"
#include "move_tank.h"
#include "natator/cost.h"
#include "natator/measure.h"
#include "natator/model.h"
#include "perturb.h"
#include "settled_start.h"

namespace natator {
namespace {

template <class Real>
Snapshot snapshot_of(const State<Real>& state, const std::vector<Real>& densities) {
    Snapshot snapshot;
    snapshot.time = state.time;
    for (const auto& position : state.position) snapshot.position.push_back(position.template cast<double>());
    for (const auto& velocity : state.velocity) snapshot.velocity.push_back(velocity.template cast<double>());
    snapshot.density.assign(densities.begin(), densities.end());
    return snapshot;
}

/// A State that run_frames advances on the CPU.
template <class Real>
class CpuStepper {
public:
    /// `needs_body`: see EvaluationRun.
    CpuStepper(const Scene& scene, const Model& model, const Gait& gait, const EvaluationOptions& options,
               bool needs_body)
        : scene_(scene),
          model_(model),
          gait_(gait),
          options_(options),
          solver_(model, execution()),
          needs_body_(needs_body),
          snapshot_due_(static_cast<bool>(options.snapshot.take)) {}

    /// Takes the State to its settled start.
    void settle(const Model& start, const SettledStateCache* starts) {
        state_ = settled_start(start, scene_.settling, solver_, starts, unsettled_);
        settled_ = true;
    }
    std::vector<FrameEnd> start() { return {look(unsettled_)}; }
    std::vector<FrameEnd> frame(int number, const std::vector<bool>&) {
        if (auto instability = solver_.frame(state_, gait_)) return {look(std::move(instability))};
        state_.time = (number + 1) * scene_.time_step;  // free of summed rounding
        return {look(std::nullopt)};
    }
    void record_frame(std::size_t, EvaluationRun& run) {
        state_.origin = run.origin();
        if (options_.on_frame) options_.on_frame(state_.time, body_places(model_.body, state_));
        if (run.frames() == 0) return;
        const std::optional<double> at = options_.snapshot.at;
        const bool last = run.is_over() || run.frames() == frames_of(scene_);
        if (snapshot_due_ && (at ? state_.time > *at - scene_.time_step / 1000 : last)) {
            snapshot_due_ = false;
            options_.snapshot.take(model_, snapshot_of(state_, solver_.densities()));
        }
        if (run.tank_is_due()) move_tank(solver_, state_, [&] { run.move_tank(state_); });
    }

    const State<Real>& state() const { return state_; }
    std::vector<Real> densities() { return solver_.densities(); }

private:
    /// Residuals are those of frames: what settles may come from a cache.
    Execution execution() {
        Execution own = options_.execution;
        if (own.residuals)
            own.residuals = [this](const Residuals& substep) {
                if (settled_) options_.execution.residuals(substep);
            };
        return own;
    }
    FrameEnd look(std::optional<Instability> instability) {
        FrameEnd end{.instability = std::move(instability)};
        end.frame.mean_x = mean_x(model_.body, state_);
        end.frame.tail_z = tail_z(model_.body, state_);
        if (needs_body_) end.frame.body = body_places_in_tank(model_.body, state_);
        if (end.instability) return end;
        end.laws = measure_laws(model_, state_);
        end.work = solver_.muscle_works();
        end.frame.touches_plane = scene_.stopping.plane_contact && touches_plane(model_, state_);
        return end;
    }

    const Scene& scene_;
    const Model& model_;
    const Gait& gait_;
    const EvaluationOptions& options_;
    Solver<Real> solver_;
    State<Real> state_;
    std::optional<Instability> unsettled_;
    bool settled_ = false;
    bool needs_body_;
    bool snapshot_due_;
};

/// Runs frame by frame to the duration or an early stop, from the places of `start`: the model, or the model perturbed.
template <class Real>
Evaluation evaluate_as(const Scene& scene, const Model& model, const Model& start, const Gait& gait,
                       const EvaluationOptions& options) {
    std::vector<EvaluationRun> runs;
    runs.emplace_back(scene, model, gait, LawWatch(model));
    CpuStepper<Real> stepper(scene, model, gait, options, runs.front().needs_body());
    const bool has_frames = frames_of(scene) > 0;  // the figures of a run without frames are those of settling
    stepper.settle(start, has_frames ? options.execution.starts : nullptr);
    const State<Real> begin = model.companions.empty() ? State<Real>{} : stepper.state();
    run_frames(scene, stepper, runs);
    return runs.front().finish(begin, stepper.state(), stepper.densities());
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
    check_evaluation_cost(scene, model,
                          {.doubles = options.precision == Precision::double_precision,
                           .several_threads = options.execution.threads > 1});
    Model start = model;  // volumes, and all else that is measured at rest, are those of the model
    perturb(options.perturbation, start);
    EvaluationOptions own = options;
    if (options.perturbation.amplitude != 0) own.execution.starts = nullptr;  // such starts are as many as seeds
    return options.precision == Precision::double_precision ? evaluate_as<double>(scene, model, start, gait, own)
                                                            : evaluate_as<float>(scene, model, start, gait, own);
}

}  // namespace natator
