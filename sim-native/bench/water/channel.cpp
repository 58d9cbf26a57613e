#include <cmath>
#include <vector>

#include "water/water_tank.h"

namespace natator::bench {
namespace {

constexpr double height = water_length / 2;      ///< H, between the walls, which stand along x and y
constexpr double length = 4 * height;            ///< along x, to blocks that close the ends
constexpr double counted_length = 1.5 * height;  ///< in the middle, where the ends are no longer felt
constexpr double viscosity = 0.025;              ///< length^2/s
constexpr double developing = 2, counted = 6;    ///< s
constexpr int layers = 8;
constexpr int wall_layers = 3;   ///< of particles that a wall is thick: further than the water feels
constexpr int block_layers = 6;  ///< that the ends are: twice as far
constexpr double apart = 2;      ///< particle distances from the walls, where the water's own flow is taken

/// Flow between two walls that move along themselves. No water passes in the mean, since the ends are closed.
struct Channel {
    double left, right;  ///< speeds of the walls along x, length/s

    double difference() const { return right - left; }
    double mean() const { return (left + right) / 2; }

    /// Of the water far from the ends, `across` in parts of H from the middle: the flow of Couette for the difference
    /// of the speeds, and that of Poiseuille for their mean.
    double velocity(double across) const { return difference() * across - mean() / 2 * (1 - 12 * across * across); }
    /// Of that flow at the right wall, 1/s.
    double shear() const { return (difference() + 6 * mean()) / height; }
    /// Along x, which makes that flow without a slope of the surface, length/s^2.
    double gravity() const { return -12 * viscosity * mean() / (height * height); }
    /// What each particle of the water dissipates, mass length^2/s^3.
    double power() const {
        return viscosity * (difference() * difference() + 12 * mean() * mean()) / (height * height);
    }
};

/// Least squares of the water's velocities by offset + part times the exact ones.
class Fit {
public:
    void add(double exact, double velocity) {
        ++count_;
        exact_ += exact;
        velocity_ += velocity;
        square_ += exact * exact;
        product_ += exact * velocity;
    }
    double part() const { return (count_ * product_ - exact_ * velocity_) / (count_ * square_ - exact_ * exact_); }
    double offset() const { return (velocity_ - part() * exact_) / count_; }

private:
    double count_ = 0, exact_ = 0, velocity_ = 0, square_ = 0, product_ = 0;
};

/// The walls are endless belts: what leaves the box at one end comes in again at the other, where no water feels it.
/// What moves them in the middle is what the water there dissipates. The viscosity is that of the water's own flow,
/// apart from the walls; how it goes with these is in their drag and in the slip length, by which they seem to stand
/// further apart.
template <class Real>
WaterRun run_as(const Channel& channel, const WaterSetting& setting) {
    const double spacing = spacing_of(setting);
    const int across = particles_along(height, setting), along = particles_along(length, setting) + 2 * block_layers;
    const int columns = particles_along(counted_length, setting);
    const double left = wall_layers * spacing, right = left + across * spacing;
    const double front = block_layers * spacing, end = along * spacing;
    const double begin_middle = (along - columns) / 2 * spacing, end_middle = begin_middle + columns * spacing;
    const auto is_wall = [&](const Eigen::Vector3d& x) { return x.z() < left || x.z() > right; };
    const auto is_block = [&](const Eigen::Vector3d& x) { return x.x() < front || x.x() > end - front; };
    std::vector<int> walls;
    WaterTank<Real> tank({along, layers, across + 2 * wall_layers}, setting, [&](Model& model) {
        model.parameters.gravity = {0, -1, 0};
        walls = hold(is_wall, model);
        hold(is_block, model);
    });
    if (!tank.set_kinematic_viscosity(viscosity)) return tank.run();
    tank.set_gravity(tank.model().parameters.gravity + Eigen::Vector3d(channel.gravity(), 0, 0));
    const Model& model = tank.model();
    State<Real>& state = tank.state();
    const auto x = [&](int i) { return static_cast<double>(state.position[i].x()); };
    const auto z = [&](int i) { return static_cast<double>(state.position[i].z()); };
    const auto wall_speed = [&](int i) { return z(i) < left ? channel.left : z(i) > right ? channel.right : 0; };
    const auto place_across = [&](int i) { return (z(i) - left) / (right - left) - 0.5; };
    const auto in_middle = [&](int i) { return begin_middle <= x(i) && x(i) < end_middle; };
    for (int i = 0; i < model.particles(); ++i)
        if (model.is_fluid(i)) state.velocity[i].x() = static_cast<Real>(channel.velocity(place_across(i)));

    Fit fit;
    double drag = 0;
    std::vector<WaterSample> curve;
    std::vector<Eigen::Vector3d> force;
    const auto frames = [&](double duration) { return std::lround(duration / model.time_step); };
    for (long frame = 1; frame <= frames(developing + counted); ++frame) {
        if (!tank.drive([&](int i) -> Eigen::Vector3d { return {wall_speed(i), 0, 0}; }, force)) return tank.run();
        const bool counts = frame > frames(developing);
        double power = 0, water = 0;
        for (const int i : walls) {
            if (in_middle(i)) power -= force[i].x() * wall_speed(i);
            if (x(i) < 0) state.position[i].x() += static_cast<Real>(end);
            if (x(i) >= end) state.position[i].x() -= static_cast<Real>(end);
        }
        for (int i = 0; i < model.particles(); ++i) {
            if (!model.is_fluid(i) || !in_middle(i)) continue;
            ++water;
            if (counts && std::abs(place_across(i)) < 0.5 - apart / across)
                fit.add(channel.velocity(place_across(i)), static_cast<double>(state.velocity[i].x()));
        }
        curve.push_back({static_cast<double>(frame) * model.time_step, power / (water * channel.power())});
        if (counts) drag += curve.back().value;
    }
    WaterRun run = tank.run();
    if (run.instability) return run;
    drag /= static_cast<double>(frames(counted));
    const double slip = channel.right - fit.offset() - fit.part() * channel.velocity(0.5);
    run.figures = {figure_within(0.05, viscosity * drag / fit.part(), viscosity),
                   figure_within(0.05, drag, 1),
                   {.value = slip / (fit.part() * channel.shear()) / spacing, .reference = 0}};
    run.curve = curve;
    return run;
}

WaterRun run_channel(const Channel& channel, const WaterSetting& setting) {
    return in_precision(setting.solver.precision, [&](auto real) { return run_as<decltype(real)>(channel, setting); });
}

}  // namespace

/// The walls move past each other.
WaterRun run_couette(const WaterSetting& setting) {
    return run_channel({.left = -0.2, .right = 0.2}, setting);
}

/// They move together, and the water that they take along flows back between them.
WaterRun run_poiseuille(const WaterSetting& setting) {
    return run_channel({.left = 0.2, .right = 0.2}, setting);
}

}  // namespace natator::bench
