#include "stability.h"

#include <algorithm>
#include <cmath>

#include "in_precision.h"
#include "natator/measure.h"
#include "natator/model.h"
#include "physics/laws.h"
#include "run/conservation_errors.h"
#include "run/moving_tank.h"
#include "run/settle.h"

namespace natator::bench {
namespace {

constexpr int min_frames = 8;

/// Moves a tank that goes along with its swimmer: whether it did.
template <class Real>
bool follow(std::optional<MovingFrame>& follower, const Model& model, State<Real>& state) {
    if (!follower) return false;
    follower->drift(model.time_step);
    const Eigen::Vector3d centre = mean_place(body_places_in_tank(model.body, state));
    if (!follower->is_due(centre)) return false;
    follower->follow(centre, state);
    return true;
}

/// `solver`: a Solver or a GpuSolver.
template <class Real, class AnySolver>
StabilityResult run_by(AnySolver&& solver, const StabilityCase& subject, const Model& model) {
    const int frames = std::max(min_frames, static_cast<int>(std::lround(subject.scene.duration / model.time_step)));
    const int first_judged = static_cast<int>(std::lround(subject.judged_from * frames));
    LawWatch laws(model);
    laws.drive_by(subject.gait);
    std::optional<MovingFrame> follower;
    if (subject.scene.moving_tank) follower.emplace(subject.scene, model);

    State<Real> state = initial_state<Real>(model);
    StabilityResult result;
    std::optional<Instability>& instability = result.instability;
    instability = settle(subject.scene.settling, solver, state);
    if (!instability && first_judged == 0) instability = laws.start(measure_laws(model, state));
    for (int frame = 1; frame <= frames && !instability; ++frame) {
        instability = solver.frame(state, subject.gait);
        if (instability) break;
        state.time = frame * model.time_step;
        if (frame >= first_judged)
            instability = laws.look(measure_laws(model, state), solver.all_muscle_work(), state.time);
        if (!instability && follow(follower, model, state)) laws.restart();
    }
    if (!instability)
        instability = laws.look_at_compression(conservation_errors(model, state, solver.densities()).density_error_mean,
                                               state.time);
    result.time = state.time;
    result.margins = laws.margins();
    return result;
}

}  // namespace

StabilityResult run_stability(const StabilityCase& subject, Precision precision,
                              const std::optional<GpuSolverOptions>& gpu) {
    Model model = build_model(subject.scene);
    if (subject.rearrange) subject.rearrange(model);
    return in_precision(precision, [&](auto real) {
        using Real = decltype(real);
        return gpu ? run_by<Real>(GpuSolver<Real>(model, *gpu), subject, model)
                   : run_by<Real>(Solver<Real>(model), subject, model);
    });
}

}  // namespace natator::bench
