#include "json_argument.h"

#include "io/strict_json.h"

namespace natator::cli {

nlohmann::json read_json_argument(const std::string& argument, const std::string& name) {
    const auto first = argument.find_first_not_of(" \t\r\n");
    const bool text = first != std::string::npos && argument[first] == '{';
    return text ? parse_json(argument, name) : read_json_file(argument);
}

}  // namespace natator::cli
