#pragma once

#include <string>
#include <vector>

namespace natator {

/// Refuses a value beyond [low, high], or (low, high] if `open`, and one that is no number, by an InputError; `unit` ends it.
void check_range(const std::string& name, double value, double low, double high, bool open, const char* unit);

/// Refuses a list that has not a value in [low, high] for each actuator. `none`: what is said where there is no actuator.
void check_values(const std::string& name, const std::vector<double>& values, int actuators, double low, double high,
                  const char* none);

}  // namespace natator
