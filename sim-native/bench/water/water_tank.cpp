#include "water/water_tank.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "model/disorder_fluid.h"
#include "model/fluid_block.h"
#include "natator/scene.h"
#include "natator/solver.h"
#include "physics/dfsph.h"
#include "solver/gpu_solver.h"

namespace natator::bench {
namespace {

constexpr double settling = 2;  ///< s

Model model_of(const Eigen::Vector3i& count, const WaterSetting& setting, const std::function<void(Model&)>& immerse) {
    const double spacing = spacing_of(setting);
    Model model;
    model.scheme = setting.solver.scheme;
    SolverParameters& p = model.parameters;
    p = thesis_tank().solver;
    set_steps(steps_of(setting.solver), p);
    p.fluid_rest_distance = spacing;
    p.conserving.kernel_support = setting.support;
    p.radius = p.solid_rest_distance = 1.5 * spacing;
    p.collision_distance = spacing / 2;
    p.flex.viscosity = p.damping = p.dynamic_friction = p.static_friction = p.particle_friction = 0;
    const FluidBlock block{.count = count,
                           .spacing = spacing,
                           .origin = Eigen::Vector3d::Constant(spacing / 2),
                           .gradient = MassGradient::uniform,
                           .bottom_mass = 1};
    add_fluid(block, model);
    if (immerse) immerse(model);
    constexpr int seed_before_first = 19;
    if (model.scheme == Scheme::conserving) disorder_fluid(spacing, model, seed_before_first + setting.start);
    model.planes = {{{0, 1, 0}, 0},
                    {{1, 0, 0}, 0},
                    {{-1, 0, 0}, count.x() * spacing},
                    {{0, 0, 1}, 0},
                    {{0, 0, -1}, count.z() * spacing}};
    return model;
}

/// That its substeps bear, length^2/s.
double max_viscosity(const Model& model) {
    return physics::max_viscosity(model.parameters.fluid_rest_distance, model.time_step / model.parameters.substeps);
}

}  // namespace

template <class Real>
WaterTank<Real>::WaterTank(const Eigen::Vector3i& count, const WaterSetting& setting, const Change& immerse)
    : setting_(setting),
      model_(std::make_shared<Model>(model_of(count, setting, immerse))),
      length_(count.x() * model_->parameters.fluid_rest_distance),
      state_(initial_state<Real>(*model_)) {
    settle();
    step_ = step_of(*model_);
}

/// Viscosity and damping bring the water to rest, whatever the run itself has.
template <class Real>
void WaterTank<Real>::settle() {
    Model calm = *model_;
    calm.parameters.flex.viscosity = FlexParameters().viscosity;
    calm.parameters.conserving.kinematic_viscosity = std::min(0.05, max_viscosity(calm));
    calm.parameters.damping = 4;
    const Step step = step_of(calm);
    for (long frame = 0; frame < std::lround(settling / calm.time_step) && !instability_; ++frame)
        instability_ = step(state_, calm.time_step, calm.parameters.substeps);
    for (auto& v : state_.velocity) v.setZero();
    state_.time = 0;
}

/// The step keeps its solver, and so do pressures and forces; `model` must live as long.
template <class Real>
typename WaterTank<Real>::Step WaterTank<Real>::step_of(const Model& model) {
    const auto step_by = [this](auto solver) -> Step {
        pressures_ = [solver] { return solver->pressures(); };
        forces_ = [solver] { return solver->forces(); };
        return
            [solver](State<Real>& state, double time, int substeps) { return solver->update(state, time, substeps); };
    };
    if (setting_.gpu)
        return step_by(
            std::make_shared<GpuSolver<Real>>(model, GpuSolverOptions{.device = *setting_.gpu, .forces = true}));
    return step_by(std::make_shared<Solver<Real>>(model, Execution{.forces = true}));
}

template <class Real>
bool WaterTank<Real>::advance(double time, int substeps) {
    using Clock = std::chrono::steady_clock;
    if (instability_) return false;
    const auto begin = Clock::now();
    instability_ = step_(state_, time, substeps);
    seconds_ += std::chrono::duration<double>(Clock::now() - begin).count();
    return !instability_;
}

template <class Real>
bool WaterTank<Real>::frame() {
    return advance(model_->time_step, model_->parameters.substeps);
}

template <class Real>
WaterRun WaterTank<Real>::follow(double duration, const std::function<double()>& value) {
    std::vector<WaterSample> curve{{0, value()}};
    const long frames = std::lround(duration / model_->time_step);
    for (long k = 1; k <= frames && frame(); ++k)
        curve.push_back({static_cast<double>(k) * model_->time_step, value()});
    WaterRun followed = run();
    followed.curve = std::move(curve);
    return followed;
}

template <class Real>
std::vector<int> WaterTank<Real>::held() const {
    std::vector<int> body;
    for (int i = 0; i < model_->particles(); ++i)
        if (model_->inverse_mass[i] == 0) body.push_back(i);
    return body;
}

template <class Real>
bool WaterTank<Real>::drive(const std::function<void()>& set_off,
                            const std::function<void(double, const std::vector<Vector3<Real>>&)>& arrive) {
    const int substeps = model_->parameters.substeps;
    const double h = model_->time_step / substeps;
    for (int k = 0; k < substeps; ++k) {
        set_off();
        if (!advance(h, 1)) return false;
        arrive(h, forces_());
    }
    return true;
}

template <class Real>
bool WaterTank<Real>::drive(const Motion& motion, Load& load) {
    const std::vector<int> body = held();
    const int substeps = model_->parameters.substeps;
    Eigen::Vector3d middle;
    const auto arm = [&](int i) -> Eigen::Vector3d { return state_.position[i].template cast<double>() - middle; };
    load = {};
    return drive(
        [&] {
            middle.setZero();
            for (const int i : body)
                middle += state_.position[i].template cast<double>() / static_cast<double>(body.size());
            for (const int i : body)
                state_.velocity[i] = (motion.velocity + motion.spin.cross(arm(i))).template cast<Real>();
        },
        [&](double h, const std::vector<Vector3<Real>>& forces) {
            const double angle = h * motion.spin.norm();
            const Eigen::Vector3d axis = angle > 0 ? motion.spin.normalized() : Eigen::Vector3d::UnitX();
            const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
            for (const int i : body) {
                const Eigen::Vector3d force = forces[i].template cast<double>() / substeps;
                load.force += force;
                load.moment += arm(i).cross(force);
            }
            for (const int i : body)
                state_.position[i] = (middle + h * motion.velocity + turn * arm(i)).template cast<Real>();
        });
}

template <class Real>
bool WaterTank<Real>::drive(const std::function<Eigen::Vector3d(int)>& velocity, std::vector<Eigen::Vector3d>& force) {
    const std::vector<int> body = held();
    const int substeps = model_->parameters.substeps;
    force.assign(model_->particles(), Eigen::Vector3d::Zero());
    return drive(
        [&] {
            for (const int i : body) state_.velocity[i] = velocity(i).template cast<Real>();
        },
        [&](double h, const std::vector<Vector3<Real>>& forces) {
            for (const int i : body) {
                force[i] += forces[i].template cast<double>() / substeps;
                state_.position[i] += (h * velocity(i)).template cast<Real>();
            }
        });
}

template <class Real>
void WaterTank<Real>::shift(double distance) {
    const Real length = static_cast<Real>(length_), by = static_cast<Real>(distance);
    for (int i = 0; i < model_->particles(); ++i) {
        state_.position[i].x() -= by;
        const Real x = state_.position[i].x();
        if ((by > 0 ? x >= 0 : x <= length) || !model_->is_fluid(i)) continue;
        state_.position[i].x() += by > 0 ? length : -length;
        state_.velocity[i].setZero();
    }
}

template <class Real>
double WaterTank<Real>::mean(const std::function<double(const Eigen::Vector3d&, const Eigen::Vector3d&)>& value) const {
    double sum = 0;
    for (int i = 0; i < model_->particles(); ++i)
        sum += value(state_.position[i].template cast<double>(), state_.velocity[i].template cast<double>());
    return sum / model_->particles();
}

template <class Real>
double WaterTank<Real>::depth() const {
    return 2 * mean([](const Eigen::Vector3d& x, const Eigen::Vector3d&) { return x.y(); });
}

template <class Real>
double WaterTank<Real>::sloshing_period() const {
    constexpr double wave_number = std::numbers::pi / water_length;
    const double gravity = model_->parameters.gravity.norm();
    return 2 * std::numbers::pi / std::sqrt(gravity * wave_number * std::tanh(wave_number * depth()));
}

template <class Real>
void WaterTank<Real>::change(const Change& how) {
    auto changed = std::make_shared<Model>(*model_);
    how(*changed);
    step_ = step_of(*changed);
    model_ = changed;
}

template <class Real>
void WaterTank<Real>::set_gravity(const Eigen::Vector3d& gravity) {
    change([&](Model& model) { model.parameters.gravity = gravity; });
}

template <class Real>
bool WaterTank<Real>::set_kinematic_viscosity(double viscosity) {
    if (model_->scheme == Scheme::conserving && viscosity > max_viscosity(*model_)) return false;
    change([&](Model& model) { model.parameters.conserving.kinematic_viscosity = viscosity; });
    return true;
}

template <class Real>
WaterRun WaterTank<Real>::run() const {
    WaterRun run;
    run.particles = model_->particles();
    run.seconds = seconds_;
    run.instability = instability_;
    return run;
}

std::vector<int> hold(const std::function<bool(const Eigen::Vector3d&)>& inside, Model& model) {
    std::vector<int> body;
    for (int i = 0; i < model.particles(); ++i) {
        if (!inside(model.position[i])) continue;
        model.phase[i] = 1;
        model.inverse_mass[i] = 0;
        body.push_back(i);
    }
    return body;
}

template class WaterTank<float>;
template class WaterTank<double>;

}  // namespace natator::bench
