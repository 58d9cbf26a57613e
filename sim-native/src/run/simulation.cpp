#include "natator/simulation.h"

#include <limits>

#include "base/side_by_side.h"
#include "base/strict_json.h"
#include "conservation_errors.h"
#include "move_tank.h"
#include "natator/error.h"
#include "natator/evaluate.h"
#include "natator/limits.h"
#include "natator/load_scene.h"
#include "natator/measure.h"
#include "natator/model.h"
#include "physics/laws.h"
#include "same_layout.h"
#include "scene/merge_patches.h"
#include "simulation_run.h"

namespace natator {
namespace {

constexpr int frames_between_densities = 16;  ///< an evaluation looks at them at its end, which a stream has not

/// Densities of a state that no update has led to: those of an update that moves nothing.
template <class Real>
std::vector<Real> densities_at_rest(Model model, State<Real> state) {
    model.parameters.gravity.setZero();
    model.parameters.iterations = 0;
    std::fill(state.velocity.begin(), state.velocity.end(), Vector3<Real>::Zero());
    Solver<Real> solver(model);
    solver.update(state, model.time_step, 1);
    return solver.densities();
}

std::vector<Gait> gaits_of_companions(const Model& model) {
    std::vector<Gait> gaits;
    gaits.reserve(model.companions.size());
    for (const CompanionBody& companion : model.companions) gaits.push_back(companion.gait);
    return gaits;
}

/// Companions whose gaits are the same in both models keep those that they have got since.
void keep_changed_gaits(const Model& before, const Model& next, std::vector<Gait>& company) {
    std::vector<Gait> gaits = gaits_of_companions(next);
    for (std::size_t k = 0; k < std::min(gaits.size(), company.size()); ++k)
        if (gaits[k] == before.companions[k].gait) gaits[k] = company[k];
    company = std::move(gaits);
}

}  // namespace

template <class Real>
Simulation<Real>::Simulation(const Scene& scene, const Execution& execution)
    : Simulation(SimulationSetup{.scene = scene.name, .made = scene}, execution) {}

template <class Real>
Simulation<Real>::Simulation(const SimulationSetup& setup, const Execution& execution) : execution_(execution) {
    load(setup);
}

template <class Real>
Simulation<Real>::~Simulation() = default;
template <class Real>
Simulation<Real>::Simulation(Simulation&&) noexcept = default;
template <class Real>
Simulation<Real>& Simulation<Real>::operator=(Simulation&&) noexcept = default;

template <class Real>
void Simulation<Real>::load(const SimulationSetup& setup) {
    SimulationSetup next = setup;
    std::unique_ptr<Run> run = make_run(next);
    if (!next.gait) next.gait = resting_gait(run->model.actuators);
    check_gait(*next.gait, run->model.actuators);
    start(std::move(run));
    company_ = gaits_of_companions(model());
    setup_ = std::move(next);
}

template <class Real>
void Simulation<Real>::check_swimmer(int swimmer) const {
    const int last = model().swimmers() - 1;
    if (swimmer < 0 || swimmer > last)
        throw InputError("swimmer = " + std::to_string(swimmer) + ": must be " +
                         (last == 0 ? "0, as the scene has no companions"
                                    : "in [0, " + std::to_string(last) + "], the creature and its companions"));
}

template <class Real>
const Gait& Simulation<Real>::gait(int swimmer) const {
    check_swimmer(swimmer);
    return swimmer == 0 ? gait() : company_[static_cast<std::size_t>(swimmer - 1)];
}

template <class Real>
void Simulation<Real>::set_gait(const Gait& gait, int swimmer) {
    check_swimmer(swimmer);
    const int actuators = model().actuators_of(swimmer);
    check_gait(gait, actuators);
    check_steering(steering_[swimmer], gait, actuators);
    check_steering(applied_[swimmer], gait, actuators);
    if (swimmer == 0)
        setup_.gait = gait;
    else
        company_[swimmer - 1] = gait;
    if (frames_ > 0 || swimmer > 0) run_->laws.drive_freely();  // muscles jump from the one to the other
}

template <class Real>
void Simulation<Real>::steer(const Steering& steering, int swimmer) {
    check_steering(steering, gait(swimmer), model().actuators_of(swimmer));
    steering_[swimmer] = steering;
    run_->laws.drive_freely();
}

template <class Real>
void Simulation<Real>::drive(const std::vector<double>& values, int swimmer) {
    check_swimmer(swimmer);
    check_drive(values, model().actuators_of(swimmer));
    steering_[swimmer] = steering_of_drive(values);
    run_->laws.drive_freely();
}

template <class Real>
bool Simulation<Real>::merge_overrides(const std::string& patch, const ModelCheck& check) {
    if (setup_.made) throw InputError("overrides: the scene was made by the program; must be a scene by name");
    SimulationSetup next = setup_;
    const std::string before = next.overrides.empty() ? "{}" : next.overrides;
    next.overrides = merge_patches(parse_json(before, "overrides"), parse_json(patch, "overrides")).dump();
    if (next.overrides.size() > limits::live_overrides_bytes)
        throw InputError("overrides: all that are in force together are larger than 1 MiB; load the scene anew");
    std::unique_ptr<Run> run = make_run(next);
    if (check) check(run->model);
    check_gait(*next.gait, run->model.actuators);
    const bool goes_on = !instability_ && same_layout(model(), run->model);
    std::vector<Gait> company = company_;
    keep_changed_gaits(model(), run->model, company);
    if (goes_on) {
        for (std::size_t k = 0; k < company.size(); ++k)
            for (const auto* steering : {&steering_, &applied_})
                check_steering((*steering)[k + 1], company[k], static_cast<int>(company[k].amplitude.size()));
        if (run->scene.time_step != scene().time_step) {
            base_frame_ = frames_;
            base_time_ = state_.time;
        }
        for (int k = 0; k < model().swimmers(); ++k) earlier_work_[k] += run_->solver.muscle_works()[k];
        if (run->follower) run->follower->set_origin(state_.origin);
        run_ = std::move(run);
        run_->laws.go_on(measure_laws(model(), state_));
        run_->laws.drive_freely();
        updated_ = false;
    } else {
        start(std::move(run));
    }
    company_ = std::move(company);
    watch_company();
    setup_ = std::move(next);
    return !goes_on;
}

template <class Real>
void Simulation<Real>::reset() {
    start(nullptr);
    watch_company();
}

template <class Real>
void Simulation<Real>::reset(int start_number) {
    if (setup_.start == start_number) return reset();
    SimulationSetup next = setup_;
    next.start = start_number;
    start(make_run(next));
    watch_company();
    setup_ = std::move(next);
}

/// A companion may have another gait than its scene's, which a new watch over the laws does not know.
template <class Real>
void Simulation<Real>::watch_company() {
    if (company_ != gaits_of_companions(model())) run_->laws.drive_freely();
}

/// What drives the muscles of all swimmers in the frame that begins now.
template <class Real>
Drive Simulation<Real>::next_drive() const {
    const bool along = model().scheme != Scheme::flex;  // from one steering to the next; else at once
    return [this, along, begin = state_.time, frame = model().time_step](double time) {
        const double part = along ? std::clamp((time - begin) / frame, 0.0, 1.0) : 1;
        std::vector<double> all;
        for (int k = 0; k < model().swimmers(); ++k) {
            std::vector<double> driven = natator::drive(model(), gait(k), time, k);
            if (!leaves_gait(steering_[k]) || !leaves_gait(applied_[k]))
                driven = natator::steer(applied_[k], steering_[k], part, std::move(driven));
            all.insert(all.end(), driven.begin(), driven.end());
        }
        return all;
    };
}

template <class Real>
std::vector<double> Simulation<Real>::driven(int swimmer) const {
    std::vector<double> driven = natator::drive(model(), gait(swimmer), state_.time, swimmer);
    const Steering& applied = applied_[swimmer];
    return leaves_gait(applied) ? driven : natator::steer(applied, applied, 1, std::move(driven));
}

template <class Real>
double Simulation<Real>::muscle_work(int swimmer) const {
    check_swimmer(swimmer);
    return earlier_work_[swimmer] + run_->solver.muscle_works()[swimmer];
}

template <class Real>
bool Simulation<Real>::step(const Gait& next) {
    if (next != gait()) set_gait(next);
    return step();
}

template <class Real>
bool Simulation<Real>::step() {
    if (instability_) return false;
    run_->laws.drive_by(gait());
    const bool by_gait = company_.empty() && leaves_gait(steering_[0]) && leaves_gait(applied_[0]);
    return end_step(by_gait ? run_->solver.frame(state_, gait()) : run_->solver.frame(state_, next_drive()));
}

/// What follows the solver's frame.
template <class Real>
bool Simulation<Real>::end_step(std::optional<Instability> found) {
    instability_ = std::move(found);
    updated_ = true;
    restored_densities_.reset();
    if (!instability_)
        instability_ = run_->laws.look(measure_laws(model(), state_), run_->solver.muscle_work(), state_.time);
    if (!instability_ && (frames_ + 1) % frames_between_densities == 0)
        instability_ = run_->laws.look_at_compression(
            conservation_errors(model(), state_, run_->solver.densities()).density_error_mean, state_.time);
    if (instability_) return false;
    applied_ = steering_;
    ++frames_;
    state_.time = base_time_ + (frames_ - base_frame_) * scene().time_step;  // free of summed rounding
    if (run_->follower) follow(*run_->follower);
    return true;
}

/// As SwimRecord does it.
template <class Real>
void Simulation<Real>::follow(MovingFrame& follower) {
    follower.drift(scene().time_step);
    const Eigen::Vector3d centre = mean_place(body_places_in_tank(model().body, state_));
    if (move_tank(run_->solver, state_, [&] { follower.follow(centre, state_); })) run_->laws.restart();
}

template <class Real>
const Scene& Simulation<Real>::scene() const {
    return run_->scene;
}

template <class Real>
const Model& Simulation<Real>::model() const {
    return run_->model;
}

template <class Real>
double Simulation<Real>::distance(int swimmer) const {
    check_swimmer(swimmer);
    return mean_x(model().body_of(swimmer), state_) + state_.origin.x() - start_x_[swimmer];
}

template <class Real>
WaterField Simulation<Real>::water() const {
    if (model().water_box) return run_->solver.lattice_water();
    std::vector<Real> pressures;
    if (updated_ && !restored_densities_) pressures = run_->solver.pressures();
    WaterField field = water_field(model(), state_, pressures);
    if (pressures.empty() && model().scheme == Scheme::conserving)  // a GPU that is shared does not keep them
        field.pressure.assign(field.density.size(), std::numeric_limits<float>::quiet_NaN());
    return field;
}

template <class Real>
std::vector<Vector3<Real>> Simulation<Real>::forces() const {
    if (!execution_.forces || model().scheme == Scheme::flex) return {};
    std::vector<Vector3<Real>> forces;
    if (updated_ && !restored_densities_) forces = run_->solver.forces();
    forces.resize(model().particles(), Vector3<Real>::Zero());
    return forces;
}

template <class Real>
std::vector<Real> Simulation<Real>::densities() {
    if (!updated_) return densities_at_rest(model(), state_);
    return restored_densities_ ? *restored_densities_ : run_->solver.densities();
}

template <class Real>
std::unique_ptr<typename Simulation<Real>::Run> Simulation<Real>::make_run(const SimulationSetup& setup) const {
    Scene scene = setup.made ? *setup.made : load_scene(setup.scene, {setup.overrides, setup.data});
    const Perturbation shift = setup.start ? choose_start(*setup.start, scene) : Perturbation{};
    return std::make_unique<Run>(std::move(scene), shift, setup, execution_);
}

template <class Real>
void Simulation<Real>::start(std::unique_ptr<Run> run) {
    Run& next = run ? *run : *run_;
    std::optional<Instability> instability;
    State<Real> state = next.begin(execution_.starts, instability);
    next.laws = LawWatch(next.model);
    if (!instability) instability = next.laws.start(measure_laws(next.model, state));
    if (run) run_ = std::move(run);
    state_ = std::move(state);
    if (next.follower) next.follower->set_origin(state_.origin);
    instability_ = std::move(instability);
    updated_ = false;
    frames_ = base_frame_ = 0;
    base_time_ = 0;
    start_x_.clear();
    steering_.clear();
    for (int k = 0; k < model().swimmers(); ++k) {
        start_x_.push_back(mean_x(model().body_of(k), state_));
        steering_.push_back(no_steering(model().actuators_of(k)));
    }
    applied_ = steering_;
    earlier_work_.assign(start_x_.size(), 0);
    run_->solver.clear_muscle_work();  // not subtracted: each start gives the same bits
}

template <class Real>
std::vector<bool> step_together(const std::vector<Simulation<Real>*>& simulations, int max_threads) {
    std::vector<Simulation<Real>*> stable;
    std::vector<typename Solver<Real>::Frame> frames;
    for (Simulation<Real>* one : simulations) {
        if (one->instability_) continue;
        one->run_->laws.drive_by(one->gait());
        stable.push_back(one);
        frames.push_back({&one->run_->solver, &one->state_, one->next_drive()});
    }
    const std::vector<std::optional<Instability>> found = Solver<Real>::frames(std::move(frames), max_threads);
    side_by_side(
        stable.size(), [&](std::size_t k) { stable[k]->end_step(found[k]); }, static_cast<std::size_t>(max_threads));
    std::vector<bool> goes_on;
    goes_on.reserve(simulations.size());
    for (const Simulation<Real>* one : simulations) goes_on.push_back(!one->instability_);
    return goes_on;
}

template std::vector<bool> step_together(const std::vector<Simulation<float>*>&, int);
template std::vector<bool> step_together(const std::vector<Simulation<double>*>&, int);
template class Simulation<float>;
template class Simulation<double>;

}  // namespace natator
