// What happens to each particle's velocity by itself, in a substep of length h.
#pragma once

#include "constants.h"
#include "vec3.h"

namespace natator::physics {

/// Rule that turns a displacement into a velocity in scheme `flex`. The booleans say which parts apply.
template <class R>
struct VelocityRule {
    bool viscosity;
    R viscosity_step;  ///< h viscosity
    bool damping;
    R damping_step;  ///< h damping
    bool clamp_acceleration;
    R max_change;  ///< h max_acceleration
    bool clamp_speed;
    R max_speed;
};

inline namespace NATATOR_SET {

/// v* = v + h g, |v*| <= max_speed: the velocity after external forces. No gravity on particles of infinite mass.
template <class T>
NATATOR_HD Vec3<T> predicted_velocity(Vec3<T> v, T inverse_mass, const Vec3<T>& gravity, T h, bool clamp_speed,
                                      T max_speed) {
    if (inverse_mass > 0) v = v + h * gravity;
    return clamp_speed ? clamped(v, max_speed) : v;
}

/// v = v* + clamp(u + Du - v*, h max_acceleration), |v| <= max_speed, Du = h (viscosity * smoothing - damping * u), as
/// NVIDIA Flex 1.2.0 was measured; u = (x - x_start) / h, smoothing = the viscosity's sum over neighbours.
template <class T, class R>
NATATOR_HD Vec3<T> flex_velocity(const Vec3<T>& u, const Vec3<T>& smoothing, const Vec3<T>& predicted,
                                 const VelocityRule<R>& rule) {
    Vec3<T> v = u;
    if (rule.viscosity) v = v + rule.viscosity_step * smoothing;
    if (rule.damping) v = v - rule.damping_step * u;
    if (rule.clamp_acceleration) v = predicted + clamped(v - predicted, rule.max_change);
    if (rule.clamp_speed) v = clamped(v, rule.max_speed);
    return v;
}

/// Scheme `flex`, local relaxation: x += min(1, (1 + omega) / n) * sum of n corrections; global: x += omega * sum.
template <class T, class R>
NATATOR_HD T relaxation(T constraints, R omega, bool local) {
    if (!local) return T{} + omega;
    const T share = (1 + omega) / (constraints > 1 ? constraints : one<T>());
    return share < 1 ? share : one<T>();
}

}  // namespace NATATOR_SET
}  // namespace natator::physics
