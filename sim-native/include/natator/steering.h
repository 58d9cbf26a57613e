#pragma once

#include <vector>

#include "natator/gait.h"

namespace natator {

/// What a program outside does to a swimmer's muscles while it swims: each actuator is driven by scale times what the gait
/// gives it, plus offset. One value for each actuator in both lists.
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

/// Throws InputError unless there is a value for each actuator, each within [-2, 2]. `name` is what the message calls them.
void check_drive(const std::vector<double>& values, int actuators, const char* name = "drive");

/// Throws InputError unless both lists have a value for each actuator, each within its range, and scale times the gait's
/// own largest drive, amplitude plus |offset|, plus |offset| is at most 2 for each: no muscle has a length below 0. The gait must fit (check_gait).
void check_steering(const Steering& steering, const Gait& gait, int actuators);

/// What drives the actuators at a part (0 to 1) of the way from one steering to another, if the gait gives `driven`: all of
/// it goes in a straight line. Throws InputError unless both steerings have a value for each.
std::vector<double> steer(const Steering& from, const Steering& to, double part, std::vector<double> driven);

}  // namespace natator
