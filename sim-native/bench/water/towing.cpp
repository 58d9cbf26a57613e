#include "water/towing.h"

#include <algorithm>
#include <cmath>
#include <limits>
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
    const double spacing = tank.model().parameters.fluid_rest_distance;
    const double volume = particles * std::pow(spacing, 3), width = towing.count.z() * spacing;
    const double density = 1 / std::pow(spacing, 3);  // particles of mass 1

    TowResult result;
    result.diameter = towing.cylinder ? std::sqrt(4 * volume / (std::numbers::pi * width)) : diameter_of_sphere(volume);
    const double diameter = result.diameter;
    const double area = diameter * (towing.cylinder ? width : std::numbers::pi / 4 * diameter);
    const double scale = density * towing.speed * towing.speed / 2 * area;
    const double weight = density * volume * towing.gravity;
    const double frame = tank.model().time_step, step = std::ceil(diameter / spacing) * spacing;
    result.box_step = step / diameter;
    double time = 0, way = 0, unshifted = 0;
    for (const Towing::Leg& leg : towing.legs) {
        if (!tank.set_kinematic_viscosity(towing.speed * diameter / leg.reynolds)) break;
        result.legs.emplace_back();
        for (double own_way = 0; own_way < leg.way * diameter;) {
            const double speed = towing.speed * std::min(1.0, (way + 0.05 * diameter) / diameter);
            Load load;
            const double phase = 2 * std::numbers::pi * way / (10 * diameter);
            const double across = way < 10 * diameter ? towing.sway * speed * std::sin(phase) : 0;
            if (!tank.drive({.velocity = {speed, across, 0}}, load)) {
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

/// When it has come so far on a leg, diameters.
double time_at(const std::vector<TowSample>& leg, double way) {
    const auto there = std::ranges::find_if(leg, [&](const TowSample& sample) { return sample.way >= way; });
    return there == leg.end() ? std::numeric_limits<double>::infinity() : there->time;
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

std::vector<WaterSample> calm_lift(const TowResult& result) {
    const std::vector<TowSample>& leg = result.legs.back();
    std::vector<WaterSample> lift;
    for (const TowSample& sample : leg) lift.push_back({sample.time, sample.lift});
    for (int k = 0; k < 3; ++k) {
        const std::vector<WaterSample> before = lift;
        double sum = 0;
        for (std::size_t last = 0, first = 0; last < leg.size(); ++last) {
            sum += before[last].value;
            while (leg[last].way - leg[first].way >= result.box_step) sum -= before[first++].value;
            lift[last].value = sum / static_cast<double>(last - first + 1);
        }
    }
    return lift;
}

double lift_frequency(const TowResult& result, double begin) {
    const std::vector<TowSample>& leg = result.legs.back();
    std::vector<WaterSample> calm = calm_lift(result);
    const double from_time = time_at(leg, begin);
    std::erase_if(calm, [&](const WaterSample& sample) { return sample.time < from_time; });
    double mean_lift = 0, squares = 0;
    for (const WaterSample& sample : calm) mean_lift += sample.value / static_cast<double>(calm.size());
    for (WaterSample& sample : calm) {
        sample.value -= mean_lift;
        squares += sample.value * sample.value;
    }
    // Counted only where it has been well below the mean since the last swing, so that noise makes none.
    const double well_below = -0.3 * std::sqrt(squares / static_cast<double>(calm.size()));
    double from = 0, to = 0;
    int swings = -1;
    bool below = false;
    for (const WaterSample& sample : calm) {
        if (sample.value < well_below) below = true;
        if (!below || sample.value < 0) continue;
        below = false;
        if (++swings == 0) from = sample.time;
        to = sample.time;
    }
    return swings > 0 ? swings / (to - from) : 0;
}

}  // namespace natator::bench
