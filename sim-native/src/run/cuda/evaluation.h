#pragma once

#include <vector>

#include "run/evaluation_run.h"
#include "solver/cuda/refusal.h"

namespace natator::cuda {

/// The result of a run whose particles have their device numbers in its instability, and whose fluid has `densities` by
/// those. `settled`: it has not become unstable while it settled.
template <class Real>
Evaluation finish(EvaluationRun& run, const Scene& scene, const Model& model, const std::vector<int>& particle_of,
                  const Gait& gait, bool settled, const State<Real>& begin, const State<Real>& end,
                  const Real* densities, std::size_t fluid) {
    if (std::optional<Instability>& found = run.instability()) {
        found->particle = found->particle < model.particles() ? particle_of[found->particle] : 0;
        if (found->law == Instability{}.law) {
            State<Real> before = end;
            before.time = found->time;
            const double step = settled ? scene.time_step : scene.settling.time_step;
            const int substeps = settled ? model.parameters.substeps : scene.settling.substeps;
            const Drive drive = settled ? [&](double time) { return natator::drive(model, gait, time); } : Drive{};
            found = located(model, before, drive, step, substeps, run.frames() * scene.time_step, *found);
        }
    }
    std::vector<Real> density(model.particles(), Real(0));
    for (std::size_t number = 0; number < fluid; ++number)
        if (model.inverse_mass[particle_of[number]] > 0) density[particle_of[number]] = densities[number];
    return run.finish(begin, end, density);
}

}  // namespace natator::cuda
