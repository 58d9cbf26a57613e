#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "base/field.h"
#include "natator/gait.h"

/// Gaits as scenes, requests and commands have them.
namespace natator {

/// An array of numbers, one per actuator, as gaits and commands have them. Their number and range are not checked.
std::vector<double> read_actuator_values(const nlohmann::json& value, const fields::Place& place);

/// A gait as requests have it.
nlohmann::ordered_json gait_json(const Gait& gait);

/// Reads a gait: `frequency`, `amplitude`, `phase` and, if wanted, `offset` and `power`. Checks types, not ranges
/// (check_gait).
Gait parse_gait(const nlohmann::json& value, const std::string& document);
/// Reads one that stands at a place of a document.
Gait read_gait(const nlohmann::json& value, const fields::Place& place);

}  // namespace natator
