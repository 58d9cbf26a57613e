#pragma once

#include <cstdint>

#include "kernel_table.h"

namespace natator::cpu {

/// Input and output of the fluid kernels; plain pointers, because the kernels are compiled once per instruction set
/// and must not share inline code with the rest of the program. Arrays are by slot unless said otherwise.
template <class Real>
struct FluidView {
    int first_block, end_block;     ///< the blocks to work on
    const int* row_begin;           ///< by block
    const std::int32_t* neighbour;  ///< rows of 16 slots
    int far_slot;                   ///< what unused entries of the rows hold
    Real radius;
    Real inverse_radius;
    Real density_scale;

    const Real* position[3];
    const Real* inverse_mass;
    const Real* solid_density;
    Real* density;
    Real* compression;
    Real* correction[3];
    Real* constraint_count;

    const Real* velocity[3];
    Real* velocity_change[3];

    // Room for the kernels.
    Real* packed;           ///< 4 per slot: position and compression
    Real* packed_velocity;  ///< 4 per slot: velocity and anything
    Real* distance;         ///< one per entry of the rows; null: distances are computed anew where they are needed
};

/// The hot loops of the solver in one instruction set. Each particle's sums are computed apart, so blocks may be worked
/// on side by side once the packing that a loop needs is done for all.
template <class Real>
struct FluidKernels {
    /// Lays positions and compressions out for the other loops.
    void (*pack)(const FluidView<Real>& fluid);
    /// Lays velocities out, as positions are.
    void (*pack_velocity)(const FluidView<Real>& fluid);
    /// Needs packed positions. density_i = (sum_j (1 - r/R)^2 + solid_density_i) / S and compression C_i =
    /// max(density_i - 1, 0).
    void (*compute_density)(const FluidView<Real>& fluid);
    /// Needs compute_density, and positions and compressions packed anew. correction_i = w_i R sum_j 1/2 (C_i + C_j) (1
    /// - r/R) n; constraint_count_i = neighbours with r < R.
    void (*solve_density_constraint)(const FluidView<Real>& fluid);
    /// Needs packed positions and velocities. velocity_change_i = sum_j W_ij (u_j - u_i), W = (1 - r/R)^2 / S.
    void (*smooth_velocities)(const FluidView<Real>& fluid);
};

NATATOR_DECLARE_KERNELS(FluidKernels, fluid_kernels)
/// The fluid's kernels, particle by particle.
NATATOR_DECLARE_KERNELS(FluidKernels, scalar_fluid_kernels)

}  // namespace natator::cpu
