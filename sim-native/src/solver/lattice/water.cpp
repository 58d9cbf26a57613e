#include "water.h"

namespace natator::lattice {

void equilibrium(const Cell& cell, float (&to)[17]) {
    const double rho = 1 + cell.excess, r3 = cell.excess / 3, x = cell.velocity.x(), y = cell.velocity.y(),
                 z = cell.velocity.z();
    const double third = rho / 3;
    const double values[17] = {cell.excess,
                               rho * x,
                               rho * y,
                               rho * z,
                               r3 + rho * x * x,
                               r3 + rho * y * y,
                               r3 + rho * z * z,
                               rho * x * y,
                               rho * x * z,
                               rho * y * z,
                               y * (third + rho * x * x),
                               z * (third + rho * x * x),
                               x * (third + rho * y * y),
                               z * (third + rho * y * y),
                               x * (third + rho * z * z),
                               y * (third + rho * z * z),
                               rho * x * y * z};
    for (int e = 0; e < 17; ++e) to[e] = static_cast<float>(values[e]);
}

physics::LatticeRates rates_in(const Box& box, double step) {
    return physics::lattice_rates(box.viscosity * step / (box.cell * box.cell), box.smagorinsky);
}

Populations inflow(const Box& box, double step) {
    const Eigen::Vector3f current = (box.current * step / box.cell).cast<float>();
    const float u[3] = {current.x(), current.y(), current.z()};
    Populations populations;
    physics::moving_populations(u, populations.of);
    return populations;
}

}  // namespace natator::lattice
