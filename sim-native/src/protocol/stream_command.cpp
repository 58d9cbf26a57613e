#include <algorithm>

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

std::optional<int> read_swimmer(const json& value) {
    std::optional<int> swimmer;
    if (value.contains("swimmer")) fields::read(value.at("swimmer"), place.key("swimmer"), {0, 1e9}, swimmer.emplace());
    return swimmer;
}

/// The keys `drive`, `scale`, `offset` and `swimmer`.
stream::Steer read_steer(const json& value) {
    stream::Steer steer;
    steer.swimmer = read_swimmer(value);
    for (const auto& [key, list] :
         {std::pair{"drive", &steer.drive}, {"scale", &steer.scale}, {"offset", &steer.offset}})
        if (value.contains(key)) *list = read_actuator_values(value.at(key), place.key(key));
    if (steer.drive && (steer.scale || steer.offset))
        fields::refuse(place.key("drive"), "must not be given together with scale or offset");
    return steer;
}

bool read_flag(const json& value, const char* key) {
    bool flag = false;
    if (value.contains(key)) fields::read(value.at(key), place.key(key), {}, flag);
    return flag;
}

bool has_rows(const json& value, const char* key) {
    return value.contains(key) && value.at(key).is_array() && !value.at(key).empty() && value.at(key)[0].is_array();
}

/// Values that are lists of lists are for each frame, all of them or none.
stream::Step read_step(const json& value) {
    stream::Step step;
    step.frames = read_frames(value, stream::max_step);
    step.sense = read_flag(value, "sense");
    std::vector<const char*> given;
    for (const char* key : {"drive", "scale", "offset"})
        if (value.contains(key)) given.push_back(key);
    const std::optional<int> swimmer = read_swimmer(value);
    if (swimmer && given.empty()) fields::refuse(place.key("swimmer"), "must come with drive, scale or offset, for it");
    const bool each = std::any_of(given.begin(), given.end(), [&](const char* key) { return has_rows(value, key); });
    if (!each && !given.empty()) step.steer.push_back(read_steer(value));
    if (!each) return step;
    if (given.size() > 1 && value.contains("drive"))
        fields::refuse(place.key("drive"), "must not be given together with scale or offset");
    if (!value.contains("frames")) step.frames = static_cast<int>(value.at(given[0]).size());
    stream::Steer for_swimmer;
    for_swimmer.swimmer = swimmer;
    step.steer.resize(std::min(step.frames, stream::max_step), for_swimmer);
    for (const char* key : given) {
        if (!has_rows(value, key))
            fields::refuse(place.key(key), value.at(key), "a list for each frame, as the other is");
        const json& rows = value.at(key);
        const std::string has = "has " + std::to_string(rows.size()) + " lists: must have ";
        if (rows.size() > stream::max_step)
            fields::refuse(place.key(key), has + std::to_string(stream::max_step) + " at most");
        if (rows.size() != static_cast<std::size_t>(step.frames))
            fields::refuse(place.key(key), has + "one for each of the " + std::to_string(step.frames) + " frames");
        for (std::size_t k = 0; k < rows.size(); ++k) {
            stream::Steer& steer = step.steer[k];
            auto& list = key[0] == 'd' ? steer.drive : key[0] == 's' ? steer.scale : steer.offset;
            list = read_actuator_values(rows[k], place.key(key).item(k));
        }
    }
    return step;
}

SkinPlace read_skin_place(const json& value, const Place& at) {
    fields::check_keys(value, at, {"slice", "side"});
    SkinPlace skin;
    fields::read(fields::required(value, at, "slice"), at.key("slice"), {0, 1e9}, skin.slice);
    skin.side = read_skin_side(fields::required(value, at, "side"), at.key("side"));
    return skin;
}

stream::Sense read_sense(const json& value) {
    stream::Sense sense;
    sense.swimmer = read_swimmer(value).value_or(0);
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

stream::Bodies read_bodies(const json& value) {
    if (!value.contains("bodies")) return std::nullopt;
    const json& given = value.at("bodies");
    if (!given.is_array()) fields::refuse(place.key("bodies"), given, "a list");
    std::vector<stream::Body> bodies;
    for (std::size_t k = 0; k < given.size(); ++k) {
        const Place at = place.key("bodies").item(k);
        if (!given[k].is_object()) fields::refuse(at, given[k], "an object");
        fields::check_keys(given[k], at, {"actuators", "slices"});
        stream::Body& body = bodies.emplace_back();
        for (const auto& [key, number] : {std::pair{"actuators", &body.actuators}, {"slices", &body.slices}})
            fields::read(fields::required(given[k], at, key), at.key(key), {0, 1e9}, *number);
    }
    return bodies;
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

SkinPlace::Side read_skin_side(const json& value, const Place& at) {
    using enum SkinPlace::Side;
    return fields::read_choice<SkinPlace::Side>(value, at,
                                                {{"left", left}, {"right", right}, {"above", above}, {"below", below}});
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
    if (name == "step") return only({"frames", "drive", "scale", "offset", "swimmer", "sense"}), read_step(value);
    if (name == "drive") return only({"drive", "swimmer"}), fields::required(value, place, "drive"), read_steer(value);
    if (name == "steer") return only({"scale", "offset", "swimmer"}), read_steer(value);
    if (name == "sense") return only({"flow", "within", "target", "each", "swimmer"}), read_sense(value);
    if (name == "water") return only({"pressure"}), stream::Water{read_flag(value, "pressure")};
    if (name == "save") return only({}), stream::Save{};
    if (name == "restore")
        return only({"sense", "bodies"}), stream::Restore{read_flag(value, "sense"), read_bodies(value)};
    if (name == "rate") return only({"value"}), read_rate(value);
    if (name == "reset") return only({"start"}), stream::Reset{read_start(value)};
    if (name == "gait")
        return only({"gait", "swimmer"}), stream::NewGait{parse_gait(fields::required(value, place, "gait"), "gait"),
                                                          read_swimmer(value).value_or(0)};
    if (name == "overrides")
        return only({"overrides", "bodies"}), stream::Overrides{read_overrides(value), read_bodies(value)};
    if (name == "scene") return only({"scene", "overrides", "gait", "start"}), stream::NewScene{read_setup(value)};
    fields::refuse(
        place.key("do"), name,
        "credit, run, pause, step, rate, reset, gait, drive, steer, sense, water, save, restore, overrides or "
        "scene");
}

}  // namespace natator
