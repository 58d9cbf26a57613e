#include "natator/evaluate.h"

#include <map>
#include <memory>
#include <utility>

#include "evaluate_frame_by_frame.h"
#include "evaluation_run.h"
#include "model_on_gpu.h"
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

/// States of a scene that run_frames advances by Solvers, frame by frame together.
template <class Real>
class SolverStepper {
public:
    /// The snapshots and calls of `options` are of the first. `needs_body`: see EvaluationRun.
    SolverStepper(const Scene& scene, const EvaluationOptions& options, bool needs_body)
        : scene_(scene),
          options_(options),
          needs_body_(needs_body),
          snapshot_due_(static_cast<bool>(options.snapshot.take)) {}

    /// One more. `computed`: the model as the solver has it; `start`: the model, or the model perturbed, which is taken
    /// to its settled start.
    void add(const Model& model, const Model& computed, const Model& start, const Gait& gait,
             const SettledStateCache* starts) {
        One& one = *all_.emplace_back(std::make_unique<One>(model, computed, gait, execution()));
        one.state = settled_start(start, scene_.settling, one.solver, starts, one.unsettled);
    }
    std::vector<FrameEnd> start() {
        settled_ = true;
        std::vector<FrameEnd> ends;
        for (const auto& one : all_) ends.push_back(look(*one, one->unsettled));
        return ends;
    }
    std::vector<FrameEnd> frame(int number, const std::vector<bool>& over) {
        std::vector<std::size_t> running;
        std::vector<typename Solver<Real>::Frame> frames;
        for (std::size_t k = 0; k < all_.size(); ++k) {
            if (over[k]) continue;
            One& one = *all_[k];
            running.push_back(k);
            frames.push_back(
                {&one.solver, &one.state, [&one](double time) { return drive(one.model, one.gait, time); }});
        }
        // By themselves with their gaits, which a GPU drives in scheme `flex`.
        std::vector<std::optional<Instability>> found;
        if (options_.execution.shared)
            found = Solver<Real>::frames(std::move(frames), 1);
        else
            for (const std::size_t k : running) found.push_back(all_[k]->solver.frame(all_[k]->state, all_[k]->gait));
        std::vector<FrameEnd> ends(all_.size());
        for (std::size_t i = 0; i < running.size(); ++i) {
            One& one = *all_[running[i]];
            if (!found[i]) one.state.time = (number + 1) * scene_.time_step;  // free of summed rounding
            ends[running[i]] = look(one, found[i]);
        }
        return ends;
    }
    void record_frame(std::size_t number, EvaluationRun& run) {
        One& one = *all_[number];
        one.state.origin = run.origin();
        if (options_.on_frame && number == 0) options_.on_frame(one.state.time, body_places(one.model.body, one.state));
        if (run.frames() == 0) return;
        const std::optional<double> at = options_.snapshot.at;
        const bool last = run.is_over() || run.frames() == frames_of(scene_);
        if (snapshot_due_ && number == 0 && (at ? one.state.time > *at - scene_.time_step / 1000 : last)) {
            snapshot_due_ = false;
            options_.snapshot.take(one.model, snapshot_of(one.state, one.solver.densities()));
        }
        if (run.tank_is_due()) move_tank(one.solver, one.state, [&] { run.move_tank(one.state); });
    }

    const State<Real>& state(std::size_t number) const { return all_[number]->state; }
    std::optional<Instability> look_at_water(std::size_t number) const {
        const One& one = *all_[number];
        return broken_by_water(one.model, one.solver, one.state.time);
    }
    std::vector<Real> densities(std::size_t number) { return all_[number]->solver.densities(); }

private:
    struct One {
        One(const Model& own, const Model& computed, const Gait& its, const Execution& execution)
            : model(own), gait(its), solver(computed, execution) {}
        const Model& model;
        const Gait& gait;
        Solver<Real> solver;
        State<Real> state{};
        std::optional<Instability> unsettled{};
    };

