#include <cmath>
#include <sstream>

#include "base/text.h"
#include "readers.h"

namespace natator::fields {
namespace {

using Measure = Goal::Measure;

constexpr std::size_t max_goals = 16;

std::vector<std::pair<std::string_view, Measure>> measures() {
    std::vector<std::pair<std::string_view, Measure>> words;
    for (const Measure measure : {Measure::distance, Measure::forward, Measure::turn, Measure::depth, Measure::reach,
                                  Measure::hold, Measure::economy})
        words.emplace_back(to_string(measure), measure);
    return words;
}

/// `target` of a goal that is arrived at: an angle, a height or a place; and how near is near enough.
void read_target(const json& value, const Place& place, Goal& goal) {
    const json& target = required(value, place, "target");
    const Place at = place.key("target");
    const Range turn{-3600, 3600, false, "degrees"}, way{-10000, 10000, false, "length"};
    double far = 0;
    if (goal.measure == Measure::reach) {
        read(target, at, way, goal.place);
        far = goal.place.norm();
    } else {
        read(target, at, goal.measure == Measure::turn ? turn : way, goal.amount);
        far = std::abs(goal.amount);
    }
    goal.within = goal.measure == Measure::turn ? 5 : 0.1;
    if (value.contains("within"))
        read(value.at("within"), place.key("within"), {0, 10000, true, "degrees or length"}, goal.within);
    if (far <= goal.within) {
        std::ostringstream text;
        text << "farther than `within`, " << number_text(goal.within) << ", from the start";
        refuse(at, target, text.str());
    }
}

Goal read_goal(const json& value, const Place& place) {
    static const std::vector<Field<Goal>> table = {
        {"weight", &Goal::weight, {-1e6, 1e6}},
        {"stop", &Goal::stop},
    };
    if (!value.is_object()) refuse(place, value, "an object with `measure`");
    Goal goal;
    goal.measure = read_choice<Measure>(required(value, place, "measure"), place.key("measure"), measures());
    if (goal.arrives()) {
        read_object(value, place, table, {"measure", "target", "within"}, goal);
        read_target(value, place, goal);
    } else {
        read_object(value, place, {table.front()}, {"measure"}, goal);
    }
    return goal;
}

}  // namespace

std::vector<Goal> read_goals(const json& value, const Place& place) {
    if (!value.is_array() || value.size() > max_goals)
        refuse(place, value, "an array of at most " + std::to_string(max_goals) + " goals");
    std::vector<Goal> goals;
    for (std::size_t i = 0; i < value.size(); ++i) goals.push_back(read_goal(value[i], place.item(i)));
    return goals;
}

}  // namespace natator::fields
