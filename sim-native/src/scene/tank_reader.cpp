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

}  // namespace natator::fields
