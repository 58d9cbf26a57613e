#pragma once

#include <cstdint>

#include "natator/instruction_set.h"

namespace natator::cpu {

/// A run of slots [begin, end).
struct SlotRun {
    int begin;
    int end;
};

/// What the fluid kernels read and write; plain pointers, because the kernels are compiled once per instruction set
/// and must not share inline code with the rest of the program. Arrays are by slot unless said otherwise.
template <class Real>
struct FluidView {
    int blocks;
    const int* row_begin;           ///< by block
    const std::int32_t* neighbour;  ///< rows of 16 slots
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
};

/// The hot loops of the solver in one instruction set.
template <class Real>
struct FluidKernels {
    /// Appends to `found` the slots of the runs that are nearer to `slot` than sqrt(distance_squared), without those
    /// at distance 0. Returns their number. `found` must have room for one entry more than the runs have slots.
    int (*append_neighbours)(const FluidView<Real>& fluid, int slot, const SlotRun* runs, int run_count,
                             Real distance_squared, std::int32_t* found);
    /// density_i = (sum_j (1 - r/R)^2 + solid_density_i) / S and compression C_i = max(density_i - 1, 0).
    void (*compute_density)(const FluidView<Real>& fluid);
    /// correction_i = w_i R sum_j 1/2 (C_i + C_j) (1 - r/R) n; constraint_count_i = neighbours with r < R.
    void (*solve_density_constraint)(const FluidView<Real>& fluid);
    /// velocity_change_i = sum_j W_ij (u_j - u_i), W = (1 - r/R)^2 / S.
    void (*smooth_velocities)(const FluidView<Real>& fluid);
};

namespace portable {
template <class Real>
FluidKernels<Real> fluid_kernels();
}
namespace avx2 {
template <class Real>
FluidKernels<Real> fluid_kernels();
}
namespace avx512 {
template <class Real>
FluidKernels<Real> fluid_kernels();
}

/// The kernels for an instruction set; sets that this build lacks give the portable ones.
template <class Real>
const FluidKernels<Real>& fluid_kernels(InstructionSet set);

}  // namespace natator::cpu
