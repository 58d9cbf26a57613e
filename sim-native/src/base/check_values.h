#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace natator {

/// Refuses a value beyond [low, high], or (low, high] if `open`, and one that is no number, by an InputError; `unit`
/// ends it.
void check_range(const std::string& name, double value, double low, double high, bool open, const char* unit);

/// Refuses a list of so many values that has not one for each actuator. `none`: what is said where there is no
/// actuator, or empty.
void check_length(std::string_view name, std::size_t values, int actuators, std::string_view none = {});

/// Refuses a list that has not a value in [low, high] for each actuator. `none`: what is said where there is no
/// actuator.
void check_values(const std::string& name, const std::vector<double>& values, int actuators, double low, double high,
                  const char* none);

}  // namespace natator
