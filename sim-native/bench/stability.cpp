#include "stability.h"

#include <algorithm>
#include <cmath>

#include "evaluate/settle.h"
#include "in_precision.h"
#include "natator/model_builder.h"
#include "physical_bounds.h"

namespace natator::bench {
namespace {

constexpr int fewest_frames = 8;
constexpr double most_compression = 1;  ///< mean of max(rho - 1, 0) of a fluid that has collapsed

/// Notes the first thing that is physically impossible.
void note_divergence(StabilityResult& result, const char* what, int particle, double time) {
    if (result.verdict != Verdict::ok) return;
    result.verdict = Verdict::diverged;
    result.stage = what;
    result.particle = particle;
    result.time = time;
}

template <class Real>
void watch_motion(const Model& model, const State<Real>& state, const PhysicalBounds& bounds, StabilityResult& result) {
    int fastest = 0;
    double speed = 0, energy = 0;
    for (int i = 0; i < model.particles(); ++i) {
        const double v = state.velocity[i].template cast<double>().norm();
        if (v > speed) {
            speed = v;
            fastest = i;
        }
        if (model.inverse_mass[i] > 0) energy += v * v / model.inverse_mass[i] / 2;
    }
    result.max_speed = std::max(result.max_speed, speed);
    result.max_kinetic_energy = std::max(result.max_kinetic_energy, energy);
    if (speed > bounds.speed) note_divergence(result, "speed", fastest, state.time);
    if (energy > bounds.kinetic_energy) note_divergence(result, "energy", fastest, state.time);
}

template <class Real>
void check_places(const Model& model, const State<Real>& state, StabilityResult& result) {
    for (int i = 0; i < model.particles(); ++i) {
        const Eigen::Vector3d place = state.position[i].template cast<double>();
        const bool outside = std::any_of(model.planes.begin(), model.planes.end(), [&](const Plane& plane) {
            return plane.distance(place) < -model.parameters.radius;
        });
        if (!outside) continue;
        ++result.outside;
        note_divergence(result, "outside", i, state.time);
    }
}

template <class Real>
double mean_compression(const Model& model, Solver<Real>& solver) {
    const std::vector<Real> densities = solver.densities();
    double sum = 0;
    int fluid = 0;
    for (int i = 0; i < model.particles(); ++i) {
        if (!model.is_fluid(i)) continue;
        sum += std::max(static_cast<double>(densities[i]) - 1, 0.0);
        ++fluid;
    }
    return fluid > 0 ? sum / fluid : 0;
}

template <class Real>
StabilityResult run_as(const StabilityCase& subject, const Model& model) {
    const PhysicalBounds bounds = physical_bounds(model, subject.gait);
    Solver<Real> solver(model);
    State<Real> state = initial_state<Real>(model);
    StabilityResult result;
    std::optional<Instability> instability = settle(subject.scene.settling, solver, state);
    const int frames = std::max(fewest_frames, static_cast<int>(std::lround(subject.scene.duration / model.time_step)));
    for (int frame = 0; frame < frames && !instability; ++frame) {
        instability = solver.frame(state, subject.gait);
        watch_motion(model, state, bounds, result);
    }
    check_places(model, state, result);
    if (instability) {
        result.verdict = Verdict::unstable;
        result.particle = instability->particle;
        result.stage = instability->stage;
        result.time = instability->time;
        return result;
    }
    result.compression = mean_compression(model, solver);
    if (result.compression > most_compression) note_divergence(result, "compression", -1, state.time);
    if (result.verdict == Verdict::ok) result.time = state.time;
    return result;
}

}  // namespace

StabilityResult run_stability(const StabilityCase& subject, Precision precision) {
    Model model = build_model(subject.scene);
    if (subject.rearrange) subject.rearrange(model);
    return in_precision(precision, [&](auto real) { return run_as<decltype(real)>(subject, model); });
}

}  // namespace natator::bench
