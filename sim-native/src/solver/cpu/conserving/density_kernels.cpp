// Compiled once per instruction set, like fluid_kernels.cpp and by the same rules; physics/pbf_density.h has the
// formulas.
#include "density_kernels.h"

#include "../particle_groups.h"
#include "physics/pbf_density.h"

namespace natator::cpu::NATATOR_ISA {
namespace {

template <class Group, class Real>
void pack(const DensityView<Real>& fluid) {
    pack_arrays<Group>(fluid, fluid.position, fluid.inverse_mass, fluid.packed);
}
template <class Group, class Real>
void pack_lambda(const DensityView<Real>& fluid) {
    pack_arrays<Group>(fluid, fluid.position, fluid.lambda, fluid.packed);
}
template <class Group, class Real>
void pack_velocity(const DensityView<Real>& fluid) {
    pack_arrays<Group>(fluid, fluid.velocity, fluid.inverse_mass, fluid.packed_velocity);
}

/// Distance of a pair, whose inverse is kept for solve_density_constraint if there is room.
template <class Group, class Real>
inline Distance<typename Group::Lane> kept_distance(const DensityView<Real>& fluid, int entry,
                                                    const Vec3<typename Group::Lane>& difference) {
    const Distance<typename Group::Lane> distance = distance_of(difference);
    if (fluid.inverse_distance) Group::put(fluid.inverse_distance + entry, distance.inverse_r);
    return distance;
}

template <class Group, class Real>
inline typename Group::Lane response_of(const DensityView<Real>& fluid, int first,
                                        const GradientSums<typename Group::Lane>& gradients) {
    return gradients.response(Group::get(fluid.inverse_mass + first), fluid.gradient_scale,
                              get3<Group>(fluid.solid_gradient, first),
                              Group::get(fluid.solid_gradient_square + first));
}

template <class Group, class Real>
void compute_lambda(const DensityView<Real>& fluid) {
    using Lane = typename Group::Lane;
    const FluidKernel<Real> kernel{fluid.kernel_scale, fluid.gradient_scale, fluid.rest_sum};
    for_each_group<Group>(fluid, [&](int first) {
        LambdaSums<Lane> sums;
        for_each_neighbour<Group>(fluid, first, [&](int entry, const Four<Lane>& other, const Vec3<Lane>& difference) {
            const Distance<Lane> distance = kept_distance<Group>(fluid, entry, difference);
            sums.add(difference, distance, 1 - distance.r * fluid.inverse_radius, other.w);
        });
        const Lane above = sums.above_rest(kernel, Group::get(fluid.solid_density + first));
        const Lane response = response_of<Group>(fluid, first, sums.gradients);
        const Lane lambda = -positive_part(above) * response;
        Group::put(fluid.density + first, 1 + above);
        Group::put(fluid.response + first, response);
        Group::put(fluid.lambda + first, lambda);
        Group::put(fluid.lambda_sum + first, Group::get(fluid.lambda_sum + first) + lambda);
    });
}

template <class Group, class Real>
void solve_density_constraint(const DensityView<Real>& fluid) {
    using Lane = typename Group::Lane;
    for_each_group<Group>(fluid, [&](int first) {
        const Lane lambda = Group::get(fluid.lambda + first);
        PressurePush<Lane> push;
        for_each_neighbour<Group>(fluid, first, [&](int entry, const Four<Lane>& other, const Vec3<Lane>& difference) {
            const Distance<Lane> distance = fluid.inverse_distance
                                                ? distance_by(difference, Group::get(fluid.inverse_distance + entry))
                                                : distance_of(difference);
            push.add(difference, distance, 1 - distance.r * fluid.inverse_radius, lambda + other.w);
        });
        put3<Group>(fluid.correction, first,
                    Group::get(fluid.inverse_mass + first) * fluid.gradient_scale * push.sum);
    });
}

template <class Group, class Real>
void compute_rate_lambda(const DensityView<Real>& fluid, Real inverse_h) {
    using Lane = typename Group::Lane;
    for_each_group<Group>(fluid, [&](int first) {
        const Vec3<Lane> u = get3<Group>(fluid.velocity, first);
        RateSums<Lane> sums;
        for_each_neighbour<Group>(fluid, first, [&](int entry, const Four<Lane>& other, const Vec3<Lane>& difference) {
            const Four<Lane> moves = Group::gather(fluid.packed_velocity, fluid.neighbour + entry);
            const Distance<Lane> distance = kept_distance<Group>(fluid, entry, difference);
            sums.add(difference, distance, 1 - distance.r * fluid.inverse_radius, other.w,
                     Vec3<Lane>{moves.x, moves.y, moves.z} - u);
        });
        const Lane response = response_of<Group>(fluid, first, sums.gradients);
        const Lane most = -Group::get(fluid.lambda_sum + first) * inverse_h;
        Group::put(fluid.lambda + first, sums.lambda(fluid.gradient_scale, response, most));
    });
}

template <class Group, class Real>
void smooth_velocities(const DensityView<Real>& fluid) {
    using Lane = typename Group::Lane;
    for_each_group<Group>(fluid, [&](int first) {
        const Vec3<Lane> u = get3<Group>(fluid.velocity, first);
        const Lane inverse_mass = Group::get(fluid.inverse_mass + first);
        PairwiseSmoothing<Lane> sums;
        for_each_neighbour<Group>(fluid, first, [&](int entry, const Four<Lane>& other, const Vec3<Lane>& difference) {
            const Four<Lane> moves = Group::gather(fluid.packed_velocity, fluid.neighbour + entry);
            sums.add(difference, fluid.inverse_radius, inverse_mass, other.w,
                     Vec3<Lane>{moves.x, moves.y, moves.z} - u);
        });
        put3<Group>(fluid.velocity_change, first, fluid.kernel_scale * sums.sum);
    });
}

template <class Group, class Real>
DensityKernels<Real> kernels_by() {
    return {&pack<Group>,
            &pack_lambda<Group>,
            &pack_velocity<Group>,
            &compute_lambda<Group>,
            &solve_density_constraint<Group>,
            &compute_rate_lambda<Group>,
            &smooth_velocities<Group>};
}

}  // namespace

template <class Real>
DensityKernels<Real> scalar_density_kernels() {
    return kernels_by<Single<Real>, Real>();
}
template <class Real>
DensityKernels<Real> density_kernels() {
    return kernels_by<Vector<Real>, Real>();
}

template DensityKernels<float> scalar_density_kernels();
template DensityKernels<double> scalar_density_kernels();
template DensityKernels<float> density_kernels();
template DensityKernels<double> density_kernels();

}  // namespace natator::cpu::NATATOR_ISA
