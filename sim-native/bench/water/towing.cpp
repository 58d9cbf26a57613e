#include "water/towing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "water/water_tank.h"

namespace natator::bench {
namespace {

template <class Real>
TowResult tow_as(const Towing& towing, const WaterSetting& setting) {
    double particles = 0;
    WaterTank<Real> tank(towing.count, setting, [&](Model& model) {
        model.parameters.gravity = {0, -towing.gravity, 0};
        const auto inside = [&](const Eigen::Vector3d& x) {
            Eigen::Vector3d arm = x - towing.middle;
            if (towing.cylinder) arm.z() = 0;
            return arm.norm() <= towing.diameter / 2;
        };
        particles = static_cast<double>(hold(inside, model).size());
    });
    const double spacing = tank.model().parameters.fluidRestDistance;
    const double volume = particles * std::pow(spacing, 3), width = towing.count.z() * spacing;
    const double density = 1 / std::pow(spacing, 3);  // particles of mass 1

    TowResult result;
    result.diameter = towing.cylinder ? std::sqrt(4 * volume / (std::numbers::pi * width))
                                      : diameter_of_sphere(volume);
    const double diameter = result.diameter;
    const double area = diameter * (towing.cylinder ? width : std::numbers::pi / 4 * diameter);
    const double scale = density * towing.speed * towing.speed / 2 * area;
    const double weight = density * volume * towing.gravity;
    const double frame = tank.model().time_step, step = std::ceil(diameter / spacing) * spacing;
    double time = 0, way = 0, unshifted = 0;
    for (const Towing::Leg& leg : towing.legs) {
        tank.set_kinematic_viscosity(towing.speed * diameter / leg.reynolds);
        result.legs.emplace_back();
        for (double own_way = 0; own_way < leg.way * diameter;) {
            const double speed = towing.speed * std::min(1.0, (way + 0.05 * diameter) / diameter);
            Load load;
            if (!tank.drive({.velocity = {speed, 0, 0}}, load)) {
                result.run = tank.run();
                return result;
            }
            time += frame;
            way += frame * speed;
            own_way += frame * speed;
            unshifted += frame * speed;
            result.legs.back().push_back(
                {time, own_way / diameter, -load.force.x() / scale, (load.force.y() - weight) / scale});
            if (unshifted < step) continue;
            tank.shift(step);
            unshifted -= step;
        }
    }
    result.run = tank.run();
    return result;
}

}  // namespace

TowResult tow(const Towing& towing, const WaterSetting& setting) {
    return in_precision(setting.solver.precision, [&](auto real) { return tow_as<decltype(real)>(towing, setting); });
}

double mean(const std::vector<TowSample>& leg, double TowSample::* coefficient, double begin) {
    double sum = 0;
    int count = 0;
    for (const TowSample& sample : leg) {
        if (sample.way < begin) continue;
        sum += sample.*coefficient;
        ++count;
    }
    return sum / count;
}

std::vector<WaterSample> smoothed(const TowResult& result, double TowSample::* coefficient) {
    std::vector<WaterSample> curve;
    for (const auto& leg : result.legs) {
        double sum = 0, end = 0.25;
        int count = 0;
        for (const TowSample& sample : leg) {
            sum += sample.*coefficient;
            ++count;
            if (sample.way < end) continue;
            curve.push_back({sample.time, sum / count});
            sum = 0;
            count = 0;
            end += 0.25;
        }
    }
    return curve;
}

}  // namespace natator::bench
