#include "stages.h"

namespace natator::cpu {

/// Local relaxation: x_i += min(1, (1 + omega) / n_i) * sum of corrections, n_i = constraints of particle i (contacts
/// with depth > 0, fluid neighbours with r < R, springs, clusters). Global relaxation: x_i += omega * sum.
template <class Real>
void Stages<Real>::relax_and_apply() {
    const bool local = model_.parameters.relaxationMode == RelaxationMode::local;
    const Real omega = constants_.relaxation_factor;
    const auto apply = [&](int begin, int end) {
        for (int slot = begin; slot < end; ++slot) {
            const Real n = std::max(ws_.constraint_count[slot], Real(1));
            const Real scale = local ? std::min(Real(1), (1 + omega) / n) : omega;
            ws_.position.x[slot] += scale * ws_.correction.x[slot];
            ws_.position.y[slot] += scale * ws_.correction.y[slot];
            ws_.position.z[slot] += scale * ws_.correction.z[slot];
        }
    };
    apply(0, ws_.fluid);
    apply(ws_.solid_begin, ws_.slots);
}

template void Stages<float>::relax_and_apply();
template void Stages<double>::relax_and_apply();

}  // namespace natator::cpu
