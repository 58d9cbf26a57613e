// Springs: distance constraints C = l - l0.
#pragma once

#include "constants.h"
#include "vec3.h"

namespace natator::physics::inline NATATOR_SET {

/// Scheme `flex`: Dx_a = k w_a / (w_a + w_b) (l0 - l) n, the stiffness as it is in every iteration. Returns
/// Dx_a / w_a = -Dx_b / w_b for `difference` from b to a.
template <class T>
NATATOR_HD Vec3<T> spring_push(const Vec3<T>& difference, T weights, T rest_length, T stiffness) {
    const T length = norm(difference);
    if (!(weights > 0 && length > 0)) return {};
    return stiffness * (rest_length - length) / weights / length * difference;
}

/// Scheme `conserving`: compliance of a constraint relative to its inverse mass. `softness` is what its stiffness means
/// at the thesis' substep h0, see softness().
NATATOR_HD double relative_compliance(double softness, double h) {
    const double ratio = thesis_substep / h;
    return softness * ratio * ratio;
}

/// The same spring by XPBD (Macklin, Müller, Chentanez 2016, eq. 18) with split masses, n = springs on a particle:
///   Dlambda = (-C - alpha lambda) / (w_a n_a + w_b n_b + alpha), Dx_a = w_a Dlambda n.
/// Returns Dx_a / w_a and adds to lambda; the length of `difference` must not be 0.
template <class T>
NATATOR_HD Vec3<T> xpbd_spring_push(const Vec3<T>& difference, T length, T rest_length, T split, T alpha, T& lambda) {
    const T change = (rest_length - length - alpha * lambda) / (split + alpha);
    lambda += change;
    return change / length * difference;
}

/// Work of a change of rest length in a substep of length h, against the push lambda / h^2 with which the spring ends it:
/// dW = lambda / h^2 dl0. With the energy 1/2 k (l - l0)^2 of the spring and implicit Euler this is what the energy of masses
/// and springs grows by, and what the step takes off: 1/2 sum m |dv|^2 + 1/2 k (dl - dl0)^2 >= 0, of first order in h.
NATATOR_HD double spring_work(double lambda, double h, double change) {
    return lambda / (h * h) * change;
}

}  // namespace natator::physics::inline NATATOR_SET
