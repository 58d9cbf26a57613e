#include "path_run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <sstream>

#include "base/text.h"
#include "in_precision.h"
#include "natator/error.h"
#include "natator/measure.h"
#include "run/settle.h"

namespace natator::bench {
namespace {

template <class Real>
State<Real> cast_state(const State<double>& from) {
    State<Real> state;
    for (const auto& x : from.position) state.position.push_back(x.template cast<Real>());
    for (const auto& v : from.velocity) state.velocity.push_back(v.template cast<Real>());
    for (const auto& q : from.cluster_rotation) state.cluster_rotation.push_back(q.template cast<Real>());
    for (const auto& c : from.cluster_centre) state.cluster_centre.push_back(c.template cast<Real>());
    for (const double length : from.spring_rest_length) state.spring_rest_length.push_back(static_cast<Real>(length));
    state.time = from.time;
    return state;
}

template <class Real>
PathRun::Places tracked_places(const Model& model, const State<Real>& state) {
    PathRun::Places places;
    const bool swims = !model.body.particles.empty();
    for (const int i : model.body.particles) places.push_back(state.position[i].template cast<double>());
    for (int i = 0; i < model.particles() && !swims; ++i) places.push_back(state.position[i].template cast<double>());
    return places;
}

template <class Real>
void measure_density(const Model& model, Solver<Real>& solver, PathRun& run) {
    const std::vector<Real> densities = solver.densities();
    int fluid = 0;
    for (int i = 0; i < model.particles(); ++i) {
        if (!model.is_fluid(i)) continue;
        const double excess = std::max(static_cast<double>(densities[i]) - 1, 0.0);
        run.density_error_mean += excess;
        run.density_error_max = std::max(run.density_error_max, excess);
        ++fluid;
    }
    if (fluid > 0) run.density_error_mean /= fluid;
}

/// Keeps the largest of all frames.
void widen(Momentum& largest, const Momentum& now) {
    largest.linear = std::max(largest.linear, now.linear);
    largest.angular = std::max(largest.angular, now.angular);
    largest.linear_size = std::max(largest.linear_size, now.linear_size);
    largest.angular_size = std::max(largest.angular_size, now.angular_size);
}

/// Of movable particles, mass length^2/s^2.
struct Energy {
    double kinetic = 0, potential = 0;
};

template <class Real>
Energy energy_of(const Model& model, const State<Real>& state) {
    Energy sum;
    for (int i = 0; i < model.particles(); ++i) {
        if (model.inverse_mass[i] == 0) continue;
        const double mass = 1 / static_cast<double>(model.inverse_mass[i]);
        sum.kinetic += mass / 2 * state.velocity[i].template cast<double>().squaredNorm();
        sum.potential -= mass * model.parameters.gravity.dot(state.position[i].template cast<double>());
    }
    return sum;
}

template <class Real>
void measure_residuals(const Subject& subject, const Model& model, State<Real> state, PathRun& run) {
    Execution watched;
    watched.residuals = [&](const Residuals& residuals) {
        run.spring_residual = residuals.springs.max;
        run.cluster_residual = residuals.clusters.max;
    };
    run.instability = Solver<Real>(model, watched).frame(state, subject.gait);
}

template <class Real>
PathRun run_as(const Subject& subject, const Model& model, const State<double>& start) {
    using Clock = std::chrono::steady_clock;
    Solver<Real> solver(model);
    State<Real> state = cast_state<Real>(start);
    PathRun run;
    Momentum largest;
    const Energy begun = energy_of(model, state);
    double most_kinetic = begun.kinetic;
    int frame = 0;
    for (std::size_t mark = 0; mark < path_times.size(); ++mark) {
        const int last_frame = static_cast<int>(std::lround(path_times[mark] / model.time_step));
        for (; frame < last_frame; ++frame) {
            const auto begin = Clock::now();
            run.instability = solver.frame(state, subject.gait);
            run.seconds += std::chrono::duration<double>(Clock::now() - begin).count();
            if (run.instability) return run;
            state.time = (frame + 1) * model.time_step;
            widen(largest, measure_momentum(model, state));
            most_kinetic = std::max(most_kinetic, energy_of(model, state).kinetic);
        }
        run.places[mark] = tracked_places(model, state);
    }
    measure_density(model, solver, run);
    if (largest.linear_size > 0) run.linear_momentum_error = largest.linear / largest.linear_size;
    if (largest.angular_size > 0) run.angular_momentum_error = largest.angular / largest.angular_size;
    const Energy ended = energy_of(model, state);
    if (most_kinetic > 0)
        run.energy_change = (ended.kinetic + ended.potential - begun.kinetic - begun.potential) / most_kinetic;
    run.hash = state_hash(state);
    measure_residuals(subject, model, state, run);
    return run;
}

}  // namespace

State<double> settled_start(const Subject& subject, Scheme scheme) {
    Model model = subject.model;
    model.scheme = scheme;
    Solver<double> solver(model);
    State<double> state = initial_state<double>(model);
    if (settle(subject.settling, solver, state)) throw std::runtime_error(subject.name + ": unstable while settling");
    return state;
}

PathRun run_path(const Subject& subject, const Setting& setting, const State<double>& start) {
    Model model = subject.model;
    model.scheme = setting.scheme;
    set_steps(steps_of(setting), model.parameters);
    return in_precision(setting.precision, [&](auto real) { return run_as<decltype(real)>(subject, model, start); });
}

double path_error(const PathRun::Places& places, const PathRun::Places& reference) {
    double squares = 0;
    for (std::size_t i = 0; i < places.size(); ++i) squares += (places[i] - reference[i]).squaredNorm();
    return places.empty() ? 0 : std::sqrt(squares / static_cast<double>(places.size()));
}

std::string Steps::text() const {
    return std::to_string(substeps) + 'x' + std::to_string(iterations) + (modified_pressure ? "m" : "");
}

Steps steps_of(const std::string& text) {
    Steps steps{};
    std::istringstream parts(text);
    char cross = 0;
    parts >> steps.substeps >> cross >> steps.iterations;
    char modified = 'm';
    if (parts && !parts.eof()) {
        parts >> modified;
        steps.modified_pressure = true;
    }
    const bool fits =
        parts && parts.peek() == std::istringstream::traits_type::eof() && cross == 'x' && modified == 'm';
    const auto allowed = [](int count) { return 1 <= count && count <= 1000; };
    if (!fits || !allowed(steps.substeps) || !allowed(steps.iterations))
        throw InputError(
            "--setting = " + quoted(text) +
            ": must be SUBSTEPSxITERATIONS, such as 8x4, or the same with m behind it for the modified pressure");
    return steps;
}

Steps steps_of(const Setting& setting) {
    return {setting.substeps, setting.iterations, setting.modified_pressure};
}

void set_steps(const Steps& steps, SolverParameters& solver) {
    solver.substeps = steps.substeps;
    solver.iterations = steps.iterations;
    solver.conserving.modified_pressure = steps.modified_pressure;
}

}  // namespace natator::bench
