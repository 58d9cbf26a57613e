// Shape matching: Müller, Heidelberger, Teschner, Gross: Meshless Deformations Based on Shape Matching (2005). A
// cluster pulls its particles to the goals c + R r_j, r_j = rest position from the centre, c = centre, R = best
// rotation.
#pragma once

#include "constants.h"
#include "rotation_fit.h"
#include "vec3.h"

namespace natator::physics {

inline namespace NATATOR_SET {

template <class T>
NATATOR_HD Vec3<T> turned(const T m[9], const Vec3<T>& v) {
    return {dot(Vec3<T>{m[0], m[1], m[2]}, v), dot(Vec3<T>{m[3], m[4], m[5]}, v),
            m[6] * v.x + (m[7] * v.y + m[8] * v.z)};
}

/// Scheme `flex`, without masses: the products are rounded to T.
template <class T>
NATATOR_HD void add_arm(Covariance& covariance, const Vec3<T>& arm, const Vec3<T>& rest) {
    const T a[3] = {arm.x, arm.y, arm.z}, r[3] = {rest.x, rest.y, rest.z};
    for (int e = 0; e < 9; ++e) covariance.entry[e] += static_cast<double>(a[e / 3] * r[e % 3]);
}
/// Scheme `conserving`.
NATATOR_HD void add_arm(Covariance& covariance, double mass, const Vec3<double>& arm, const Vec3<double>& rest) {
    const double a[3] = {arm.x, arm.y, arm.z}, r[3] = {rest.x, rest.y, rest.z};
    for (int e = 0; e < 9; ++e) covariance.entry[e] += mass * a[e / 3] * r[e % 3];
}

/// Scheme `flex`: a component of the stored centre takes the new mean only where the two differ by more than the dead
/// band.
template <class T>
NATATOR_HD Vec3<T> with_dead_band(const Vec3<T>& centre, const Vec3<T>& mean) {
    const auto moved = [](T from, T to) {
        const T by = to - from;
        return (by < 0 ? -by : by) > T(centre_dead_band) ? to : from;
    };
    return {moved(centre.x, mean.x), moved(centre.y, mean.y), moved(centre.z, mean.z)};
}

/// The vector from a particle to its goal: c + R r_j - x_j.
template <class T>
NATATOR_HD Vec3<T> way_to_goal(const Vec3<T>& centre, const T matrix[9], const Vec3<T>& rest, const Vec3<T>& x) {
    return centre + turned(matrix, rest) - x;
}

/// Scheme `flex`: Dx_j = k (c + R r_j - x_j).
template <class T>
NATATOR_HD Vec3<T> goal_correction(T stiffness, const Vec3<T>& centre, const T matrix[9], const Vec3<T>& rest,
                                   const Vec3<T>& x) {
    return stiffness * way_to_goal(centre, matrix, rest, x);
}

/// Scheme `conserving`: compliance relative to the mass by XPBD, with the displacement d_j so far, to which it adds:
///   Dx_j = ((g_j - x_j) - alpha d_j) / (1 + alpha), g_j = c + R r_j in double.
template <class T>
NATATOR_HD Vec3<T> compliant_goal_change(const Vec3<double>& centre, const double matrix[9], const Vec3<T>& rest,
                                         const Vec3<T>& x, T alpha, Vec3<T>& displacement) {
    const Vec3<double> goal = centre + turned(matrix, cast<double>(rest));
    const Vec3<T> away = cast<T>(goal - cast<double>(x));
    const Vec3<T> change = (away - alpha * displacement) / (1 + alpha);
    displacement += change;
    return change;
}

}  // namespace NATATOR_SET
}  // namespace natator::physics
