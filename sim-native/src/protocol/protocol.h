#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>

#include "base/field.h"
#include "natator/evaluate.h"

/// The pipe protocol: one request in, one result out, both JSON objects on one line (sim-native/protocol).
namespace natator {

/// Ids are whole numbers that every reader of JSON keeps as they are.
inline constexpr std::uint64_t max_id = 9007199254740991;
inline constexpr const char* id_range = "a whole number in [0, 9007199254740991]";

/// What `natator-sim evaluate` is asked to do.
struct Request {
    nlohmann::json id;  ///< repeated in the result
    std::string scene;
    std::optional<Gait> gait;
    nlohmann::json overrides = nlohmann::json::object();  ///< with the request's own `duration` and `scheme` merged in
    Precision precision = Precision::single_precision;
    Perturbation perturbation;
    std::optional<int> start;            ///< which of many starts: choose_start
    std::optional<std::string> backend;  ///< "cpu", "cuda" or "auto"; whether there is one is for its user to see
};

/// Reads a request. Throws InputError naming the field, its value and what is allowed. The scene and the ranges of the
/// gait are checked when they are used. `document` is what messages call it.
Request parse_request(const nlohmann::json& value, const std::string& document = "request");

/// The request's id, or null if it has no usable one.
nlohmann::json request_id(const nlohmann::json& value);

/// How far starts are shifted, and which of these shifts, as requests have it.
double read_perturbation_amplitude(const nlohmann::json& value, const fields::Place& place);
std::uint64_t read_perturbation_seed(const nlohmann::json& value, const fields::Place& place);

/// The result of an evaluation; unstable ones have fitness 0 and tell where they broke.
nlohmann::ordered_json result_json(const nlohmann::json& id, const Evaluation& evaluation, Scheme scheme,
                                   Precision precision);

/// The result for a request that could not be carried out.
nlohmann::ordered_json error_json(const nlohmann::json& id, const std::string& message);

}  // namespace natator
