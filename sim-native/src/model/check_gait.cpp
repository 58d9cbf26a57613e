#include "check_gait.h"

#include "base/check_values.h"
#include "natator/model.h"

namespace natator {

void check_lengths(const Gait& gait, int actuators) {
    check_length("gait.amplitude", gait.amplitude.size(), actuators);
    check_length("gait.phase", gait.phase.size(), actuators);
    if (!gait.offset.empty()) check_length("gait.offset", gait.offset.size(), actuators);
}

void check_gait(const Gait& gait, int actuators) {
    constexpr auto none = "there is none: an actuator needs two joints";
    check_range("gait.frequency", gait.frequency, 0, 60, true, " (1/s)");
    check_values("gait.amplitude", gait.amplitude, actuators, 0, 2, none);
    check_values("gait.phase", gait.phase, actuators, 0, 1, none);
    check_range("gait.power", gait.power, 0.5, 4, false, "");
    if (!gait.offset.empty()) check_values("gait.offset", gait.offset, actuators, -2, 2, none);
    for (std::size_t i = 0; i < gait.offset.size(); ++i) {
        const double most = 2 - gait.amplitude[i];
        check_range("gait.offset[" + std::to_string(i) + "]", gait.offset[i], 0 - most, most, false,
                    " (a muscle has no length below 0)");
    }
}

}  // namespace natator
