#pragma once

#include "kernel_table.h"

namespace natator::cpu {

/// Plane n x + offset = 0 and its friction, see Substep::friction.
template <class Real>
struct PlaneView {
    Real normal[3];
    Real offset;
    Real distance;  ///< held from the plane
    bool friction;
    Real static_friction, dynamic_friction;
};

/// Arrays by slot of what is near planes, in blocks of 16 slots.
template <class Real>
struct NearPlanes {
    Real* position[3];
    const Real* start[3];
    const Real* base[3];    ///< where positions are counted from, position = base + displacement; null if they are not
    Real* displacement[3];  ///< null without a base
};

/// What planes do to the density constraints of scheme `conserving`, by slot.
template <class Real>
struct PlanePressure {
    const Real* position[3];
    Real scale;           ///< 2 pi n0 R^3 A
    Real gap;             ///< from a plane to where the fluid behind it begins
    Real inverse_radius;  ///< 1 / R
    Real* density;
    Real* gradient[3];  ///< grad_i C_i
    const Real* inverse_mass;
    const Real* lambda;
    Real* correction[3];
};

/// What planes do to the particles near them, in one instruction set. `chosen` has a bit per lane of a block. No
/// product is fused with a sum, so that all sets give the same bits.
template <class Real>
struct PlaneKernels {
    /// Bit per lane: is the particle within plane.distance of the plane?
    unsigned (*near)(const NearPlanes<Real>& slots, int block, const PlaneView<Real>& plane);
    /// Moves the chosen particles out of the plane.
    void (*resolve_penetration)(const NearPlanes<Real>& slots, int block, unsigned chosen,
                                const PlaneView<Real>& plane);
    /// Adds the plane's part to the density of the chosen particles and to its gradient. Behind a plane the density
    /// goes on as in fluid at rest, else particles crowd at walls and floor and the pressure there is wrong: the part
    /// of the kernel beyond distance s = q R of a particle, integrated,
    ///   n0 R^3 A 2 pi ((1 - q)^5 / 20 - (1 - q)^6 / 30), n0 = particles per volume of the rest packing,
    /// an idea of Koschier, Bender: Density Maps for Improved SPH Boundary Handling (2017), here in closed form.
    void (*add_density)(const PlanePressure<Real>& slots, int block, unsigned chosen, const PlaneView<Real>& plane);
    /// The plane's part of the density constraints: Dx_i = w_i lambda_i grad_i C_i. Planes take up any momentum.
    void (*apply_pressure)(const PlanePressure<Real>& slots, int block, unsigned chosen, const PlaneView<Real>& plane);
};

NATATOR_DECLARE_KERNELS(PlaneKernels, plane_kernels)
/// The same particle by particle.
NATATOR_DECLARE_KERNELS(PlaneKernels, scalar_plane_kernels)

}  // namespace natator::cpu
