// The binary messages of many swims: ACTS, OBSV, SWIM (sim-native/protocol/stream.md).
#include <cstring>
#include <limits>

#include "message_writer.h"
#include "natator/error.h"
#include "natator/measure.h"
#include "protocol/stream.h"

namespace natator {
namespace {

using nlohmann::ordered_json;

/// What a swim is to do, as an ACTS has it.
enum Kind : std::uint32_t { stand_still, go_on, take_drive, take_steering };

/// Takes numbers from an ACTS.
class ActionReader {
public:
    explicit ActionReader(std::string_view bytes) : left_(bytes) {}
    template <class T>
    T take() {
        if (left_.size() < sizeof(T)) throw InputError("ACTS: ends too early");
        T value;
        std::memcpy(&value, left_.data(), sizeof value);
        left_.remove_prefix(sizeof value);
        return value;
    }
    std::vector<double> take_numbers(std::size_t count) {
        if (left_.size() / sizeof(double) < count) throw InputError("ACTS: ends too early");
        std::vector<double> values(count);
        std::memcpy(values.data(), left_.data(), count * sizeof(double));
        left_.remove_prefix(count * sizeof(double));
        return values;
    }
    bool empty() const { return left_.empty(); }

private:
    std::string_view left_;
};

stream::Action read_action(ActionReader& from) {
    const auto kind = from.take<std::uint32_t>(), frames = from.take<std::uint32_t>(),
               rows = from.take<std::uint32_t>(), columns = from.take<std::uint32_t>();
    const bool steers = kind == take_drive || kind == take_steering;
    if (!steers && (rows != 0 || columns != 0)) throw InputError("ACTS: values without a use");
    std::vector<std::vector<double>> values;
    for (std::uint32_t row = 0; row < rows; ++row) {
        if (columns == 0) throw InputError("ACTS: rows without values");
        values.push_back(from.take_numbers(columns));
    }
    stream::Action action;
    if (kind == stand_still) return action;
    if (kind > take_steering)
        action.refusal = "ACTS: what to do = " + std::to_string(kind) + ": must be 0 to 3";
    else if (frames < 1 || frames > stream::max_step)
        action.refusal = "frames = " + std::to_string(frames) + ": must be a whole number in [1, 1000]";
    else if (steers && rows != 1 && rows != frames)
        action.refusal =
            std::to_string(rows) + " rows: must be 1, or one for each of the " + std::to_string(frames) + " frames";
    else if (kind == take_steering && columns % 2 != 0)
        action.refusal = std::to_string(columns) + " values: must be a scale and an offset for each actuator";
    if (!action.refusal.empty()) return action;
    stream::Step& step = action.step.emplace();
    step.frames = static_cast<int>(frames);
    for (std::vector<double>& row : values) {
        stream::Steer& steer = step.steer.emplace_back();
        if (kind == take_drive) {
            steer.drive = std::move(row);
        } else {
            const auto half = row.begin() + static_cast<std::ptrdiff_t>(columns / 2);
            steer.scale.emplace(row.begin(), half);
            steer.offset.emplace(half, row.end());
        }
    }
    return action;
}

}  // namespace

stream::Actions parse_stream_actions(std::string_view message, std::size_t swims) {
    ActionReader from(message);
    from.take<std::uint32_t>();  // letters
    const auto length = from.take<std::uint32_t>();
    if (message.size() - stream::message_head != length) throw InputError("ACTS: is cut off, or larger than 1 GiB");
    stream::Actions actions;
    actions.id = from.take<std::uint32_t>();
    const auto count = from.take<std::uint32_t>();
    if (count != swims)
        throw InputError("ACTS: of " + std::to_string(count) + " swims: must be of " + std::to_string(swims));
    actions.of.reserve(swims);
    for (std::size_t i = 0; i < swims; ++i) actions.of.push_back(read_action(from));
    if (!from.empty()) throw InputError("ACTS: has more than its swims");
    return actions;
}

namespace {

template <class Real>
std::vector<double> numbers_of(const Simulation<Real>& simulation, const Sensing& sensing, int swimmer) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const Model& model = simulation.model();
    if (model.body_of(swimmer).particles.empty()) return {};
    const Senses senses = sense(model, simulation.state(), sensing, swimmer);
    std::vector<double> numbers{static_cast<double>(simulation.frames()), simulation.time(),
                                simulation.distance(swimmer),
                                static_cast<double>(touches_plane(model, simulation.state(), swimmer)),
                                has_muscle_work(model) ? simulation.muscle_work(swimmer) : none};
    const auto add = [&numbers](const auto& values) { numbers.insert(numbers.end(), values.begin(), values.end()); };
    add(senses.centre);
    for (const int axis : {0, 1, 2}) add(Eigen::Vector3d(senses.axes.col(axis)));
    add(senses.velocity);
    add(senses.turn_rate);
    add(senses.target.value_or(Eigen::Vector3d::Constant(none)));
    numbers.push_back(senses.target ? senses.target_distance : none);
    add(simulation.driven(swimmer));
    add(senses.bend);
    for (const SkinFlow& felt : senses.flow) add(felt.velocity);
    for (const SkinFlow& felt : senses.flow) numbers.push_back(felt.particles);
    return numbers;
}

}  // namespace

template <class Real>
std::vector<double> stream_sense_numbers(const Simulation<Real>& simulation, const std::vector<Sensing>& sensing) {
    if (sensing.size() == 1) return numbers_of(simulation, sensing.front(), 0);
    std::vector<double> all, sizes;
    for (std::size_t k = 0; k < sensing.size(); ++k) {
        const std::vector<double> own = numbers_of(simulation, sensing[k], static_cast<int>(k));
        all.insert(all.end(), own.begin(), own.end());
        sizes.push_back(static_cast<double>(own.size()));
    }
    all.insert(all.end(), sizes.begin(), sizes.end());
    return all;
}

std::string stream_outcomes(std::uint32_t id, const std::vector<stream::Outcome>& outcomes) {
    MessageWriter message("OBSV");
    std::size_t numbers = 0;
    for (const stream::Outcome& outcome : outcomes) numbers += 1 + outcome.senses.size();
    message.reserve(numbers * sizeof(double) + 64);
    message.add(id);
    message.add(static_cast<std::uint32_t>(outcomes.size()));
    ordered_json refusals = ordered_json::object();
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        const stream::Outcome& outcome = outcomes[i];
        message.add(static_cast<std::uint32_t>(outcome.status));
        message.add(static_cast<std::uint32_t>(outcome.senses.size()));
        message.add_text(
            {reinterpret_cast<const char*>(outcome.senses.data()), outcome.senses.size() * sizeof(double)});
        if (!outcome.refusal.empty()) refusals[std::to_string(i)] = outcome.refusal;
    }
    message.add_text(refusals.dump(-1, ' ', false, ordered_json::error_handler_t::replace));
    return message.finish();
}

std::string stream_swim(std::uint32_t swim) {
    MessageWriter message("SWIM");
    message.add(swim);
    return message.finish();
}

template std::vector<double> stream_sense_numbers(const Simulation<float>&, const std::vector<Sensing>&);
template std::vector<double> stream_sense_numbers(const Simulation<double>&, const std::vector<Sensing>&);

}  // namespace natator
