#include "natator/solver.h"

#include <chrono>
#include <cmath>
#include <string>
#include <variant>

#include "base/byte_reader.h"
#include "base/byte_writer.h"
#include "base/check_values.h"
#include "base/side_by_side.h"
#include "flex/cpu/flex_stages.h"
#include "gpu_solver.h"
#include "lattice/coupling.h"
#include "law_name.h"
#include "model/check_model.h"
#include "model/max_iterations.h"
#include "natator/error.h"
#include "natator/gait.h"
#include "natator/model.h"
#include "solids/cpu/conserving_stages.h"
#include "step.h"

namespace natator {
namespace {

Iterations iterations_of(const Model& model) {
    return {model.parameters.iterations, model.parameters.conserving.solid_iterations, max_iterations(model)};
}

/// Runs the substep once more from the unchanged state and looks behind each stage for the first bad particle.
template <class Stages>
Instability locate_instability(Stages& stages, const Model& model, double time) {
    std::optional<Instability> found;
    stages.forget();
    substep(stages, stages.plan(), iterations_of(model), [&](Stage stage) {
        if (found) return;
        if (const auto particle = stages.first_not_finite()) found.emplace(Instability{*particle, name(stage), time});
    });
    return found.value_or(Instability{0, name(Stage::velocities), time});
}

/// Passes the stages that an observer sees on to it.
template <class Real, class Stages>
struct ObserverHook {
    StepObserver<Real>& observer;
    const Stages& stages;
    void operator()(Stage stage) const {
        if (stage == Stage::predict) observer.predicted(stages.workspace().unsorted_position);
        if (stage == Stage::iteration) observer.iterated(stages.positions());
    }
};

/// Books the time since the last stage, or since its making, on the stage that has ended.
class ProfileHook {
public:
    explicit ProfileHook(StageProfile& profile) : profile_(profile) {}
    void operator()(Stage stage) const {
        if (stage == Stage::iteration) return;
        const auto now = Clock::now();
        profile_.add(name(stage), std::chrono::duration<double>(now - last_).count());
        last_ = now;
    }

private:
    using Clock = std::chrono::steady_clock;
    StageProfile& profile_;
    mutable Clock::time_point last_ = Clock::now();
};

/// Measures what the stages leave: of the divergence behind its solve, of all else behind each iteration.
template <class Stages>
struct ResidualHook {
    Stages& stages;
    Residuals& residuals;
    void operator()(Stage stage) const {
        if (stage == Stage::divergence) stages.measure_divergence(residuals);
        if (stage != Stage::iteration) return;
        stages.measure_constraints(residuals);
        ++residuals.iterations;
    }
};

/// Of what drives the muscles in a frame; between two values that are 2 rounding may lead a little beyond.
void check_values_of_drive(const Model& model, const std::vector<double>& driven) {
    constexpr double rounding = 1e-9;
    check_driven(model, driven);
    for (const double value : driven)
        if (!(std::abs(value) <= 2 + rounding)) check_drive(driven, static_cast<int>(driven.size()));
}

/// Does nothing behind a stage.
struct NoHook {
    void operator()(Stage) const {}
};

}  // namespace

template <class Real>
State<Real> initial_state(const Model& model) {
    check_model(model);
    State<Real> state;
    for (int i = 0; i < model.particles(); ++i) {
        state.position.push_back(model.position[i].cast<Real>());
        state.velocity.push_back(model.velocity[i].cast<Real>());
    }
    for (const Cluster& cluster : model.clusters) {
        state.cluster_rotation.push_back(cluster.rotation.cast<Real>());
        state.cluster_centre.push_back(cluster.centre.cast<Real>());
    }
    for (const Spring& spring : model.springs)
        state.spring_rest_length.push_back(static_cast<Real>(spring.rest_length));
    return state;
}

template <class Real>
class Solver<Real>::Implementation {
public:
    Implementation(const Model& model, const Execution& execution)
        : model_(model), execution_(execution), stages_(stages_for(model, plan_for(model, execution.skip))) {
        check_threads(execution.threads);
        std::visit([&](auto& stages) { stages->use_threads(execution.threads); }, stages_);
        if (model.water_box) coupling_.emplace(model, execution.threads);
        if (execution.forces) std::visit([](auto& stages) { stages->keep_forces(); }, stages_);
        if (execution.forces && coupling_) coupling_->clear_forces();
    }

