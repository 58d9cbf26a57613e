#include "natator/gait.h"
#include "physics/muscle.h"

namespace natator {

Gait resting_gait(int actuators) {
    Gait rest;
    rest.amplitude.assign(static_cast<std::size_t>(actuators), 0);
    rest.phase = rest.amplitude;
    return rest;
}

double activation(const Gait& gait, int actuator, double time) {
    return physics::activation(gait.frequency, gait.power, gait.phase.at(static_cast<std::size_t>(actuator)), time);
}

}  // namespace natator
