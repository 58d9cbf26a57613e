#pragma once

#include <vector>

namespace natator {

struct Creature;

/// How the muscles of a creature are driven (thesis 2.5): one frequency, and per actuator an amplitude and a phase.
struct Gait {
    double frequency = 1.0;         ///< f, 1/s; thesis: [0.5, 2]
    std::vector<double> amplitude;  ///< a_i per actuator, thesis: [0, 1]
    std::vector<double> phase;      ///< phi_i per actuator in turns, [0, 1]
    double power = 1.0;             ///< p of the potentiated activation of thesis 4.2; 1 = plain sine, (2.6)
    /// o_i per actuator: what its muscles are driven by beside the beat, to steer; > 0 to the left. Empty = 0.
    std::vector<double> offset{};

    bool operator==(const Gait&) const = default;  ///< whether all values are the same
};

/// The gait that leaves the muscles of so many actuators at rest.
Gait resting_gait(int actuators);

/// Activation u in [-1, 1] of one actuator at time t (s): sin(2 pi (f t + phi)), thesis (2.6);
/// with power p != 1: ((sin + 1) / 2)^p * 2 - 1, thesis 4.2.
double activation(const Gait& gait, int actuator, double time);

/// What a program outside does to a swimmer's muscles while it swims: each actuator is driven by scale times what the
/// gait gives it, plus offset. One value for each actuator in both lists.
struct Steering {
    std::vector<double> scale;   ///< factor on the gait's drive, [0, 4]
    std::vector<double> offset;  ///< added to it, [-2, 2]; positive bends the body to its left, or down
};

/// The steering that leaves the gait as it is.
Steering no_steering(int actuators);

/// The steering under which these values alone drive the actuators, whatever the gait.
Steering steering_of_drive(const std::vector<double>& values);

/// Whether the gait alone drives the muscles.
bool leaves_gait(const Steering& steering);

/// Throws InputError unless there is a value for each actuator, each within [-2, 2]. `name` is what the message calls
/// them.
void check_drive(const std::vector<double>& values, int actuators, const char* name = "drive");

/// Throws InputError unless both lists have a value for each actuator, each within its range, and scale times the
/// gait's own largest drive, amplitude plus |offset|, plus |offset| is at most 2 for each: no muscle has a length below
/// 0. The gait must fit (check_gait).
void check_steering(const Steering& steering, const Gait& gait, int actuators);

/// What drives the actuators at a part (0 to 1) of the way from one steering to another, if the gait gives `driven`:
/// all of it goes in a straight line. Throws InputError unless both steerings have a value for each.
std::vector<double> steer(const Steering& from, const Steering& to, double part, std::vector<double> driven);

/// A gait to begin with: a wave that runs from head to tail and grows on its way, at 2 beats a second, half a wave on
/// the body. Muscles that bend another way than the first rest. Values are rounded to hundredths. Every bundled
/// creature swims by it.
Gait wave_gait(const Creature& creature);

}  // namespace natator