    std::optional<Instability> update(State<Real>& state, double time_step, int substeps, StepObserver<Real>* observer,
                                      const Drive* drive) {
        check_state(model_, state);
        check_step(time_step, substeps);
        if (model_.particles() == 0) return std::nullopt;
        return std::visit([&](auto& stages) { return run(*stages, state, time_step, substeps, observer, drive); },
                          stages_);
    }

    std::optional<Instability> frame(State<Real>& state, const Drive& drive) {
        check_state(model_, state);
        const bool per_substep = model_.scheme != Scheme::flex;
        if (!per_substep) actuate(model_, drive(state.time), state.time, state);
        return update(state, model_.time_step, model_.parameters.substeps, nullptr, per_substep ? &drive : nullptr);
    }

    const Model& model() const { return model_; }

    void shift_water(const Eigen::Vector3d& by) {
        if (coupling_) coupling_->shift(by);
    }
    double cells_per_step() const { return coupling_ ? coupling_->fastest() : 0; }
    WaterField lattice_water() const { return coupling_ ? coupling_->field() : WaterField{}; }
    void visit_lattice_cells(const std::function<void(double, const Eigen::Vector3d&)>& visit) const {
        if (coupling_) coupling_->visit_cells(visit);
    }
    const std::vector<double>& muscle_works() const { return muscle_work_; }
    void clear_muscle_work() { std::fill(muscle_work_.begin(), muscle_work_.end(), 0); }

    std::string save() const {
        ByteWriter saved;
        for (const double work : muscle_work_) saved.add(work);
        if (coupling_) coupling_->save(saved);
        return saved.take();
    }
    void restore(std::string_view saved) {
        ByteReader from(saved);
        std::vector<double> work(muscle_work_.size());
        for (double& of_swimmer : work) from.read(of_swimmer);
        if (coupling_)
            coupling_->restore(from);
        else
            from.require_end();
        muscle_work_ = std::move(work);
    }

    std::vector<Real> densities() {
        return std::visit([](auto& stages) { return stages->densities(); }, stages_);
    }
    std::vector<Real> pressures() const {
        return std::visit([](const auto& stages) { return stages->pressures(); }, stages_);
    }
    std::vector<Vector3<Real>> forces() const {
        if (coupling_) return coupling_->forces();
        return std::visit([](const auto& stages) { return stages->forces(); }, stages_);
    }
    std::vector<int> neighbour_counts() const {
        return std::visit([](const auto& stages) { return stages->neighbour_counts(); }, stages_);
    }

private:
    using AnyStages =
        std::variant<std::unique_ptr<cpu::FlexStages<Real>>, std::unique_ptr<cpu::ConservingStages<Real>>>;

    static Plan plan_for(const Model& model, bool skip) {
        check_model(model);
        return skip ? make_plan(model) : make_unskipped_plan(model);
    }

    static AnyStages stages_for(const Model& model, const Plan& plan) {
        if (model.scheme != Scheme::flex) return std::make_unique<cpu::ConservingStages<Real>>(model, plan);
        return std::make_unique<cpu::FlexStages<Real>>(model, plan);
    }

    /// One substep; false if its outcome is not finite: the state is as it was then.
    template <class Stages, class AfterStage>
    bool advance(Stages& stages, const AfterStage& after) {
        substep(stages, stages.plan(), iterations_of(model_), after);
        if (!stages.finite()) return false;
        stages.commit();
        after(Stage::commit);
        return true;
    }

