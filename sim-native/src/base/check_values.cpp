#include "check_values.h"

#include "natator/error.h"
#include "text.h"

namespace natator {

void check_range(const std::string& name, double value, double low, double high, bool open, const char* unit) {
    if ((open ? value > low : value >= low) && value <= high) return;  // false for what is no number
    throw InputError(name + " = " + number_text(value) + ": must be a number in " + (open ? '(' : '[') +
                     computed_text(low) + ", " + computed_text(high) + "]" + unit);
}

void check_length(std::string_view name, std::size_t values, int actuators, std::string_view none) {
    if (values == static_cast<std::size_t>(actuators)) return;
    throw InputError(std::string(name) + " has length " + std::to_string(values) + ": must have length " +
                     std::to_string(actuators) + ", one value per actuator of the creature" +
                     (actuators == 0 && !none.empty() ? " (" + std::string(none) + ")" : ""));
}

void check_values(const std::string& name, const std::vector<double>& values, int actuators, double low, double high,
                  const char* none) {
    check_length(name, values.size(), actuators, none);
    for (std::size_t i = 0; i < values.size(); ++i)
        check_range(name + "[" + std::to_string(i) + "]", values[i], low, high, false, "");
}

}  // namespace natator
