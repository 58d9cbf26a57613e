#include "gait_json.h"

namespace natator {
namespace {

using fields::Place;
using nlohmann::json;
using nlohmann::ordered_json;

double read_number(const json& value, const Place& place) {
    if (!value.is_number()) fields::refuse(place, value, "a number");
    return value.get<double>();
}

}  // namespace

std::vector<double> read_actuator_values(const json& value, const fields::Place& place) {
    if (!value.is_array()) fields::refuse(place, value, "an array of numbers, one per actuator");
    std::vector<double> numbers;
    for (std::size_t i = 0; i < value.size(); ++i) {
        if (!value[i].is_number()) fields::refuse(place.item(i), value[i], "a number");
        numbers.push_back(value[i].get<double>());
    }
    return numbers;
}

ordered_json gait_json(const Gait& gait) {
    ordered_json json = {
        {"frequency", gait.frequency}, {"amplitude", gait.amplitude}, {"phase", gait.phase}, {"power", gait.power}};
    if (!gait.offset.empty()) json["offset"] = gait.offset;
    return json;
}

Gait read_gait(const json& value, const Place& place) {
    fields::check_keys(value, place, {"frequency", "amplitude", "phase", "offset", "power", fields::schema_key});
    fields::check_schema_key(value, place);
    Gait gait;
    gait.frequency = read_number(fields::required(value, place, "frequency"), place.key("frequency"));
    gait.amplitude = read_actuator_values(fields::required(value, place, "amplitude"), place.key("amplitude"));
    gait.phase = read_actuator_values(fields::required(value, place, "phase"), place.key("phase"));
    if (value.contains("offset")) gait.offset = read_actuator_values(value.at("offset"), place.key("offset"));
    if (value.contains("power")) gait.power = read_number(value.at("power"), place.key("power"));
    return gait;
}

Gait parse_gait(const json& value, const std::string& document) {
    return read_gait(value, {document, ""});
}

}  // namespace natator
