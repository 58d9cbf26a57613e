#pragma once

#include "natator/parameters.h"

namespace natator::cpu {

/// Pull between two fluid particles at distance q R as a multiple of cohesion * R, negative where they are pushed
/// apart:
///   f(q) = -1 + b q^2 - (b - 1) q^3, b = 1 + 1/s + 1/s^2, s = fluidRestDistance / R,
/// the cubic with f(0) = -1, f'(0) = 0, f(s) = f(1) = 0. A spline along the line between two particles that pushes near
/// and pulls far as in Akinci, Akinci, Teschner: Versatile Surface Tension and Adhesion for SPH Fluids (2013), eq. 1-2;
/// its form is fitted to measurements of NVIDIA Flex (f_grid3_cohesion0.025_s0.08 in tests/conformance), to 2e-8.
template <class Real>
struct CohesionSpline {
    explicit CohesionSpline(const SolverParameters& p) {
        const double s = p.fluidRestDistance / p.radius;
        b = static_cast<Real>(1 + 1 / s + 1 / (s * s));
    }
    Real operator()(Real q) const { return q * q * (b - (b - 1) * q) - 1; }

    Real b;
};

}  // namespace natator::cpu
