#include "check_values.h"

#include "io/strict_json.h"
#include "natator/actuate.h"
#include "natator/error.h"

namespace natator {
void check_range(const std::string& name, double value, double low, double high, bool open, const char* unit) {
    if ((open ? value > low : value >= low) && value <= high) return;  // false for what is no number
    throw InputError(name + " = " + number_text(value) + ": must be a number in " + (open ? '(' : '[') + computed_text(low) +
                     ", " + computed_text(high) + "]" + unit);
}

void check_length(std::string_view name, std::size_t values, int actuators, std::string_view none) {
    if (values == static_cast<std::size_t>(actuators)) return;
    throw InputError(std::string(name) + " has length " + std::to_string(values) + ": must have length " + std::to_string(actuators) +
                     ", one value per actuator of the creature" +
                     (actuators == 0 && !none.empty() ? " (" + std::string(none) + ")" : ""));
}

void check_lengths(const Gait& gait, int actuators) {
    check_length("gait.amplitude", gait.amplitude.size(), actuators);
    check_length("gait.phase", gait.phase.size(), actuators);
    if (!gait.offset.empty()) check_length("gait.offset", gait.offset.size(), actuators);
}

void check_values(const std::string& name, const std::vector<double>& values, int actuators, double low, double high,
                  const char* none) {
    check_length(name, values.size(), actuators, none);
    for (std::size_t i = 0; i < values.size(); ++i)
        check_range(name + "[" + std::to_string(i) + "]", values[i], low, high, false, "");
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
        check_range("gait.offset[" + std::to_string(i) + "]", gait.offset[i], -most, most, false,
                    " (a muscle has no length below 0)");
    }
}

}  // namespace natator
