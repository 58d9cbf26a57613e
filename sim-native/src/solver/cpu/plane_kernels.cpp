// Compiled once per instruction set, like fluid_kernels.cpp and by the same rules, but without fused products: every
// set gives the same bits. physics/plane.h has the formulas.
#include "plane_kernels.h"

#include "particle_groups.h"
#include "physics/plane.h"

namespace natator::cpu::NATATOR_ISA {
namespace {

/// Calls work(first slot, 1 where chosen and else 0) for all slots of a block.
template <class Group, class Work>
inline void for_each_chosen(int block, unsigned chosen, const Work& work) {
    for (int slot = block * lanes; slot < (block + 1) * lanes; slot += Group::slots, chosen >>= Group::slots)
        work(slot, Group::one_where(chosen));
}

template <class Real>
inline PlaneSurface<Real> surface_of(const PlaneView<Real>& plane) {
    return {{plane.normal[0], plane.normal[1], plane.normal[2]}, plane.offset};
}

template <class Real>
unsigned near_plane(const NearPlanes<Real>& slots, int block, const PlaneView<Real>& plane) {
    using Group = Vector<Real>;
    const PlaneSurface<Real> surface = surface_of(plane);
    alignas(64) Real distance[lanes];
    for (int lane = 0; lane < lanes; lane += Group::slots)
        Group::put(distance + lane, distance_to(surface, get3<Group>(slots.position, block * lanes + lane)));
    unsigned near[lanes], all = 0;
    for (int lane = 0; lane < lanes; ++lane) near[lane] = distance[lane] <= plane.distance ? 1u << lane : 0;
    for (int lane = 0; lane < lanes; ++lane) all |= near[lane];
    return all;
}

template <class Group, bool displaced, class Real>
void resolve_penetration_by(const NearPlanes<Real>& slots, int block, unsigned chosen, const PlaneView<Real>& plane) {
    using Lane = typename Group::Lane;
    Real* const* const moving = displaced ? slots.displacement : slots.position;
    const PlaneSurface<Real> surface = surface_of(plane);
    const Friction<Real> rule{plane.friction, plane.static_friction, plane.dynamic_friction};
    for_each_chosen<Group>(block, chosen, [&](int slot, Lane one) {
        const Vec3<Lane> from = get3<Group>(moving, slot), start = get3<Group>(slots.start, slot);
        Vec3<Lane> base;
        if constexpr (displaced) base = get3<Group>(slots.base, slot);
        const auto placed = [&](const Vec3<Lane>& at) { return displaced ? base + at : at; };
        const Lane depth = one * (plane.distance - distance_to(surface, placed(from)));
        const Vec3<Lane> to = resolve_plane_penetration(from, depth, surface.normal, rule,
                                                        [&](const Vec3<Lane>& at) { return placed(at) - start; });
        const Vec3<Lane> now = select(depth > 0, to, from);
        put3<Group>(moving, slot, now);
        if constexpr (displaced) put3<Group>(slots.position, slot, base + now);
    });
}

template <class Group, class Real>
void resolve_penetration(const NearPlanes<Real>& slots, int block, unsigned chosen, const PlaneView<Real>& plane) {
    if (slots.base[0])
        resolve_penetration_by<Group, true>(slots, block, chosen, plane);
    else
        resolve_penetration_by<Group, false>(slots, block, chosen, plane);
}

template <class Group, class Real>
PlaneKernels<Real> kernels_by() {
    return {&near_plane<Real>, &resolve_penetration<Group, Real>};
}

}  // namespace

template <class Real>
PlaneKernels<Real> scalar_plane_kernels() {
    return kernels_by<Single<Real>, Real>();
}
template <class Real>
PlaneKernels<Real> plane_kernels() {
    return kernels_by<Vector<Real>, Real>();
}

template PlaneKernels<float> scalar_plane_kernels();
template PlaneKernels<double> scalar_plane_kernels();
template PlaneKernels<float> plane_kernels();
template PlaneKernels<double> plane_kernels();

}  // namespace natator::cpu::NATATOR_ISA
