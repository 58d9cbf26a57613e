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

/// The constraints of planes on particles near them, in one instruction set. `chosen` has a bit per lane of a block. No
/// product is fused with a sum, so that all sets give the same bits.
template <class Real>
struct PlaneKernels {
    /// Bit per lane: is the particle within plane.distance of the plane?
    unsigned (*near)(const NearPlanes<Real>& slots, int block, const PlaneView<Real>& plane);
    /// Moves the chosen particles out of the plane.
    void (*resolve_penetration)(const NearPlanes<Real>& slots, int block, unsigned chosen,
                                const PlaneView<Real>& plane);
};

NATATOR_DECLARE_KERNELS(PlaneKernels, plane_kernels)
/// The kernels of planes, particle by particle.
NATATOR_DECLARE_KERNELS(PlaneKernels, scalar_plane_kernels)

}  // namespace natator::cpu
