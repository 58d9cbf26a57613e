#include <algorithm>
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

/// Flow between two walls that move along themselves. No water passes in the mean, since the ends are closed.
struct Channel {
    double left, right;  ///< speeds of the walls along x, length/s

    double difference() const { return right - left; }
    double mean() const { return (left + right) / 2; }

    /// Of the water far from the ends, `across` in parts of H from the middle: the flow of Couette for the difference of
    /// the speeds, and that of Poiseuille for their mean.
    double velocity(double across) const {
        return difference() * across - mean() / 2 * (1 - 12 * across * across);
    }
    /// Along x, which makes that flow without a slope of the surface, length/s^2.
    double gravity() const { return -12 * viscosity * mean() / (height * height); }
    /// Integral of the shear's square over H, length/s^2.
    double dissipation() const {
        return (difference() * difference() + 12 * mean() * mean()) / height;
    }
};

/// The middle of the channel, summed over frames.
struct Middle {
    std::vector<double> velocity, particles;  ///< of the water, in layers across, a spacing thick
    double power = 0;                         ///< that moves the walls, mass length^2/s^3

    double water() const {
        double sum = 0;
        for (const double count : particles) sum += count;
        return sum;
    }
};

/// The walls are endless belts: what leaves the box at one end comes in again at the other, where no water feels it. What
/// moves them in the middle is what the water there dissipates.
template <class Real>
WaterRun run_as(const Channel& channel, const WaterSetting& setting) {
    const double spacing = water_length / setting.resolution;
    const auto particles = [&](double extent) { return static_cast<int>(std::lround(extent / spacing)); };
    const int across = particles(height), along = particles(length) + 2 * block_layers, columns = particles(counted_length);
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
    tank.set_kinematic_viscosity(viscosity);
    tank.set_gravity(tank.model().parameters.gravity + Eigen::Vector3d(channel.gravity(), 0, 0));
    const Model& model = tank.model();
    State<Real>& state = tank.state();
    const auto x = [&](int i) { return static_cast<double>(state.position[i].x()); };
    const auto z = [&](int i) { return static_cast<double>(state.position[i].z()); };
    const auto wall_speed = [&](int i) { return z(i) < left ? channel.left : z(i) > right ? channel.right : 0; };
    const auto in_middle = [&](int i) { return begin_middle <= x(i) && x(i) < end_middle; };

    const auto place_across = [&](int i) { return (z(i) - left) / (right - left); };
    for (int i = 0; i < model.particles(); ++i)
        if (model.is_fluid(i)) state.velocity[i].x() = static_cast<Real>(channel.velocity(place_across(i) - 0.5));

    Middle middle{std::vector<double>(across), std::vector<double>(across)};
    std::vector<WaterSample> curve;
    std::vector<Eigen::Vector3d> force;
    const double full_power = viscosity * channel.dissipation() / height;  // a particle of the water's
    for (double time = model.time_step; time < developing + counted; time += model.time_step) {
        if (!tank.drive([&](int i) -> Eigen::Vector3d { return {wall_speed(i), 0, 0}; }, force)) return tank.run();
        double power = 0, water = 0;
        for (const int i : walls) {
            if (in_middle(i)) power -= force[i].x() * wall_speed(i);
            if (x(i) < 0) state.position[i].x() += static_cast<Real>(end);
            if (x(i) >= end) state.position[i].x() -= static_cast<Real>(end);
        }
        for (int i = 0; i < model.particles(); ++i) {
            if (!model.is_fluid(i) || !in_middle(i)) continue;
            ++water;
            if (time < developing) continue;
            const int layer = std::clamp(static_cast<int>(place_across(i) * across), 0, across - 1);
            middle.velocity[layer] += static_cast<double>(state.velocity[i].x());
            ++middle.particles[layer];
        }
        if (time >= developing) middle.power += power;
        curve.push_back({time, power / (water * full_power)});
    }
    WaterRun run = tank.run();
    if (run.instability) return run;

    double deviation = 0;  // the largest
    for (int layer = 0; layer < across; ++layer) {
        const double exact = channel.velocity((layer + 0.5) / across - 0.5);
        deviation = std::max(deviation, std::abs(middle.velocity[layer] / middle.particles[layer] - exact));
    }
    const double speed = std::max(std::abs(channel.difference()), 1.5 * std::abs(channel.mean()));
    run.figures = {figure_within(0.05, viscosity * middle.power / (middle.water() * full_power), viscosity),
                   {.value = deviation / speed, .reference = 0, .least = 0, .greatest = 0.05}};
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
