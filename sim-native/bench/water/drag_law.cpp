#include "water/drag_law.h"

#include <cmath>
#include <numbers>

namespace natator::bench {

double drag_of_sphere(double reynolds) {
    return 24 / reynolds * (1 + 0.15 * std::pow(reynolds, 0.687));
}

double history_of_drag(double age, double speed, double diameter, double viscosity) {
    const double f = 0.75 + 0.105 * speed * diameter / viscosity;
    const double slow = std::pow(4 * std::numbers::pi * viscosity * age / (diameter * diameter), 0.25);
    const double fast = age * std::sqrt(std::numbers::pi * std::pow(speed / f, 3) / (diameter * viscosity));
    return 1 / ((slow + fast) * (slow + fast));
}

double blockage_of_sphere(double drag_coefficient, double diameter, double cross_section) {
    const double volume = std::numbers::pi / 6 * std::pow(diameter, 3);
    const double area = std::numbers::pi / 4 * diameter * diameter;
    return 0.96 * volume / std::pow(cross_section, 1.5) + drag_coefficient * area / (4 * cross_section);
}

double blockage_of_cylinder(double drag_coefficient, double diameter, double height) {
    const double ratio = diameter / height;
    return 0.82 * ratio * ratio + drag_coefficient * ratio / 4;
}

}  // namespace natator::bench
