// Compiled once per instruction set, like fluid_kernels.cpp and by the same rules, but without fused products: every
// set gives the same bits. physics/velocity.h has the formulas.
#include "motion_kernels.h"

#include "particle_groups.h"
#include "physics/velocity.h"

namespace natator::cpu::NATATOR_ISA {
namespace {

template <class Real>
void relax(const MotionView<Real>& slots, Real omega, bool local) {
    using Group = Vector<Real>;
    for_each_group<Group>(slots, [&](int slot) {
        const auto scale = relaxation(Group::get(slots.constraint_count + slot), omega, local);
        const auto x = get3<Group>(slots.position, slot);
        put3<Group>(slots.position, slot, x + scale * get3<Group>(slots.correction, slot));
    });
}

template <class Real>
void displacement_velocity(const MotionView<Real>& slots, Real inverse_h) {
    using Group = Vector<Real>;
    for_each_group<Group>(slots, [&](int slot) {
        const auto moved = get3<Group>(slots.position, slot) - get3<Group>(slots.start, slot);
        put3<Group>(slots.velocity, slot, inverse_h * moved);
    });
}

template <class Real>
void finish_velocity(const MotionView<Real>& slots, int viscous_blocks, const VelocityRule<Real>& rule) {
    using Group = Vector<Real>;
    VelocityRule<Real> without_viscosity = rule;
    without_viscosity.viscosity = false;
    for_each_group<Group>(slots, [&](int slot) {
        const auto u = get3<Group>(slots.velocity, slot);
        const auto smoothing = get3<Group>(slots.correction, slot),
                   predicted = get3<Group>(slots.predicted_velocity, slot);
        const VelocityRule<Real>& own = slot < viscous_blocks * lanes ? rule : without_viscosity;
        put3<Group>(slots.velocity, slot, flex_velocity(u, smoothing, predicted, own));
    });
}

template <class Real>
bool finite(const Real* values, int count) {
    int bad = 0;
    for (int k = 0; k < count; ++k) bad |= values[k] - values[k] == 0 ? 0 : 1;
    return bad == 0;
}

}  // namespace

template <class Real>
MotionKernels<Real> motion_kernels() {
    return {&relax<Real>, &displacement_velocity<Real>, &finish_velocity<Real>, &finite<Real>};
}
template MotionKernels<float> motion_kernels<float>();
template MotionKernels<double> motion_kernels<double>();

}  // namespace natator::cpu::NATATOR_ISA
