#pragma once

#include "block.cuh"

namespace natator::cuda {

template <class Real>
__device__ float inverse_root(float v) {
    return rsqrtf(v);
}
template <class Real>
__device__ double inverse_root(double v) {
    return rsqrt(v);
}

/// Keeps 1/r finite at r = 0, where the direction is 0 anyway; too small to change any other r^2.
template <class Real>
__device__ constexpr Real tiny() {
    return Real(1e-30);
}

/// Calls visit(slot) for the contacts of slot s.
template <class Real, class Visit>
__device__ void for_each_contact(const ModelView<Real>& model, const Block<Real>& block, int s, const Visit& visit) {
    if (!model.plan.contacts) return;
    const bool fluid = s < model.fluid;
    const std::uint16_t* const list = fluid ? block.fluid_contact + s : block.solid_contact + (s - model.fluid);
    const std::size_t stride = fluid ? model.fluid : model.solids;
    const int count = block.contact_count[s];
    for (int k = 0; k < count; ++k) visit(static_cast<int>(list[k * stride]));
}

/// What Coulomb friction takes off the displacement of a contact. As Substep::friction.
template <class Real>
__device__ Vec3<Real> friction(const ModelView<Real>& model, const Vec3<Real>& moved, const Vec3<Real>& normal,
                               Real depth, Real coefficient) {
    const Vec3<Real> tangential = moved - dot(moved, normal) * normal;
    const Real m = norm(tangential);
    if (!(m > 0)) return {0, 0, 0};
    const Real held = m < model.static_friction * depth ? m : min(coefficient * depth, m);
    return (held / m) * tangential;
}

}  // namespace natator::cuda
