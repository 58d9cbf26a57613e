// Compiled once per instruction set: NATATOR_ISA names the namespace, the compiler's flags choose the instructions.
// A block of 16 particles is worked on group by group, each lane with its own sums; physics/flex_density.h has the
// formulas. Include nothing here that has inline functions with linkage, but for the headers of physics.
#include "fluid_kernels.h"

#include "particle_groups.h"
#include "physics/flex_density.h"

namespace natator::cpu::NATATOR_ISA {
namespace {

template <class Group, class Real>
void pack(const FluidView<Real>& fluid) {
    pack_arrays<Group>(fluid, fluid.position, fluid.compression, fluid.packed);
}

template <class Group, class Real>
void pack_velocity(const FluidView<Real>& fluid) {
    pack_arrays<Group>(fluid, fluid.velocity, fluid.compression, fluid.packed_velocity);
}

/// keep_distances: also keeps each pair's distance for solve_density_constraint.
template <class Group, bool keep_distances, class Real>
void compute_density_of(const FluidView<Real>& fluid) {
    using Lane = typename Group::Lane;
    Real* const distance = fluid.distance;
    const Real inverse_radius = fluid.inverse_radius;
    for_each_group<Group>(fluid, [&](int first) {
        FlexDensity<Lane> sums;
        for_each_neighbour<Group>(fluid, first, [&](int entry, const Four<Lane>&, const Vec3<Lane>& difference) {
            const Lane r = length_of(difference);
            if constexpr (keep_distances) Group::put(distance + entry, r);
            sums.add(1 - r * inverse_radius);
        });
        const Lane density = sums.density(Group::get(fluid.solid_density + first), fluid.density_scale);
        Group::put(fluid.density + first, density);
        Group::put(fluid.compression + first, positive_part(density - 1));
    });
}

template <class Group, class Real>
void compute_density(const FluidView<Real>& fluid) {
    fluid.distance ? compute_density_of<Group, true>(fluid) : compute_density_of<Group, false>(fluid);
}

/// At the positions, and with the distances if they were kept, that compute_density has left.
template <class Group, bool kept_distances, class Real>
void solve_density_constraint_of(const FluidView<Real>& fluid) {
    using Lane = typename Group::Lane;
    const Real* const distance = fluid.distance;
    const Real inverse_radius = fluid.inverse_radius;
    for_each_group<Group>(fluid, [&](int first) {
        const Lane c = Group::get(fluid.compression + first);
        FlexPush<Lane> push;
        for_each_neighbour<Group>(fluid, first, [&](int entry, const Four<Lane>& other, const Vec3<Lane>& difference) {
            Distance<Lane> apart;
            if constexpr (kept_distances)
                apart = distance_by(difference, 1 / Group::get(distance + entry));
            else
                apart = distance_of(difference);
            push.add(difference, apart, 1 - apart.r * inverse_radius, c + other.w);
        });
        put3<Group>(fluid.correction, first, push.correction(Group::get(fluid.inverse_mass + first), fluid.radius));
        Group::put(fluid.constraint_count + first, push.constraints);
    });
}

template <class Group, class Real>
void solve_density_constraint(const FluidView<Real>& fluid) {
    fluid.distance ? solve_density_constraint_of<Group, true>(fluid) : solve_density_constraint_of<Group, false>(fluid);
}

template <class Group, class Real>
void smooth_velocities(const FluidView<Real>& fluid) {
    using Lane = typename Group::Lane;
    const Real inverse_radius = fluid.inverse_radius;
    for_each_group<Group>(fluid, [&](int first) {
        const Vec3<Lane> u = get3<Group>(fluid.velocity, first);
        FlexSmoothing<Lane> sums;
        for_each_neighbour<Group>(fluid, first, [&](int entry, const Four<Lane>&, const Vec3<Lane>& difference) {
            const Four<Lane> moves = Group::gather(fluid.packed_velocity, fluid.neighbour + entry);
            sums.add(1 - length_of(difference) * inverse_radius, Vec3<Lane>{moves.x, moves.y, moves.z} - u);
        });
        put3<Group>(fluid.velocity_change, first, fluid.density_scale * sums.sum);
    });
}

template <class Group, class Real>
FluidKernels<Real> kernels_by() {
    return {&pack<Group>, &pack_velocity<Group>, &compute_density<Group>, &solve_density_constraint<Group>,
            &smooth_velocities<Group>};
}

}  // namespace

template <class Real>
FluidKernels<Real> scalar_fluid_kernels() {
    return kernels_by<Single<Real>, Real>();
}
template <class Real>
FluidKernels<Real> fluid_kernels() {
    return kernels_by<Vector<Real>, Real>();
}

template FluidKernels<float> scalar_fluid_kernels();
template FluidKernels<double> scalar_fluid_kernels();
template FluidKernels<float> fluid_kernels();
template FluidKernels<double> fluid_kernels();

}  // namespace natator::cpu::NATATOR_ISA
