#pragma once

#include <vector>

namespace natator {

/// How the muscles of a creature are driven (thesis 2.5): one frequency, and per actuator an amplitude and a phase.
struct Gait {
    double frequency = 1.0;         ///< f, 1/s; thesis: [0.5, 2]
    std::vector<double> amplitude;  ///< a_i per actuator, thesis: [0, 1]
    std::vector<double> phase;      ///< phi_i per actuator in turns, [0, 1]
    double power = 1.0;             ///< p of the potentiated activation of thesis 4.2; 1 = plain sine, (2.6)
    /// o_i per actuator: what its muscles are driven by beside the beat, to steer; > 0 to the left. Empty = 0.
    std::vector<double> offset{};

    bool operator==(const Gait&) const = default;
};

/// The gait that leaves the muscles of so many actuators at rest.
Gait resting_gait(int actuators);

/// Activation u in [-1, 1] of one actuator at time t (s): sin(2 pi (f t + phi)), thesis (2.6);
/// with power p != 1: ((sin + 1) / 2)^p * 2 - 1, thesis 4.2.
double activation(const Gait& gait, int actuator, double time);

}  // namespace natator
