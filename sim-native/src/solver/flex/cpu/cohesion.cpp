#include "flex_stages.h"
#include "physics/effects.h"
#include "solver/cpu/effects/fluid_neighbours.h"

namespace natator::cpu {

/// Dx_i = -w_i cohesion R sum over fluid j of f(r/R) n, n from j to i. The pairs are those of the density constraint,
/// so they add no constraints to the pooled count. The weight w_i is taken from there too: measured with w = 1 only.
template <class Real>
void FlexStages<Real>::solve_cohesion() {
    const Real strength = static_cast<Real>(model_.parameters.cohesion) * constants_.radius;
    for (int slot = 0; slot < ws_.fluid; ++slot) {
        Vec3<Real> sum{};
        this->for_each_fluid_neighbour(slot, [&](int, const Vec3<Real>& difference, Real r, Real q) {
            sum += physics::cohesion_pull(q, constants_.cohesion_slope) / r * difference;
        });
        ws_.correction.add(slot, -ws_.inverse_mass[slot] * strength * sum);
    }
}

template void FlexStages<float>::solve_cohesion();
template void FlexStages<double>::solve_cohesion();

}  // namespace natator::cpu
