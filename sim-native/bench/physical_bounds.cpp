#include "physical_bounds.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace natator::bench {
namespace {

/// Length over which particles can fall, at least one interaction radius.
double fall_height(const Model& model) {
    const Eigen::Vector3d down = model.parameters.gravity.normalized();
    double low = down.dot(model.position.front()), high = low;
    for (const Eigen::Vector3d& position : model.position) {
        low = std::min(low, down.dot(position));
        high = std::max(high, down.dot(position));
    }
    return std::max(high - low, model.parameters.radius);
}

/// Largest |dl/dt| of l = l_rest (1 + 1/2 z a sin(2 pi f t)), thesis (2.6) to (2.8).
double muscle_speed(const Model& model, const Gait& gait) {
    double fastest = 0;
    for (const Muscle& muscle : model.muscles) {
        const double amplitude = gait.amplitude[static_cast<std::size_t>(muscle.actuator)] * std::abs(muscle.lateral);
        const double length = model.springs[static_cast<std::size_t>(muscle.spring)].rest_length;
        fastest = std::max(fastest, std::numbers::pi * gait.frequency * amplitude * length);
    }
    return fastest;
}

}  // namespace

PhysicalBounds physical_bounds(const Model& model, const Gait& gait) {
    const double gravity = model.parameters.gravity.norm() * std::max(1.0, std::abs(model.parameters.buoyancy));
    const double reachable = std::sqrt(2 * gravity * fall_height(model)) + muscle_speed(model, gait);
    double mass = 0;
    for (const double inverse_mass : model.inverse_mass) mass += inverse_mass > 0 ? 1 / inverse_mass : 0;
    return {.speed = speed_margin * reachable, .kinetic_energy = mass * reachable * reachable / 2};
}

}  // namespace natator::bench
