#include "json_argument.h"

#include <cstdio>
#include <filesystem>

#include "base/field.h"
#include "base/strict_json.h"

namespace natator::cli {

namespace {

/// An object; or an array that is the name of no file, which readers refuse better than a file that is not there.
bool is_text(const std::string& argument) {
    const auto first = argument.find_first_not_of(" \t\r\n");
    if (first == std::string::npos) return false;
    std::error_code failed;
    return argument[first] == '{' || (argument[first] == '[' && !std::filesystem::exists(argument, failed));
}

bool is_standard_input(const std::string& argument) {
    return argument.empty() || argument == "-";
}

}  // namespace

std::string json_argument_name(const std::string& argument, const std::string& option) {
    return is_text(argument) ? option : option + " " + argument;
}

nlohmann::json read_json_argument(const std::string& argument, const std::string& name) {
    return is_text(argument) ? parse_json(argument, name) : read_json_file(argument);
}

nlohmann::json read_overrides_argument(const std::string& argument) {
    if (argument.empty()) return nlohmann::json::object();
    nlohmann::json overrides = read_json_argument(argument, "--overrides");
    const fields::Place place{"command line", json_argument_name(argument, "--overrides")};
    if (!overrides.is_object()) fields::refuse(place, overrides, "an object");
    return overrides;
}

std::string request_name(const std::string& argument) {
    return is_standard_input(argument) ? "request" : json_argument_name(argument, "request");
}

nlohmann::json read_request(const std::string& argument) {
    return is_standard_input(argument) ? parse_json(read_all(stdin, "request"), "request")
                                       : read_json_argument(argument, "request");
}

}  // namespace natator::cli
