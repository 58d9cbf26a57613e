#pragma once

#include "natator/instruction_set.h"

namespace natator::cpu {

/// Arrays by slot for the kernels below, which work on whole blocks of 16 slots.
template <class Real>
struct MotionView {
    int first_block, end_block;  ///< the blocks to work on
    Real* position[3];
    const Real* start[3];
    const Real* predicted[3];
    const Real* correction[3];
    const Real* constraint_count;
    Real* velocity[3];
};

/// What makes a velocity out of a displacement, see FlexStages::update_velocities. The booleans say what applies.
template <class Real>
struct VelocityRule {
    int viscous_blocks;  ///< the first blocks, whose velocity changes are in MotionView::correction
    Real viscosity_step;
    bool damping;
    Real damping_step;
    bool clamp_acceleration;
    Real most_change;
    bool clamp_speed;
    Real max_speed;
};

/// Plane n x + offset = 0 and its friction, see Substep::friction.
template <class Real>
struct PlaneView {
    Real normal[3];
    Real offset;
    Real distance;  ///< held from the plane
    bool friction;
    Real static_friction, dynamic_friction;
};

/// What happens to each particle by itself, in one instruction set. No product is fused with a sum, so that all sets
/// give the same bits.
template <class Real>
struct MotionKernels {
    /// x += min(1, most / max(n, 1)) * correction, n = constraint_count; or x += most * correction.
    void (*relax)(const MotionView<Real>& slots, Real most, bool local);
    /// velocity = (x - start) / h.
    void (*displacement_velocity)(const MotionView<Real>& slots, Real inverse_h);
    /// Velocity of the displacement to velocity of the particle.
    void (*finish_velocity)(const MotionView<Real>& slots, const VelocityRule<Real>& rule);
    /// Are all of them finite?
    bool (*finite)(const Real* values, int count);
    /// Bit per lane of a block: is the particle within plane.distance of the plane?
    unsigned (*near_plane)(const MotionView<Real>& slots, int block, const PlaneView<Real>& plane);
    /// Moves the chosen particles of a block out of the plane.
    void (*push_from_plane)(const MotionView<Real>& slots, int block, unsigned chosen, const PlaneView<Real>& plane);
};

namespace portable {
template <class Real>
MotionKernels<Real> motion_kernels();
template <class Real>
MotionKernels<Real> scalar_motion_kernels();
}  // namespace portable
namespace avx2 {
template <class Real>
MotionKernels<Real> motion_kernels();
template <class Real>
MotionKernels<Real> scalar_motion_kernels();
}  // namespace avx2
namespace avx512 {
template <class Real>
MotionKernels<Real> motion_kernels();
template <class Real>
MotionKernels<Real> scalar_motion_kernels();
}  // namespace avx512

/// The kernels for an instruction set, and the plain loops that they must agree with; sets that this build lacks give
/// the portable ones.
template <class Real>
const MotionKernels<Real>& motion_kernels(InstructionSet set);
template <class Real>
const MotionKernels<Real>& scalar_motion_kernels(InstructionSet set);

}  // namespace natator::cpu
