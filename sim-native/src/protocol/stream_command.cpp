#include "base/field.h"
#include "protocol/protocol.h"
#include "protocol/stream.h"
#include "scene/gait_json.h"

namespace natator {
namespace {

using fields::Place;
using nlohmann::json;

const Place place{"command", ""};

/// Refuses keys that no command of this kind has; all have `do` and `id`.
void check_keys(const json& value, std::vector<std::string_view> allowed) {
    allowed.insert(allowed.end(), {"do", "id"});
    fields::check_keys(value, place, allowed);
}

int read_frames(const json& value, int most) {
    int frames = 1;
    if (value.contains("frames")) fields::read(value.at("frames"), place.key("frames"), {1.0, 1.0 * most}, frames);
    return frames;
}

stream::Rate read_rate(const json& value) {
    stream::Rate rate;
    const json& given = fields::required(value, place, "value");
    if (!given.is_number() || !stream::is_rate(given.get<double>()))
        fields::refuse(place.key("value"), given, "0 or a number in [0.001, 1000]");
    rate.value = given.get<double>();
    return rate;
}

/// The keys `drive`, `scale` and `offset`.
stream::Steer read_steer(const json& value) {
    stream::Steer steer;
    for (const auto& [key, list] :
         {std::pair{"drive", &steer.drive}, {"scale", &steer.scale}, {"offset", &steer.offset}})
        if (value.contains(key)) *list = read_actuator_values(value.at(key), place.key(key));
    if (steer.drive && (steer.scale || steer.offset))
        fields::refuse(place.key("drive"), "must not be given together with scale or offset");
    return steer;
}

/// A list of lists: what drives the actuators in each frame.
bool is_for_each_frame(const json& value) {
    return value.contains("drive") && value.at("drive").is_array() && !value.at("drive").empty() &&
           value.at("drive")[0].is_array();
}

bool read_sense_flag(const json& value) {
    bool sense = false;
    if (value.contains("sense")) fields::read(value.at("sense"), place.key("sense"), {}, sense);
    return sense;
}

stream::Step read_step(const json& value) {
    stream::Step step;
    step.frames = read_frames(value, stream::max_step);
    step.sense = read_sense_flag(value);
    json other = value;
    if (is_for_each_frame(value)) {
        const json& rows = value.at("drive");
        const std::string has = "has " + std::to_string(rows.size()) + " lists: must have ";
        if (rows.size() > stream::max_step)
            fields::refuse(place.key("drive"), has + std::to_string(stream::max_step) + " at most");
        if (!value.contains("frames")) step.frames = static_cast<int>(rows.size());
        if (rows.size() != static_cast<std::size_t>(step.frames))
            fields::refuse(place.key("drive"), has + "one for each of the " + std::to_string(step.frames) + " frames");
        for (std::size_t k = 0; k < rows.size(); ++k)
            step.drive.push_back(read_actuator_values(rows[k], place.key("drive").item(k)));
        other.erase("drive");
    }
    if (other.contains("drive") || other.contains("scale") || other.contains("offset")) step.steer = read_steer(other);
    if (step.steer && !step.drive.empty())
        fields::refuse(place.key("drive"), "must not be given together with scale or offset");
    return step;
}

SkinPlace read_skin_place(const json& value, const Place& at) {
    using Side = SkinPlace::Side;
    fields::check_keys(value, at, {"slice", "side"});
    SkinPlace skin;
    fields::read(fields::required(value, at, "slice"), at.key("slice"), {0, 1e9}, skin.slice);
    skin.side = fields::read_choice<Side>(
        fields::required(value, at, "side"), at.key("side"),
        {{"left", Side::left}, {"right", Side::right}, {"above", Side::above}, {"below", Side::below}});
    return skin;
}

stream::Sense read_sense(const json& value) {
    stream::Sense sense;
    if (value.contains("flow")) {
        const json& places = value.at("flow");
        if (!places.is_array()) fields::refuse(place.key("flow"), places, "an array of places of the skin");
        sense.flow.emplace();
        for (std::size_t i = 0; i < places.size(); ++i)
            sense.flow->push_back(read_skin_place(places[i], place.key("flow").item(i)));
    }
    if (value.contains("within"))
        fields::read(value.at("within"), place.key("within"), {0, 1000, false, "length"}, sense.within.emplace());
    if (value.contains("target")) {
        sense.target.emplace();
        if (!value.at("target").is_null())
            fields::read(value.at("target"), place.key("target"), {-1e6, 1e6, false, "length"},
                         sense.target->emplace());
    }
    if (value.contains("each")) fields::read(value.at("each"), place.key("each"), {}, sense.each.emplace());
    return sense;
}

std::optional<int> read_start(const json& value) {
    std::optional<int> start;
    if (value.contains("start")) fields::read(value.at("start"), place.key("start"), {0, 2147483647}, start.emplace());
    return start;
}

json read_overrides(const json& value) {
    const json& overrides = fields::required(value, place, "overrides");
    if (!overrides.is_object()) fields::refuse(place.key("overrides"), overrides, "an object");
    return overrides;
}

SimulationSetup read_setup(const json& value) {
    SimulationSetup setup;
    fields::read(fields::required(value, place, "scene"), place.key("scene"), {}, setup.scene);
    if (value.contains("overrides")) setup.overrides = read_overrides(value).dump();
    if (value.contains("gait")) setup.gait = parse_gait(value.at("gait"), "gait");
    setup.start = read_start(value);
    return setup;
}

}  // namespace

bool stream::is_rate(double value) {
    return value == 0 || (value >= 1e-3 && value <= 1e3);
}

StreamCommand parse_stream_command(const json& value) {
    if (!value.is_object()) fields::refuse(place, value, "an object");
    if (value.contains("id") && request_id(value).is_null()) fields::refuse(place.key("id"), value.at("id"), id_range);
    std::string name;
    fields::read(fields::required(value, place, "do"), place.key("do"), {}, name);

    const auto only = [&value](std::vector<std::string_view> keys) { check_keys(value, std::move(keys)); };
    if (name == "credit") return only({"frames"}), stream::Credit{read_frames(value, stream::max_credit)};
    if (name == "run") return only({}), stream::Run{};
    if (name == "pause") return only({}), stream::Pause{};
    if (name == "step") return only({"frames", "drive", "scale", "offset", "sense"}), read_step(value);
    if (name == "drive") return only({"drive"}), fields::required(value, place, "drive"), read_steer(value);
    if (name == "steer") return only({"scale", "offset"}), read_steer(value);
    if (name == "sense") return only({"flow", "within", "target", "each"}), read_sense(value);
    if (name == "water") return only({}), stream::Water{};
    if (name == "save") return only({}), stream::Save{};
    if (name == "restore") return only({"sense"}), stream::Restore{read_sense_flag(value)};
    if (name == "rate") return only({"value"}), read_rate(value);
    if (name == "reset") return only({"start"}), stream::Reset{read_start(value)};
    if (name == "gait")
        return only({"gait"}), stream::NewGait{parse_gait(fields::required(value, place, "gait"), "gait")};
    if (name == "overrides") return only({"overrides"}), stream::Overrides{read_overrides(value)};
    if (name == "scene") return only({"scene", "overrides", "gait", "start"}), stream::NewScene{read_setup(value)};
    fields::refuse(place.key("do"), name,
                   "credit, run, pause, step, rate, reset, gait, drive, steer, sense, water, save, restore, overrides or "
                   "scene");
}

}  // namespace natator
