#include <cmath>
#include <numbers>

#include "natator/gait.h"

namespace natator {

Gait resting_gait(int actuators) {
    Gait rest;
    rest.amplitude.assign(static_cast<std::size_t>(actuators), 0);
    rest.phase = rest.amplitude;
    return rest;
}

double activation(const Gait& gait, int actuator, double time) {
    const double turns = gait.frequency * time + gait.phase.at(static_cast<std::size_t>(actuator));
    const double sine = std::sin(2 * std::numbers::pi * turns);
    if (gait.power == 1.0) return sine;
    return std::pow((sine + 1) / 2, gait.power) * 2 - 1;
}

}  // namespace natator
