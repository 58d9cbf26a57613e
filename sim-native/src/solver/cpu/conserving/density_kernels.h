#pragma once

#include <cstdint>

#include "../kernel_table.h"

namespace natator::cpu {

/// What the density kernels of scheme `conserving` read and write, by slot; see FluidView for the ground rules.
template <class Real>
struct DensityView {
    int first_block, end_block;     ///< the blocks to work on
    const int* row_begin;           ///< by block
    const std::int32_t* neighbour;  ///< rows of 16 slots
    int far_slot;                   ///< what unused entries of the rows hold
    Real inverse_radius;
    Real kernel_scale;    ///< A: W(r)/rho0 = A (1 - q)^3, spiky
    Real rest_sum;        ///< sum of (1 - q)^3 over the neighbours in the rest packing
    Real gradient_scale;  ///< B: |grad W(r)|/rho0 = B (1 - q)^2, of the same kernel

    const Real* position[3];
    const Real* inverse_mass;
    const Real* solid_density;          ///< what solids add to the density
    const Real* solid_gradient[3];      ///< what solids add to grad_i C_i
    const Real* solid_gradient_square;  ///< what solids add to sum_k w_k |grad_k C_i|^2
    Real* density;
    Real* lambda;
    Real* response;    ///< 1 / (w_i |grad_i C_i|^2 + sum_k w_k |grad_k C_i|^2)
    Real* lambda_sum;  ///< of the substep so far
    Real* correction[3];

    const Real* velocity[3];
    Real* velocity_change[3];

    // Room for the kernels.
    Real* packed;            ///< 4 per slot: position, and inverse mass or lambda
    Real* packed_velocity;   ///< 4 per slot: velocity and inverse mass
    Real* inverse_distance;  ///< one per entry of the rows, or null where they are computed anew
};

/// Each particle's sums are computed apart, so blocks may be worked on side by side once the packing that a loop needs
/// is done for all.
template <class Real>
struct DensityKernels {
    /// Lays positions and inverse masses out for compute_lambda, compute_rate_lambda and smooth_velocities.
    void (*pack)(const DensityView<Real>& fluid);
    /// Positions and lambda, for solve_density_constraint.
    void (*pack_lambda)(const DensityView<Real>& fluid);
    /// Velocities, for compute_rate_lambda and smooth_velocities.
    void (*pack_velocity)(const DensityView<Real>& fluid);
    /// C_i = A (sum_j (1 - q)^3 - rest sum) + solids, which rounds less than density_i - 1; density_i = 1 + C_i;
    /// lambda_i = -max(C_i, 0) / (w_i |grad_i C_i|^2 + sum_k w_k |grad_k C_i|^2).
    void (*compute_lambda)(const DensityView<Real>& fluid);
    /// At the positions that a lambda was last computed at. correction_i = w_i sum_j (lambda_i + lambda_j) grad_i W_ij
    /// / rho0.
    void (*solve_density_constraint)(const DensityView<Real>& fluid);
    /// lambda_i of the rate of change of C_i, for particles that were under pressure: what takes it to 0, but at most
    /// what the pressure gave (times 1/h), so that neighbours are never pulled together.
    void (*compute_rate_lambda)(const DensityView<Real>& fluid, Real inverse_h);
    /// velocity_change_i = sum_j A (1 - q^2)^3 2 w_i / (w_i + w_j) (u_j - u_i): equal and opposite momenta per pair.
    void (*smooth_velocities)(const DensityView<Real>& fluid);
};

NATATOR_DECLARE_KERNELS(DensityKernels, density_kernels)
/// The same particle by particle.
NATATOR_DECLARE_KERNELS(DensityKernels, scalar_density_kernels)

}  // namespace natator::cpu