    /// `drive`: sets the muscles for the end of each substep; null leaves them as they are.
    template <class Stages>
    std::optional<Instability> run(Stages& stages, State<Real>& state, double time_step, int substeps,
                                   StepObserver<Real>* observer, const Drive* drive) {
        const Real h = static_cast<Real>(time_step) / static_cast<Real>(substeps);
        const double start = state.time;
        stages.clear_forces();
        if (execution_.forces && coupling_) coupling_->clear_forces();
        for (int k = 0; k < substeps; ++k) {
            const double end = start + time_step * (k + 1) / substeps;
            if (drive) {
                rest_lengths_before_ = state.spring_rest_length;
                actuate(model_, (*drive)(end), end, state);
            }
            if (coupling_) coupling_->push(state, static_cast<double>(h));
            stages.begin_substep(state, h);
            Residuals residuals{.time = state.time};
            const bool finite = observer               ? advance(stages, ObserverHook<Real, Stages>{*observer, stages})
                                : execution_.residuals ? advance(stages, ResidualHook<Stages>{stages, residuals})
                                : execution_.profile   ? advance(stages, ProfileHook(*execution_.profile))
                                                       : advance(stages, NoHook{});
            if (!finite) return locate_instability(stages, model_, state.time);
            state.time = end;
            if (coupling_) {
                coupling_->follow(state, static_cast<double>(h), end);
                if (coupling_->fastest() > lattice::max_cells_per_substep)
                    return Instability{coupling_->fastest_particle(), "frame", end, name(physics::Law::mach)};
                if (const auto particle = coupling_->first_not_finite())
                    return Instability{*particle, "collision and streaming", end};
            }
            if (drive) stages.add_spring_work(rest_lengths_before_, muscle_work_);
            if (observer) observer->substep_ended(state.velocity);
            if (execution_.residuals && !observer) execution_.residuals(residuals);
        }
        return std::nullopt;
    }

