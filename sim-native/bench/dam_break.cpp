#include "dam_break.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "in_precision.h"
#include "model/disorder_fluid.h"
#include "model/fluid_block.h"
#include "scene/scene_json.h"
#include "statistics.h"

namespace natator::bench {
namespace {

constexpr int depth = 10;                   ///< particles across the plane of the flow
constexpr double settling = 1;              ///< s
constexpr double calming_viscosity = 0.02;  ///< length^2/s, while settling

/// Length along x between wall and gate.
double base_of(const Model& model) {
    return model.planes.back().offset;
}

/// The flow is plane: its front is the median over slices across it of the foremost particle, so that a single drop
/// that flies ahead does not count.
template <class Real>
double front_of(const Model& model, const State<Real>& state) {
    const double slice = model.parameters.fluid_rest_distance;
    std::vector<double> foremost(depth, 0);
    for (int i = 0; i < model.particles(); ++i) {
        const int k = std::clamp(static_cast<int>(static_cast<double>(state.position[i].z()) / slice), 0, depth - 1);
        foremost[k] = std::max(foremost[k], static_cast<double>(state.position[i].x()));
    }
    return median(foremost) + model.parameters.collision_distance;
}

/// Twice the mean height: that of a column of even density.
template <class Real>
double height_of(const Model& model, const State<Real>& state) {
    double sum = 0;
    for (const auto& x : state.position) sum += static_cast<double>(x.y());
    return 2 * sum / model.particles();
}

/// The column at rest: the thesis' viscosity and damping make it so, whatever the run itself has.
template <class Real>
std::optional<Instability> settle_behind_gate(const Model& model, State<Real>& state) {
    Model calm = model;
    calm.parameters.flex.viscosity = FlexParameters().viscosity;
    calm.parameters.damping = SolverParameters().damping;
    calm.parameters.conserving.kinematic_viscosity = calming_viscosity;
    Solver<Real> solver(calm);
    for (int frame = 0; frame < std::lround(settling / model.time_step); ++frame)
        if (auto instability = solver.update(state, model.time_step, model.parameters.substeps)) return instability;
    for (auto& v : state.velocity) v.setZero();
    state.time = 0;
    return std::nullopt;
}

template <class Real>
DamBreakRun run_as(const DamBreak& column, const Model& model, double last_time) {
    using Clock = std::chrono::steady_clock;
    const double base = base_of(model);
    const double per_second = std::sqrt(column.height_over_base * model.parameters.gravity.norm() / base);
    State<Real> state = initial_state<Real>(model);
    DamBreakRun run;
    run.particles = model.particles();
    run.instability = settle_behind_gate(model, state);
    if (run.instability) return run;
    run.start_height = height_of(model, state) / base;

    Model open = model;
    open.planes.pop_back();
    Solver<Real> solver(open);
    run.front.push_back({0, front_of(open, state) / base});
    while (run.front.back().time < last_time) {
        const auto begin = Clock::now();
        run.instability = solver.update(state, open.time_step, open.parameters.substeps);
        run.seconds += std::chrono::duration<double>(Clock::now() - begin).count();
        if (run.instability) return run;
        const double frames = static_cast<double>(run.front.size());
        run.front.push_back({frames * open.time_step * per_second, front_of(open, state) / base});
    }
    return run;
}

}  // namespace

Model dam_break_model(const DamBreak& column, Scheme scheme) {
    const Scene scene = load_scene("thesis/tank");
    Model model;
    model.scheme = scheme;
    model.parameters = scene.solver;
    model.time_step = scene.time_step;
    if (column.ideal) {
        SolverParameters& p = model.parameters;
        p.flex.viscosity = p.damping = p.dynamic_friction = p.static_friction = p.particle_friction = 0;
    }
    FluidBlock block = scene.fluid.value();
    if (scheme == Scheme::conserving)
        block.spacing = model.parameters.fluid_rest_distance;  // its lattice at rest density
    block.count = {column.width, column.height_over_base * column.width, depth};
    block.gradient = MassGradient::uniform;
    block.bottom_mass = 1;
    add_fluid(block, model);
    const Eigen::Vector3d far = block.origin + block.spacing * (block.count.cast<double>().array() - 1).matrix() +
                                Eigen::Vector3d::Constant(model.parameters.collision_distance);
    model.planes = {{{0, 1, 0}, 0}, {{0, 0, 1}, 0}, {{1, 0, 0}, 0}, {{0, 0, -1}, far.z()}, {{-1, 0, 0}, far.x()}};
    if (scheme == Scheme::conserving) disorder_fluid(block.spacing, model);
    return model;
}

DamBreakRun run_dam_break(const DamBreak& column, const Setting& setting, double last_time) {
    Model model = dam_break_model(column, setting.scheme);
    set_steps(steps_of(setting), model.parameters);
    return in_precision(setting.precision, [&](auto real) { return run_as<decltype(real)>(column, model, last_time); });
}

}  // namespace natator::bench
