#include "evaluate/settled_start.h"
#include "io/strict_json.h"
#include "merge_patches.h"
#include "natator/actuate.h"
#include "natator/cost.h"
#include "natator/error.h"
#include "natator/limits.h"
#include "natator/live.h"
#include "natator/load_scene.h"
#include "natator/measure.h"
#include "natator/model_builder.h"
#include "same_layout.h"

namespace natator {
namespace {

/// Densities of a state that no update has led to: those of an update that moves nothing.
template <class Real>
std::vector<Real> densities_at_rest(Model model, State<Real> state) {
    model.parameters.gravity.setZero();
    model.parameters.numIterations = 0;
    std::fill(state.velocity.begin(), state.velocity.end(), Vector3<Real>::Zero());
    Solver<Real> solver(model);
    solver.update(state, model.time_step, 1);
    return solver.densities();
}

/// The scene's model, if a stream of it does not cost too much.
Model affordable(const Scene& scene) {
    Model model = build_model(scene);
    check_live_cost(scene, model);
    return model;
}

}  // namespace

/// A scene with all that is made of it. Stays where it is, for the solver refers to the model.
template <class Real>
struct LiveSimulation<Real>::Run {
    Run(Scene of, const Execution& execution)
        : scene(std::move(of)), model(affordable(scene)), solver(model, execution) {
        if (scene.moving_tank) follower.emplace(scene, model);
    }

    Scene scene;
    Model model;
    Solver<Real> solver;
    std::optional<TankFollower> follower;
};

template <class Real>
LiveSimulation<Real>::LiveSimulation(const LiveSetup& setup, const Execution& execution) : execution_(execution) {
    load(setup);
}

template <class Real>
LiveSimulation<Real>::~LiveSimulation() = default;

template <class Real>
void LiveSimulation<Real>::load(const LiveSetup& setup) {
    LiveSetup next = setup;
    std::unique_ptr<Run> run = make_run(next);
    if (!next.gait) next.gait = resting_gait(run->model.actuators);
    check_gait(*next.gait, run->model.actuators);
    start(std::move(run));
    setup_ = std::move(next);
}

template <class Real>
void LiveSimulation<Real>::set_gait(const Gait& gait) {
    check_gait(gait, model().actuators);
    setup_.gait = gait;
}

template <class Real>
bool LiveSimulation<Real>::merge_overrides(const std::string& patch) {
    LiveSetup next = setup_;
    const std::string before = next.overrides.empty() ? "{}" : next.overrides;
    next.overrides = merge_patches(parse_json(before, "overrides"), parse_json(patch, "overrides")).dump();
    if (next.overrides.size() > limits::live_overrides_bytes)
        throw InputError("overrides: all that are in force together are larger than 1 MiB; load the scene anew");
    std::unique_ptr<Run> run = make_run(next);
    check_gait(*next.gait, run->model.actuators);
    const bool goes_on = !instability_ && same_layout(model(), run->model);
    if (goes_on) {
        if (run->scene.time_step != scene().time_step) {
            base_frame_ = frames_;
            base_time_ = state_.time;
        }
        if (run->follower) run->follower->stand_at(state_.origin);
        run_ = std::move(run);
        updated_ = false;
    } else {
        start(std::move(run));
    }
    setup_ = std::move(next);
    return !goes_on;
}

template <class Real>
void LiveSimulation<Real>::reset() {
    start(nullptr);
}

template <class Real>
bool LiveSimulation<Real>::frame() {
    if (instability_) return false;
    instability_ = run_->solver.frame(state_, gait());
    updated_ = true;
    if (instability_) return false;
    ++frames_;
    state_.time = base_time_ + (frames_ - base_frame_) * scene().time_step;  // free of summed rounding
    if (run_->follower) follow(*run_->follower);
    return true;
}

/// As SwimRecord does it.
template <class Real>
void LiveSimulation<Real>::follow(TankFollower& follower) {
    follower.drift(scene().time_step);
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const int particle : model().body.particles) centre += state_.position[particle].template cast<double>();
    follower.follow(centre / static_cast<double>(model().body.particles.size()), state_);
}

template <class Real>
const Scene& LiveSimulation<Real>::scene() const {
    return run_->scene;
}

template <class Real>
const Model& LiveSimulation<Real>::model() const {
    return run_->model;
}

template <class Real>
double LiveSimulation<Real>::distance() const {
    return mean_x(model().body, state_) + state_.origin.x() - start_x_;
}

template <class Real>
std::vector<Real> LiveSimulation<Real>::densities() {
    return updated_ ? run_->solver.densities() : densities_at_rest(model(), state_);
}

template <class Real>
std::unique_ptr<typename LiveSimulation<Real>::Run> LiveSimulation<Real>::make_run(const LiveSetup& setup) const {
    return std::make_unique<Run>(load_scene(setup.scene, {setup.overrides, setup.data}), execution_);
}

template <class Real>
void LiveSimulation<Real>::start(std::unique_ptr<Run> run) {
    Run& next = run ? *run : *run_;
    std::optional<Instability> instability;
    State<Real> state = settled_start(next.model, next.scene.settling, next.solver, execution_.starts, instability);
    if (run) run_ = std::move(run);
    state_ = std::move(state);
    if (next.follower) next.follower->stand_at(state_.origin);
    instability_ = std::move(instability);
    updated_ = false;
    frames_ = base_frame_ = 0;
    base_time_ = 0;
    start_x_ = mean_x(model().body, state_);
}

template class LiveSimulation<float>;
template class LiveSimulation<double>;

}  // namespace natator
