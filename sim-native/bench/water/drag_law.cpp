#include "water/drag_law.h"

#include <cmath>
#include <numbers>

namespace natator::bench {

double drag_of_sphere(double reynolds) {
    return 24 / reynolds * (1 + 0.15 * std::pow(reynolds, 0.687));
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