    /// Residuals are those of frames: what settles may come from a cache.
    Execution execution() {
        Execution own = options_.execution;
        if (own.residuals)
            own.residuals = [this](const Residuals& substep) {
                if (settled_) options_.execution.residuals(substep);
            };
        return own;
    }
    FrameEnd look(const One& one, std::optional<Instability> instability) const {
        FrameEnd end{.instability = std::move(instability)};
        end.cells_per_step = one.solver.cells_per_step();
        end.frame.mean_x = mean_x(one.model.body, one.state);
        end.frame.tail_z = tail_z(one.model.body, one.state);
        if (needs_body_) end.frame.body = body_places_in_tank(one.model.body, one.state);
        if (end.instability) return end;
        end.laws = measure_laws(one.model, one.state);
        end.work = one.solver.muscle_works();
        end.frame.touches_plane = scene_.stopping.plane_contact && touches_plane(one.model, one.state);
        return end;
    }

    const Scene& scene_;
    const EvaluationOptions& options_;
    std::vector<std::unique_ptr<One>> all_;
    bool settled_ = false;
    bool needs_body_;
    bool snapshot_due_;
};

/// Volumes, and all else that is measured at rest, are those of the model.
Model perturbed(Model model, const Perturbation& by) {
    perturb(by, model);
    return model;
}

/// Runs frame by frame to the duration or an early stop. Starts of perturbed ones are not kept: there are as many as
/// seeds.
template <class Real>
std::vector<Evaluation> evaluate_as(const Scene& scene, const std::vector<BatchMember>& members,
                                    const EvaluationOptions& options, const Computing& computing) {
    struct Models {
        Model own;
        std::optional<Model> on_gpu;
    };
    std::map<std::optional<int>, Models> models;  // by arrangement
    const auto models_of = [&](const BatchMember& member) -> const Models& {
        Scene own = scene;
        if (member.arrangement) own.fluid->disorder = *member.arrangement;
        const auto [known, is_new] = models.try_emplace(member.arrangement);
        if (is_new) {
            known->second.own = build_model(own);
            check_evaluation_cost(own, known->second.own, computing);
            if (options.execution.gpu) known->second.on_gpu = model_on_gpu(own, known->second.own);
        }
        return known->second;
    };
    std::vector<EvaluationRun> runs;
    for (const BatchMember& member : members) {
        const Model& model = models_of(member).own;
        runs.emplace_back(scene, model, member.gait, LawWatch(model));
    }
    SolverStepper<Real> stepper(scene, options, runs.front().needs_body());
    const bool has_frames = frames_of(scene) > 0;  // the figures of a run without frames are those of settling
    std::vector<State<Real>> begin(members.size());
    for (std::size_t k = 0; k < members.size(); ++k) {
        const auto& [model, on_gpu] = models_of(members[k]);
        const Perturbation& by = members[k].perturbation;
        stepper.add(model, on_gpu ? *on_gpu : model, by.amplitude == 0 ? model : perturbed(model, by), members[k].gait,
                    has_frames && by.amplitude == 0 ? options.execution.starts : nullptr);
        if (!model.companions.empty()) begin[k] = stepper.state(k);
    }
    run_frames(scene, stepper, runs);
    for (std::size_t k = 0; k < members.size(); ++k)
        if (!runs[k].instability()) runs[k].instability() = stepper.look_at_water(k);
    std::vector<Evaluation> evaluations;
    for (std::size_t k = 0; k < members.size(); ++k)
        evaluations.push_back(runs[k].finish(begin[k], stepper.state(k), stepper.densities(k)));
    return evaluations;
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
    return evaluate_frame_by_frame(scene, {{gait, options.perturbation}}, options).front();
}

std::vector<Evaluation> evaluate_frame_by_frame(const Scene& scene, const std::vector<BatchMember>& members,
                                                const EvaluationOptions& options) {
    for (const BatchMember& member : members) check_gait(member.gait, scene.creature ? scene.creature->actuators() : 0);
    if (members.empty()) return {};
    const Computing computing{.doubles = options.precision == Precision::double_precision,
                              .several_threads = options.execution.threads > 1};
    return computing.doubles ? evaluate_as<double>(scene, members, options, computing)
                             : evaluate_as<float>(scene, members, options, computing);
}

}  // namespace natator
