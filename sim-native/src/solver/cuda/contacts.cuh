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

/// Distance r of two particles and 1/r, which stays finite at r = 0, where the direction is 0 anyway.
template <class Real>
struct Separation {
    Vec3<Real> difference;
    Real r, inverse_r;
};

template <class Real>
__device__ Separation<Real> separation(const Vec3<Real>& x, const Vec3<Real>& other) {
    constexpr Real tiny = Real(1e-30);  // too small to change any other r^2
    const Vec3<Real> d = x - other;
    const Real r2 = d.x * d.x + (d.y * d.y + (d.z * d.z + tiny));
    const Real inverse_r = inverse_root<Real>(r2);
    return {d, r2 * inverse_r, inverse_r};
}

/// Calls visit(slot) for every `step`th contact of slot s, from `first` on.
template <class Real, class Block, class Visit>
__device__ void for_each_contact_of(const ModelView<Real>& model, const Block& block, int s, int first, int step,
                                    const Visit& visit) {
    const bool fluid = s < model.fluid;
    const std::uint16_t* const list = fluid ? block.fluid_contact() + s : block.solid_contact() + (s - model.fluid);
    const std::size_t stride = fluid ? model.fluid : model.solids;
    const int count = block.contact_count()[s];
    for (int k = first; k < count; k += step) visit(static_cast<int>(list[k * stride]));
}

/// Calls visit(slot) for the contacts of slot s.
template <class Real, class Block, class Visit>
__device__ void for_each_contact(const ModelView<Real>& model, const Block& block, int s, const Visit& visit) {
    if (model.plan.contacts) for_each_contact_of(model, block, s, 0, 1, visit);
}

/// Calls visit(slot) for the fluid neighbours of fluid slot s, and for the far slot until a chunk is full.
template <class Real, class Block, class Visit>
__device__ void for_each_neighbour(const ModelView<Real>& model, const Block& block, int s, const Visit& visit) {
    const int chunks = (block.neighbour_count()[s] + 7) / 8;
    const uint4* chunk = block.neighbour() + s;
    if (chunks == 0) return;
    uint4 next = *chunk;
    for (int c = 1; c <= chunks; ++c) {
        const uint4 now = next;
        chunk += model.fluid;
        if (c < chunks) next = *chunk;
        const unsigned words[4] = {now.x, now.y, now.z, now.w};
#pragma unroll
        for (const unsigned word : words) {
            visit(static_cast<int>(word & 0xffff));
            visit(static_cast<int>(word >> 16));
        }
    }
}

/// What the far slot holds: beyond the reach of all others, without weight.
template <class Real>
__device__ Quad<Real> far_away() {
    return {Real(1e9), Real(1e9), Real(1e9), Real(0)};
}

constexpr int contact_lanes = 8;  ///< threads that share the contacts of a slot

/// The sum over the threads that share a slot's contacts, the same in all of them.
template <class Real>
__device__ Real sum_of_lanes(Real value) {
    for (int step = contact_lanes / 2; step > 0; step /= 2) value += __shfl_xor_sync(0xffffffff, value, step);
    return value;
}

/// Calls work(slot, lane) for the slots that have contacts, `contact_lanes` threads each, all lanes of a warp together;
/// slot is -1 for those beyond the last. Units of for_each_unit from 0 on.
template <class Real, class Block>
__device__ int touched_units(const ModelView<Real>& model, const Block& block) {
    return model.plan.contacts ? (block.shared().touched * contact_lanes + 31) / 32 : 0;
}
template <class Block, class Work>
__device__ void work_on_touched(const Block& block, int unit, const Work& work) {
    const int lane = threadIdx.x % 32, k = unit * (32 / contact_lanes) + lane / contact_lanes;
    work(k < block.shared().touched ? static_cast<int>(block.touched()[k]) : -1, lane % contact_lanes);
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
