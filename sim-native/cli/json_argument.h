#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace natator::cli {

/// JSON given on the command line, or in a file if it does not begin with '{'. `name` is the option's, for messages.
/// Throws InputError.
nlohmann::json read_json_argument(const std::string& argument, const std::string& name);

/// --overrides, from a file or as JSON text; without an argument an empty object. Throws InputError for what is no
/// object.
nlohmann::json read_overrides_argument(const std::string& argument);

/// A request, from a file or as JSON text; without an argument, or with "-", from standard input. Throws InputError.
nlohmann::json read_request(const std::string& argument);

/// What messages about the content of a request call it: with its file if it has one.
std::string request_name(const std::string& argument);

/// The option with its file if it has one, as messages about the content name it.
std::string json_argument_name(const std::string& argument, const std::string& option);

}  // namespace natator::cli
