#pragma once

#include <cstdint>

#include "solver/cpu/kernel_table.h"

namespace natator::cpu {

/// Input and output of the kernels of scheme `conserving`, by slot. Slots of all particles come first, in blocks;
/// behind them are their ghosts, which have no rows of their own.
template <class Real>
struct WaterView {
    int first_block, end_block;     ///< the blocks to work on
    const int* row_begin;           ///< by block
    const std::int32_t* neighbour;  ///< rows of 16 slots
    int far_slot;                   ///< what unused entries of the rows hold

    Real inverse_radius, kernel_scale, slope_scale;  ///< see physics::WendlandKernel
    Real at_spacing;                                 ///< 1 / W at the rest spacing
    Real softening;                                  ///< of r^2 in the viscosity

    const Real* position[3];
    const Real* volume;
    const Real* inverse_mass;
    const Real* mobility;  ///< see physics::mobility
    const Real* solid;     ///< 1 for solids, 0 for water
    Real* velocity[3];
    Real* density;
    Real* correction[6];            ///< L_i: xx, yy, zz, xy, xz, yz
    Real* crowding[3];              ///< where neighbours crowd, 1/length
    Real* max_speed_square;         ///< largest |v_j - v_i|^2
    Real* response;                 ///< see physics::ResponseSums
    Real* target;                   ///< rate of expansion that a solve goes for, times V_i
    Real* impulse;                  ///< pressure impulse of one pass
    Real* impulse_sum;              ///< of the substep so far
    Real* zeroth[3];                ///< sum of G_ij
    Real* zeroth_order_correction;  ///< of the pressure, see physics::zeroth_order_correction

    // By slot, four at a time, also for ghosts: what neighbours gather.
    Real* packed;               ///< position and volume
    Real* packed_velocity;      ///< velocity and mobility
    Real* packed_correction;    ///< L: xx, yy, zz, xy
    Real* packed_shear;         ///< L: xz, yz; solid
    Real* packed_zeroth_order;  ///< E_j times its zeroth_order_share

    // By entry of the rows.
    Real* distance;     ///< cheaper to read than to compute anew from two positions
    Real* gradient[3];  ///< G_ij
};

/// Each particle's sums are computed apart, so blocks may be worked on side by side. The view comes by value: no store
/// can change it, and what it holds need not be read anew after each.
template <class Real>
struct WaterKernels {
    /// Lays positions with volumes, and velocities with mobilities, out for the rest.
    void (*pack)(WaterView<Real> water);
    /// Density, correction (also laid out), crowding; distance.
    void (*compute_moments)(WaterView<Real> water);
    /// gradient, zeroth, response and max_speed_square; and, while the gradients are at hand, the impulse of a first
    /// pass of target 0.
    void (*compute_gradients)(WaterView<Real> water);
    /// Adds w_i strength sum of viscous impulses to the velocities; what neighbours gather stays as it was. `limit`:
    /// see physics::viscous_share.
    void (*add_viscosity)(WaterView<Real> water, Real strength, Real limit);
    /// impulse of a Jacobi pass: what takes a rate of expansion below its target there, never above; in impulse_sum
    /// too.
    void (*compute_impulse)(WaterView<Real> water);
    /// v_i -= w_i sum (impulse_i + impulse_j) G_ij, also laid out.
    void (*apply_impulse)(WaterView<Real> water);
    /// Takes off what the zeroth_order_correction has grown by, also laid out. `strength`: see
    /// physics::uncorrected_impulse.
    void (*apply_zeroth_order_correction)(WaterView<Real> water, Real strength);
    /// Lays E out for the neighbours.
    void (*lay_out_zeroth_order_correction)(WaterView<Real> water);
    /// Gives it back.
    void (*return_zeroth_order_correction)(WaterView<Real> water);
};

NATATOR_DECLARE_KERNELS(WaterKernels, water_kernels)
/// The kernels of scheme `conserving`, particle by particle.
NATATOR_DECLARE_KERNELS(WaterKernels, scalar_water_kernels)

}  // namespace natator::cpu