    const Model& model_;
    Execution execution_;
    AnyStages stages_;
    std::optional<lattice::Coupling<Real>> coupling_;
    std::vector<Real> rest_lengths_before_;  ///< of the springs, at the substep's start
    std::vector<double> muscle_work_ = std::vector<double>(model_.swimmers());
};

template <class Real>
Solver<Real>::Solver(const Model& model, const Execution& execution) {
    if (execution.gpu)
        gpu_ = std::make_unique<GpuSolver<Real>>(
            model, GpuSolverOptions{.device = *execution.gpu, .forces = execution.forces, .shared = execution.shared});
    else
        implementation_ = std::make_unique<Implementation>(model, execution);
}
template <class Real>
Solver<Real>::~Solver() = default;
template <class Real>
Solver<Real>::Solver(Solver&&) noexcept = default;
template <class Real>
Solver<Real>& Solver<Real>::operator=(Solver&&) noexcept = default;

template <class Real>
std::optional<Instability> Solver<Real>::update(State<Real>& state, double time_step, int substeps,
                                                StepObserver<Real>* observer) {
    if (gpu_) return gpu_->update(state, time_step, substeps, observer);
    return implementation_->update(state, time_step, substeps, observer, nullptr);
}

template <class Real>
std::optional<Instability> Solver<Real>::frame(State<Real>& state, const Gait& gait) {
    if (gpu_) return gpu_->frame(state, gait);
    const Model& model = implementation_->model();
    return implementation_->frame(state, [&](double time) { return natator::drive(model, gait, time); });
}

template <class Real>
std::optional<Instability> Solver<Real>::frame(State<Real>& state, const Drive& drive) {
    const Drive checked = checked_drive(drive);
    return gpu_ ? gpu_->frame(state, checked) : implementation_->frame(state, checked);
}

template <class Real>
Drive Solver<Real>::checked_drive(const Drive& drive) const {
    return [&drive, &model = gpu_ ? gpu_->model() : implementation_->model()](double time) {
        std::vector<double> driven = drive(time);
        check_values_of_drive(model, driven);
        return driven;
    };
}

template <class Real>
std::vector<std::optional<Instability>> Solver<Real>::frames(std::vector<Frame> all, int max_threads) {
    std::vector<std::optional<Instability>> found(all.size());
    std::vector<std::size_t> together, alone;
    for (std::size_t k = 0; k < all.size(); ++k)
        (all[k].solver->gpu_ && all[k].solver->gpu_->shared() ? together : alone).push_back(k);
    if (!together.empty()) {
        std::vector<Drive> drives;
        drives.reserve(together.size());
        for (const std::size_t k : together) drives.push_back(all[k].solver->checked_drive(all[k].drive));
        std::vector<typename GpuSolver<Real>::Frame> frames;
        for (std::size_t i = 0; i < together.size(); ++i)
            frames.push_back({all[together[i]].solver->gpu_.get(), all[together[i]].state, &drives[i]});
        const auto ends = GpuSolver<Real>::frames(frames);
        for (std::size_t i = 0; i < together.size(); ++i) found[together[i]] = ends[i];
    }
    side_by_side(
        alone.size(),
        [&](std::size_t i) {
            Frame& one = all[alone[i]];
            found[alone[i]] = one.solver->frame(*one.state, one.drive);
        },
        static_cast<std::size_t>(max_threads));
    return found;
}

template <class Real>
void Solver<Real>::shift_water(const Eigen::Vector3d& by) {
    gpu_ ? gpu_->shift_water(by) : implementation_->shift_water(by);
}

template <class Real>
double Solver<Real>::cells_per_step() const {
    return gpu_ ? gpu_->cells_per_step() : implementation_->cells_per_step();
}

template <class Real>
void Solver<Real>::visit_lattice_cells(const std::function<void(double, const Eigen::Vector3d&)>& visit) const {
    if (!gpu_) return implementation_->visit_lattice_cells(visit);
    const WaterField water = gpu_->lattice_water();
    for (std::size_t k = 0; k < water.density.size(); ++k) visit(water.density[k], water.velocity[k].cast<double>());
}

template <class Real>
WaterField Solver<Real>::lattice_water() const {
    return gpu_ ? gpu_->lattice_water() : implementation_->lattice_water();
}

template <class Real>
double Solver<Real>::muscle_work() const {
    double sum = 0;
    for (const double work : muscle_works()) sum += work;
    return sum;
}

template <class Real>
const std::vector<double>& Solver<Real>::muscle_works() const {
    return gpu_ ? gpu_->muscle_works() : implementation_->muscle_works();
}

template <class Real>
void Solver<Real>::clear_muscle_work() {
    gpu_ ? gpu_->clear_muscle_work() : implementation_->clear_muscle_work();
}

template <class Real>
std::string Solver<Real>::save() const {
    return gpu_ ? gpu_->save() : implementation_->save();
}

template <class Real>
void Solver<Real>::restore(std::string_view saved) {
    gpu_ ? gpu_->restore(saved) : implementation_->restore(saved);
}

template <class Real>
std::vector<Real> Solver<Real>::densities() {
    return gpu_ ? gpu_->densities() : implementation_->densities();
}

template <class Real>
std::vector<Real> Solver<Real>::pressures() const {
    return gpu_ ? gpu_->pressures() : implementation_->pressures();
}

template <class Real>
std::vector<Vector3<Real>> Solver<Real>::forces() const {
    return gpu_ ? gpu_->forces() : implementation_->forces();
}

template <class Real>
std::vector<int> Solver<Real>::neighbour_counts() const {
    return gpu_ ? gpu_->neighbour_counts() : implementation_->neighbour_counts();
}

template <class Real>
bool Solver<Real>::on_gpu() const {
    return gpu_ != nullptr;
}

template <class Real>
std::string Solver<Real>::device() const {
    return gpu_ ? gpu_->device() : std::string();
}

template State<float> initial_state<float>(const Model&);
template State<double> initial_state<double>(const Model&);
template class Solver<float>;
template class Solver<double>;

}  // namespace natator
