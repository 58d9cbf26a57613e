#include <algorithm>

#include "model/tank_ends.h"
#include "readers.h"

namespace natator::fields {

MovingTank read_moving_tank(const json& value, const Place& place) {
    static const std::vector<Field<MovingTank>> table = {
        {"step", &MovingTank::step, {1e-6, 10000, false, "length"}},
        {"current", &MovingTank::current, {-1000, 1000, false, "length/s"}},
    };
    MovingTank tank;
    read_object(value, place, table, {"along"}, tank);
    if (value.contains("along"))
        tank.along_z = read_choice<bool>(value.at("along"), place.key("along"), {{"x", false}, {"xz", true}});
    if (tank.current.y() != 0)
        refuse(place.key("current").item(1), value.at("current")[1], "0: a current is horizontal");
    return tank;
}

std::vector<PeriodicAxis> read_periodic(const json& value, const Place& place, bool water, std::vector<Plane>& planes) {
    if (!value.is_array()) refuse(place, value, "an array of axes, \"x\" or \"z\"");
    std::vector<PeriodicAxis> all;
    std::vector<int> named;
    for (std::size_t i = 0; i < value.size(); ++i) {
        const Place at = place.item(i);
        const int axis = read_choice<int>(value[i], at, {{"x", 0}, {"z", 2}});
        if (std::any_of(named.begin(), named.end(), [axis](int other) { return other == axis; }))
            refuse(at, value[i], "named once");
        named.push_back(axis);
        const TankEnds ends = tank_ends(planes, axis);
        if (!water && ends.none()) continue;
        if (!ends.one_each()) refuse(at, value[i], "an axis with walls to do without: " + one_each_needed(ends, axis));
        if (!(ends.high.front() > ends.low.front()))
            refuse(at, value[i], "an axis whose low end is below its high end");
        std::erase_if(planes, [axis](const Plane& plane) { return is_across(plane, axis); });
        all.push_back({axis, ends.low.front(), ends.high.front()});
    }
    std::sort(all.begin(), all.end(), [](const PeriodicAxis& a, const PeriodicAxis& b) { return a.axis < b.axis; });
    return all;
}

}  // namespace natator::fields
