#include "io/protocol.h"
#include "io/stream.h"
#include "scene/field.h"

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

json read_overrides(const json& value) {
    const json& overrides = fields::required(value, place, "overrides");
    if (!overrides.is_object()) fields::refuse(place.key("overrides"), overrides, "an object");
    return overrides;
}

LiveSetup read_setup(const json& value) {
    LiveSetup setup;
    fields::read(fields::required(value, place, "scene"), place.key("scene"), {}, setup.scene);
    if (value.contains("overrides")) setup.overrides = read_overrides(value).dump();
    if (value.contains("gait")) setup.gait = parse_gait(value.at("gait"), "gait");
    return setup;
}

}  // namespace

bool stream::is_rate(double value) {
    return value == 0 || (value >= 1e-3 && value <= 1e3);
}

StreamCommand parse_stream_command(const json& value) {
    if (!value.is_object()) fields::refuse(place, value, "an object");
    if (value.contains("id") && request_id(value).is_null())
        fields::refuse(place.key("id"), value.at("id"), "a whole number >= 0");
    std::string name;
    fields::read(fields::required(value, place, "do"), place.key("do"), {}, name);

    const auto only = [&value](std::vector<std::string_view> keys) { check_keys(value, std::move(keys)); };
    if (name == "credit") return only({"frames"}), stream::Credit{read_frames(value, stream::most_credit)};
    if (name == "run") return only({}), stream::Run{};
    if (name == "pause") return only({}), stream::Pause{};
    if (name == "step") return only({"frames"}), stream::Step{read_frames(value, stream::longest_step)};
    if (name == "rate") return only({"value"}), read_rate(value);
    if (name == "reset") return only({}), stream::Reset{};
    if (name == "gait")
        return only({"gait"}), stream::NewGait{parse_gait(fields::required(value, place, "gait"), "gait")};
    if (name == "overrides") return only({"overrides"}), stream::Overrides{read_overrides(value)};
    if (name == "scene") return only({"scene", "overrides", "gait"}), stream::NewScene{read_setup(value)};
    fields::refuse(place.key("do"), name, "credit, run, pause, step, rate, reset, gait, overrides or scene");
}

}  // namespace natator
