// Springs: distance constraints C = l - l0.
#pragma once

#include <cmath>

#include "constants.h"
#include "vec3.h"

namespace natator::physics {

/// Compliance of a constraint of stiffness k in [0, 1] relative to its inverse mass at substep length h0 (s),
/// relative_compliance at others: r / (1 - r) with r = (1 - k)^4, so that a fully solved constraint leaves over as much
/// of its error as 4 iterations of stiffness k do in the thesis' substep h0 = 1/240 s. Infinite (never solved) at k =
/// 0.
inline double softness(double stiffness) {
    const double left_over = std::pow(1 - stiffness, 4);
    return left_over >= 1 ? HUGE_VAL : left_over / (1 - left_over);
}

/// Parameters of a Model's spring, except its rest length, which muscles change.
template <class R>
struct SpringRule {
    R stiffness = 1;
    double softness = 0;

    SpringRule() = default;
    template <class Spring>
    explicit SpringRule(const Spring& spring)
        : stiffness(static_cast<R>(spring.stiffness)), softness(physics::softness(spring.stiffness)) {}
};

inline namespace NATATOR_SET {

/// Scheme `flex`: Dx_a = k w_a / (w_a + w_b) (l0 - l) n, the stiffness as it is in every iteration. Returns
/// Dx_a / w_a = -Dx_b / w_b for `difference` from b to a.
template <class T>
NATATOR_HD Vec3<T> spring_push(const Vec3<T>& difference, T weights, T rest_length, SpringRule<T> rule) {
    const T length = norm(difference);
    if (!(weights > 0 && length > 0)) return {};
    return rule.stiffness * (rest_length - length) / weights / length * difference;
}

/// Scheme `conserving`: compliance of a constraint relative to its inverse mass; of one that is never solved, infinite.
NATATOR_HD double relative_compliance(double softness, double h) {
    const double ratio = thesis_substep / h;
    return softness * ratio * ratio;
}

/// A spring by XPBD (Macklin, Müller, Chentanez 2016, eq. 18) with split masses, n = springs on a particle:
///   Dlambda = (-C - alpha lambda) / (w_a n_a + w_b n_b + alpha), Dx_a = w_a Dlambda n.
/// `weights` is w_a + w_b, `split` the sum with n. Returns Dx_a / w_a and adds to lambda.
template <class T>
NATATOR_HD Vec3<T> xpbd_spring_push(const Vec3<T>& difference, T weights, T split, T rest_length, T alpha, T& lambda) {
    const T length = norm(difference);
    if (!(weights > 0 && length > 0 && alpha < static_cast<T>(HUGE_VAL))) return {};
    const T change = (rest_length - length - alpha * lambda) / (split + alpha);
    lambda += change;
    return change / length * difference;
}
/// Compliance alpha of a spring in a substep of length h, s.
template <class T>
NATATOR_HD T spring_compliance(SpringRule<T> rule, T weights, T h) {
    return static_cast<T>(relative_compliance(rule.softness * static_cast<double>(weights), static_cast<double>(h)));
}
template <class T>
NATATOR_HD Vec3<T> xpbd_spring_push(const Vec3<T>& difference, T weights, T split, T rest_length, SpringRule<T> rule,
                                    T h, T& lambda) {
    return xpbd_spring_push(difference, weights, split, rest_length, spring_compliance(rule, weights, h), lambda);
}

/// Work of a change of rest length in a substep of length h, against the push lambda / h^2 with which the spring ends
/// it: dW = lambda / h^2 dl0. With the energy 1/2 k (l - l0)^2 of the spring and implicit Euler this is what the energy
/// of masses and springs grows by, and what the step takes off: 1/2 sum m |dv|^2 + 1/2 k (dl - dl0)^2 >= 0, of first
/// order in h.
NATATOR_HD double spring_work(double lambda, double h, double change) {
    return lambda / (h * h) * change;
}

}  // namespace NATATOR_SET
}  // namespace natator::physics
