#pragma once

#include "natator/evaluate.h"
#include "natator/measure.h"
#include "run/conservation_errors.h"
#include "run/laws.h"
#include "solver/cuda/refusal.h"
#include "solver/flex/cuda/batch_runner.h"
#include "solver/law_name.h"

namespace natator::cuda {

/// What a member's run has come to. `gait` is null for a State that became unstable while it settled; `path` has the
/// body's mean x by frame, `tail` the mean z of its last slice (empty where nobody swims in water), `densities` the fluid's
/// by device number.
template <class Real>
Evaluation evaluation_of(const Scene& scene, const Model& model, const std::vector<int>& particle_of,
                         const Progress& progress, const Gait* gait, const double* path, const std::vector<double>& tail,
                         const State<Real>& end, const std::vector<Real>& densities) {
    Evaluation evaluation;
    evaluation.frames = progress.frames;
    evaluation.simulated = progress.frames * scene.time_step;
    evaluation.distance = progress.frames > 0 ? path[progress.frames] - path[0] : 0;
    evaluation.hash = state_hash(end);
    if (progress.stopped >= 0) evaluation.stopped = static_cast<StopReason>(progress.stopped);
    if (evaluation.stopped == StopReason::unstable && progress.broken != physics::Law::finite) {
        evaluation.instability = Instability{particle_of[progress.bad_particle], evaluation.frames > 0 ? "frame" : "settling",
                                             progress.bad_time, name(progress.broken)};
        return evaluation;
    }
    if (evaluation.stopped == StopReason::unstable) {
        State<Real> before = end;
        before.time = progress.bad_time;
        const int bad = progress.bad_particle < model.particles() ? particle_of[progress.bad_particle] : 0;
        const double step = gait ? scene.time_step : scene.settling.time_step;
        const int substeps = gait ? model.parameters.substeps : scene.settling.substeps;
        evaluation.instability =
            located(model, before, gait, step, substeps, evaluation.simulated, {bad, "velocities", progress.bad_time});
        return evaluation;
    }
    std::vector<Real> density(model.particles(), Real(0));
    for (std::size_t number = 0; number < densities.size(); ++number)
        if (model.inverse_mass[particle_of[number]] > 0) density[particle_of[number]] = densities[number];
    evaluation.errors = conservation_errors(model, end, density);
    evaluation.instability = broken_by_compression(evaluation.errors.density_error_mean, evaluation.simulated);
    if (evaluation.instability) {
        evaluation.stopped = StopReason::unstable;
        return evaluation;
    }
    if (gait && !tail.empty())
        evaluation.swimming = swimming_numbers(model, *gait, scene.through_water(evaluation.distance, evaluation.simulated),
                                                evaluation.simulated, tail);
    if (evaluation.swimming) evaluation.swimming->cavities = cavities(model, end, density);
    if (has_muscle_work(model)) evaluation.work = progress.muscle_work;
    if (!model.body.particles.empty()) evaluation.course = course_of(model, model.body, end, evaluation.distance);
    return evaluation;
}

}  // namespace natator::cuda
