// Scheme `conserving`: what springs and clusters did to a free body's momentum, to be given back: these forces are
// internal. With x1 = x0 + h v1 the angular momentum after the substep is sum of m x0 x v1, so they must have no moment
// about the start positions: sum of m x0 x Dx = 0. Position corrections have none about the positions they were
// computed at, which leaves an error of first order in h. It is given back as a rigid rotation of the velocities, as
// momentum is in Dinev et al.: FEPR: Fast Energy Projection for Real-Time Simulation of Deformable Objects (2018).
#pragma once

#include "symmetric3.h"

namespace natator::physics {

/// Over the particles of a body: mass, and mass times positions at the start of the substep and now.
struct BodyCentres {
    double mass = 0;
    Vec3<double> start{}, now{};
};

/// Over the same: what internal forces gave it, and its inertia about where its centre is now.
struct BodyMoments {
    Vec3<double> momentum{}, moment{};
    Symmetric3<double> inertia{};
};

/// Velocity to add: linear + angular x (x - centre).
struct BodyMotion {
    Vec3<double> linear{}, angular{}, centre{};
};

inline namespace NATATOR_SET {

NATATOR_HD void add(BodyCentres& sums, double mass, const Vec3<double>& start, const Vec3<double>& now) {
    sums.mass += mass;
    sums.start += mass * start;
    sums.now += mass * now;
}

/// `impulse`: mass times internal displacement / h; the arms are from the centres.
NATATOR_HD void add(BodyMoments& sums, double mass, const Vec3<double>& impulse, const Vec3<double>& arm_at_start,
                    const Vec3<double>& arm) {
    sums.momentum += impulse;
    sums.moment += cross(arm_at_start, impulse);
    const double square = dot(arm, arm);
    sums.inertia = sums.inertia + Symmetric3<double>{mass * (square - arm.x * arm.x), mass * (square - arm.y * arm.y),
                                                     mass * (square - arm.z * arm.z), -mass * arm.x * arm.y,
                                                     -mass * arm.x * arm.z,           -mass * arm.y * arm.z};
}

/// A straight chain has no inertia about its own axis, and no moment either: the solution of least norm.
NATATOR_HD BodyMotion motion_of(const BodyCentres& centres, const BodyMoments& moments) {
    return {-1 / centres.mass * moments.momentum, -1.0 * least_norm_solution(moments.inertia, moments.moment),
            centres.now / centres.mass};
}

NATATOR_HD Vec3<double> velocity_at(const BodyMotion& motion, const Vec3<double>& x) {
    return motion.linear + cross(motion.angular, x - motion.centre);
}

}  // namespace NATATOR_SET
}  // namespace natator::physics
