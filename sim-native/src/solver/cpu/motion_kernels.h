#pragma once

#include "kernel_table.h"
#include "physics/velocity.h"

namespace natator::cpu {

/// Arrays by slot for the kernels below, which work on whole blocks of 16 slots.
template <class Real>
struct MotionView {
    int first_block, end_block;  ///< the blocks to work on
    Real* position[3];
    const Real* start[3];
    const Real* predicted_velocity[3];
    const Real* correction[3];
    const Real* constraint_count;
    Real* velocity[3];
};

/// Kernels that move each particle by itself, in one instruction set. No product is fused with a sum, so that all sets
/// give the same bits.
template <class Real>
struct MotionKernels {
    /// x += relaxation * correction.
    void (*relax)(const MotionView<Real>& slots, Real omega, bool local);
    /// velocity = (x - start) / h.
    void (*displacement_velocity)(const MotionView<Real>& slots, Real inverse_h);
    /// Velocity of the displacement to velocity of the particle; the first blocks have the viscosity's sums in
    /// MotionView::correction.
    void (*finish_velocity)(const MotionView<Real>& slots, int viscous_blocks, const physics::VelocityRule<Real>& rule);
    /// Are all of them finite?
    bool (*finite)(const Real* values, int count);
};

NATATOR_DECLARE_KERNELS(MotionKernels, motion_kernels)

}  // namespace natator::cpu
