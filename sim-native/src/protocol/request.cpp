#include "base/field.h"
#include "natator/error.h"
#include "protocol/protocol.h"
#include "scene/gait_json.h"

namespace natator {
namespace {

using fields::Place;
using nlohmann::json;

Perturbation read_perturbation(const json& value, const Place& place) {
    fields::check_keys(value, place, {"amplitude", "seed"});
    return {read_perturbation_amplitude(fields::required(value, place, "amplitude"), place.key("amplitude")),
            read_perturbation_seed(fields::required(value, place, "seed"), place.key("seed"))};
}

}  // namespace

double read_perturbation_amplitude(const json& value, const Place& place) {
    double amplitude = 0;
    fields::read(value, place, {0, 1, false, "length"}, amplitude);
    return amplitude;
}

std::uint64_t read_perturbation_seed(const json& value, const Place& place) {
    if (!value.is_number_unsigned()) fields::refuse(place, value, "a whole number in [0, 2^64)");
    return value.get<std::uint64_t>();
}

json request_id(const json& value) {
    if (!value.is_object() || !value.contains("id")) return nullptr;
    const json& id = value.at("id");
    return id.is_number_unsigned() && id.get<std::uint64_t>() <= max_id ? id : json();
}

Request parse_request(const json& value, const std::string& document) {
    const Place place{document, ""};
    fields::check_keys(value, place,
                       {"id", "scene", "gait", "duration", "scheme", "backend", "precision", "perturbation", "start",
                        "overrides", fields::schema_key});
    fields::check_schema_key(value, place);
    Request request;
    const json& id = fields::required(value, place, "id");
    request.id = request_id(value);
    if (request.id.is_null()) fields::refuse(place.key("id"), id, id_range);
    fields::read(fields::required(value, place, "scene"), place.key("scene"), {}, request.scene);
    if (value.contains("gait")) request.gait = read_gait(value.at("gait"), place.key("gait"));
    if (value.contains("precision")) {
        request.precision = fields::read_choice<Precision>(
            value.at("precision"), place.key("precision"),
            {{"float", Precision::single_precision}, {"double", Precision::double_precision}});
    }
    if (value.contains("perturbation")) {
        request.perturbation = read_perturbation(value.at("perturbation"), place.key("perturbation"));
    }
    if (value.contains("start")) {
        int start = 0;
        fields::read(value.at("start"), place.key("start"), {0, 2147483647}, start);
        request.start = start;
        if (value.contains("perturbation"))
            fields::refuse(place.key("start"), "must not be given together with perturbation");
    }
    if (value.contains("overrides")) {
        request.overrides = value.at("overrides");
        if (!request.overrides.is_object()) fields::refuse(place.key("overrides"), request.overrides, "an object");
    }
    for (const auto& [key, must_be] :
         {std::pair("duration", "a number"), std::pair("scheme", R"("flex", "conserving" or "lattice")")}) {
        if (!value.contains(key)) continue;
        if (value.at(key).is_null())
            fields::refuse(place.key(key), value.at(key), must_be);  // it would erase the scene's own
        request.overrides[key] = value.at(key);
    }
    if (value.contains("backend")) {
        request.backend = fields::read_choice<std::string>(value.at("backend"), place.key("backend"),
                                                           {{"cpu", "cpu"}, {"auto", "auto"}, {"cuda", "cuda"}});
    }
    return request;
}

}  // namespace natator
