#include "json_argument.h"

#include "io/strict_json.h"

namespace natator::cli {

namespace {

bool is_text(const std::string& argument) {
    const auto first = argument.find_first_not_of(" \t\r\n");
    return first != std::string::npos && argument[first] == '{';
}

}  // namespace

std::string json_argument_name(const std::string& argument, const std::string& option) {
    return is_text(argument) ? option : option + " " + argument;
}

nlohmann::json read_json_argument(const std::string& argument, const std::string& name) {
    return is_text(argument) ? parse_json(argument, name) : read_json_file(argument);
}

}  // namespace natator::cli
