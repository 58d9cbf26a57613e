#include "settled_tank.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "in_precision.h"
#include "natator/model.h"
#include "run/settle.h"
#include "scene/scene_json.h"
#include "statistics.h"

namespace natator::bench {
namespace {

/// Sums over particles and frames.
struct DensitySums {
    double excess = 0, max_excess = 0, deviation = 0;
    double samples = 0, deep_samples = 0;

    template <class Real>
    void add(const Model& model, const State<Real>& state, const std::vector<Real>& densities) {
        double surface = 0;
        for (const auto& x : state.position) surface += 2 * static_cast<double>(x.y()) / model.particles();
        const double deep = surface - 2 * model.parameters.radius;
        for (int i = 0; i < model.particles(); ++i) {
            const double difference = static_cast<double>(densities[i]) - 1;
            excess += std::max(difference, 0.0);
            max_excess = std::max(max_excess, difference);
            samples += 1;
            if (static_cast<double>(state.position[i].y()) > deep) continue;
            deviation += std::abs(difference);
            deep_samples += 1;
        }
    }
};

template <class Real>
SettledTankRun run_as(const Model& model, const Settling& settling, double rest, double window) {
    using Clock = std::chrono::steady_clock;
    Solver<Real> solver(model);
    State<Real> state = initial_state<Real>(model);
    SettledTankRun run;
    run.particles = model.particles();
    run.instability = settle(settling, solver, state);
    const auto frames_in = [&model](double seconds) { return std::lround(seconds / model.time_step); };
    DensitySums sums;
    std::vector<double> seconds;
    for (long frame = 0; frame < frames_in(rest + window) && !run.instability; ++frame) {
        const auto begin = Clock::now();
        run.instability = solver.update(state, model.time_step, model.parameters.substeps);
        seconds.push_back(std::chrono::duration<double>(Clock::now() - begin).count());
        if (frame >= frames_in(rest)) sums.add(model, state, solver.densities());
    }
    if (run.instability) return run;
    run.frame_seconds = median(seconds);
    run.density_error_mean = sums.excess / sums.samples;
    run.density_error_max = sums.max_excess;
    run.density_deviation = sums.deviation / std::max(sums.deep_samples, 1.0);
    return run;
}

}  // namespace

SettledTankRun run_settled_tank(const Setting& setting, double rest, double window) {
    Scene scene = load_scene("thesis/tank");
    scene.scheme = setting.scheme;
    set_steps(steps_of(setting), scene.solver);
    const Model model = build_model(scene);
    return in_precision(setting.precision,
                        [&](auto real) { return run_as<decltype(real)>(model, scene.settling, rest, window); });
}

}  // namespace natator::bench
