#pragma once

#include <optional>
#include <string>
#include <utility>

#include "laws.h"
#include "model_on_gpu.h"
#include "moving_tank.h"
#include "natator/cost.h"
#include "natator/evaluate.h"
#include "natator/model.h"
#include "natator/simulation.h"
#include "perturb.h"
#include "settled_start.h"

namespace natator {

/// The scene's model, if a stream of it does not cost too much.
inline Model affordable_model(const Scene& scene, std::optional<double> until, const Computing& computing) {
    Model model = build_model(scene);
    check_live_cost(scene, model, until, computing);
    return model;
}

/// A scene with all that is made of it. Stays where it is, for the solver refers to the model.
template <class Real>
struct Simulation<Real>::Run {
    Run(Scene of, const Perturbation& by, const SimulationSetup& setup, const Execution& execution)
        : scene(std::move(of)),
          perturbation(by),
          model(affordable_model(scene, setup.until,
                                 {.doubles = sizeof(Real) > sizeof(float), .several_threads = execution.threads > 1})),
          device_model(execution.gpu ? std::optional(model_on_gpu(scene, model)) : std::nullopt),
          solver(device_model ? *device_model : model, execution),
          laws(model) {
        if (scene.moving_tank) follower.emplace(scene, model);
    }

    /// The start at rest; settled once. Sets `instability` if settling was unstable.
    State<Real> begin(const SettledStateCache* starts, std::optional<Instability>& instability) {
        if (settled) return *settled;
        State<Real> state = perturbation.amplitude == 0
                                ? settled_start(model, scene.settling, solver, starts, instability)
                                : shifted_start(instability);
        if (!instability) settled = state;
        return state;
    }

    /// As in `evaluate` never from the cache: there are as many as seeds.
    State<Real> shifted_start(std::optional<Instability>& instability) {
        Model shifted = model;
        perturb(perturbation, shifted);
        return settled_start<Real>(shifted, scene.settling, solver, nullptr, instability);
    }

    Scene scene;
    Perturbation perturbation;
    Model model;
    std::optional<Model> device_model;  ///< of the solver, on a GPU
    Solver<Real> solver;
    LawWatch laws;
    std::optional<MovingFrame> follower;
    std::optional<State<Real>> settled;
    std::optional<std::uint64_t> digest;  ///< of scene and model, once asked for: Simulation::save
};

}  // namespace natator
