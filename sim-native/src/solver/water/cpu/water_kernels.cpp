// Compiled once per instruction set, like fluid_kernels.cpp and by the same rules; physics/dfsph.h has the formulas.
#include "water_kernels.h"

#include "physics/dfsph.h"
#include "solver/cpu/particle_groups.h"

namespace natator::cpu::NATATOR_ISA {
namespace {

template <class Real>
inline WendlandKernel<Real> kernel_of(const WaterView<Real>& water) {
    return {water.inverse_radius, water.kernel_scale, water.slope_scale};
}

/// How many groups are a block.
template <class Group>
constexpr int groups = lanes / Group::slots;

template <class Real, class Work>
inline void for_each_block(const WaterView<Real>& water, const Work& work) {
    for (int block = water.first_block; block < water.end_block; ++block) work(block);
}

/// Calls work(k, first slot) for each group k of a block.
template <class Group, class Work>
inline void for_groups_of(int block, const Work& work) {
    for (int k = 0; k < groups<Group>; ++k) work(k, block * lanes + k * Group::slots);
}

/// Calls visit(k, entry) for each entry of a block's rows, row by row for all its groups k: group after group would
/// fetch whole cache lines for the first, and have nothing to fetch while it computes for the others.
template <class Group, class Real, class Visit>
inline void for_each_entry(const WaterView<Real>& water, int block, const Visit& visit) {
    const int end = water.row_begin[block + 1];
    for (int row = water.row_begin[block]; row < end; ++row)
        for (int k = 0; k < groups<Group>; ++k) visit(k, row * lanes + k * Group::slots);
}

template <class Group, class Real>
void pack(WaterView<Real> water) {
    pack_arrays<Group>(water, water.position, water.volume, water.packed);
    const Real* const velocity[3] = {water.velocity[0], water.velocity[1], water.velocity[2]};
    pack_arrays<Group>(water, velocity, water.mobility, water.packed_velocity);
}

// Flattened, as compute_gradients is: g++ would leave the body of the loop a function of its own, which has the view by
// its address.
template <class Group, class Real>
[[gnu::flatten]] void compute_moments(WaterView<Real> water) {
    using Lane = typename Group::Lane;
    const WendlandKernel<Real> kernel = kernel_of(water);
    for_each_group<Group>(water, [&](int first) {
        MomentSums<Lane> sums;
        for_each_neighbour<Group>(water, first, [&](int entry, const Four<Lane>& other, const Vec3<Lane>& difference) {
            Group::put(water.distance + entry, length_of(difference));
            sums.add(difference, kernel, water.at_spacing, other.w);
        });
        const Lane density = sums.density + Group::get(water.volume + first) * water.kernel_scale;
        const Symmetric3<Lane> l = sums.correction(density);
        Group::put(water.density + first, density);
        const Lane parts[6] = {l.xx, l.yy, l.zz, l.xy, l.xz, l.yz};
        for (int k = 0; k < 6; ++k) Group::put(water.correction[k] + first, parts[k]);
        Group::put_quadruples(water.packed_correction + 4 * first, {l.xx, l.yy, l.zz, l.xy});
        Group::put_quadruples(water.packed_shear + 4 * first, {l.xz, l.yz, Group::get(water.solid + first), Lane{}});
        put3<Group>(water.crowding, first, sums.crowding);
    });
}

template <class Group, class Real>
void put_impulse(const WaterView<Real>& water, int first, typename Group::Lane impulse,
                 typename Group::Lane sum_before) {
    Group::put(water.impulse + first, impulse);
    Group::put(water.impulse_sum + first, sum_before + impulse);
}

template <class Group, class Real>
[[gnu::flatten]] void compute_gradients(WaterView<Real> water) {
    using Lane = typename Group::Lane;
    const WendlandKernel<Real> kernel = kernel_of(water);
    for_each_group<Group>(water, [&](int first) {
        Lane parts[6];
        for (int k = 0; k < 6; ++k) parts[k] = Group::get(water.correction[k] + first);
        const Symmetric3<Lane> own{parts[0], parts[1], parts[2], parts[3], parts[4], parts[5]};
        const Lane volume = Group::get(water.volume + first);
        const Vec3<Lane> v = get3<Group>(water.velocity, first);
        ResponseSums<Lane> sums;
        PassingSpeed<Lane> fastest;
        Lane rate{};
        for_each_neighbour<Group>(water, first, [&](int entry, const Four<Lane>& other, const Vec3<Lane>& difference) {
            const std::int32_t* const index = water.neighbour + entry;
            const Four<Lane> l = Group::gather(water.packed_correction, index);
            const Four<Lane> shear = Group::gather(water.packed_shear, index);
            const Four<Lane> moves = Group::gather(water.packed_velocity, index);
            const Lane slope = kernel.slope(Group::get(water.distance + entry));
            const Vec3<Lane> gradient = pair_gradient(difference, slope, volume * other.w,
                                                      own + Symmetric3<Lane>{l.x, l.y, l.z, l.w, shear.x, shear.y});
            const Vec3<Lane> relative = Vec3<Lane>{moves.x, moves.y, moves.z} - v;
            put3<Group>(water.gradient, entry, gradient);
            sums.add(gradient, moves.w);
            fastest.add(relative, other.w * slope);
            rate += dot(relative, gradient);
        });
        const Lane response = sums.response(Group::get(water.mobility + first));
        Group::put(water.max_speed_square + first, fastest.square);
        put3<Group>(water.zeroth, first, sums.gradient);
        Group::put(water.response + first, response);
        put_impulse<Group>(water, first, pressure_impulse(Lane{}, rate, response, Group::get(water.density + first)),
                           Lane{});
    });
}

template <class Group, class Real>
void add_viscosity(WaterView<Real> water, Real strength, Real limit) {
    using Lane = typename Group::Lane;
    for_each_group<Group>(water, [&](int first) {
        const Vec3<Lane> v = get3<Group>(water.velocity, first);
        const Lane inverse_mass = Group::get(water.inverse_mass + first);
        const Lane own = Group::get(water.volume + first) * Group::get(water.mobility + first);
        const Lane solid = Group::get(water.solid + first);
        ViscousSums<Lane> sums;
        for_each_neighbour<Group>(water, first, [&](int entry, const Four<Lane>& other, const Vec3<Lane>& difference) {
            const Four<Lane> moves = Group::gather(water.packed_velocity, water.neighbour + entry);
            const Four<Lane> shear = Group::gather(water.packed_shear, water.neighbour + entry);
            sums.add(difference, Vec3<Lane>{moves.x, moves.y, moves.z} - v, water.softening,
                     viscous_share(own, other.w * moves.w, limit) * wall_viscosity_factor(solid, shear.z),
                     get3<Group>(water.gradient, entry));
        });
        const Lane scale = strength * inverse_mass;
        put3<Group>(water.velocity, first, v + scale * sums.impulse);
    });
}

template <class Group, class Real>
void put_velocity(const WaterView<Real>& water, int first, const Vec3<typename Group::Lane>& v) {
    put3<Group>(water.velocity, first, v);
    Group::put_quadruples(water.packed_velocity + 4 * first, {v.x, v.y, v.z, Group::get(water.mobility + first)});
}

template <class Group, class Real>
void compute_impulse(WaterView<Real> water) {
    using Lane = typename Group::Lane;
    for_each_block(water, [&](int block) {
        Vec3<Lane> v[groups<Group>];
        Lane rate[groups<Group>]{};
        for_groups_of<Group>(block, [&](int k, int first) { v[k] = get3<Group>(water.velocity, first); });
        for_each_entry<Group>(water, block, [&](int k, int entry) {
            const Four<Lane> moves = Group::gather(water.packed_velocity, water.neighbour + entry);
            rate[k] += dot(Vec3<Lane>{moves.x, moves.y, moves.z} - v[k], get3<Group>(water.gradient, entry));
        });
        for_groups_of<Group>(block, [&](int k, int first) {
            const Lane impulse =
                pressure_impulse(Group::get(water.target + first), rate[k], Group::get(water.response + first),
                                 Group::get(water.density + first));
            put_impulse<Group>(water, first, impulse, Group::get(water.impulse_sum + first));
        });
    });
}

template <class Group, class Real>
void apply_impulse(WaterView<Real> water) {
    using Lane = typename Group::Lane;
    for_each_block(water, [&](int block) {
        Lane own[groups<Group>];
        Vec3<Lane> sum[groups<Group>]{};
        for_groups_of<Group>(block, [&](int k, int first) { own[k] = Group::get(water.impulse + first); });
        for_each_entry<Group>(water, block, [&](int k, int entry) {
            const Lane other = Group::gather_one(water.impulse, water.neighbour + entry);
            sum[k] += (own[k] + other) * get3<Group>(water.gradient, entry);
        });
        for_groups_of<Group>(block, [&](int k, int first) {
            const Lane inverse_mass = Group::get(water.inverse_mass + first);
            put_velocity<Group>(water, first, get3<Group>(water.velocity, first) - inverse_mass * sum[k]);
        });
    });
}

template <class Group, class Real>
void apply_zeroth_order_correction(WaterView<Real> water, Real strength) {
    using Lane = typename Group::Lane;
    for_each_group<Group>(water, [&](int first) {
        const Lane kept = uncorrected_impulse(Group::get(water.max_speed_square + first), strength);
        const Lane inverse_mass = Group::get(water.inverse_mass + first);
        const Vec3<Lane> zeroth = get3<Group>(water.zeroth, first);
        const Lane own = own_response(inverse_mass, zeroth, Group::get(water.response + first));
        const Lane all = zeroth_order_correction(Group::get(water.density + first),
                                                 Group::get(water.impulse_sum + first), kept, own);
        const Lane now = inverse_mass > 0 ? all : Lane{},
                   more = now - Group::get(water.zeroth_order_correction + first);
        Group::put(water.zeroth_order_correction + first, now);
        put_velocity<Group>(water, first, get3<Group>(water.velocity, first) + inverse_mass * more * zeroth);
    });
}

template <class Group, class Real>
void lay_out_zeroth_order_correction(WaterView<Real> water) {
    using Lane = typename Group::Lane;
    const WendlandKernel<Real> kernel = kernel_of(water);
    for_each_group<Group>(water, [&](int first) {
        const Lane share =
            zeroth_order_share(Group::get(water.density + first), Group::get(water.volume + first), kernel);
        const Vec3<Lane> all =
            Group::get(water.zeroth_order_correction + first) * share * get3<Group>(water.zeroth, first);
        Group::put_quadruples(water.packed_zeroth_order + 4 * first, {all.x, all.y, all.z, Lane{}});
    });
}

template <class Group, class Real>
void return_zeroth_order_correction(WaterView<Real> water) {
    using Lane = typename Group::Lane;
    const WendlandKernel<Real> kernel = kernel_of(water);
    for_each_block(water, [&](int block) {
        Vec3<Lane> sum[groups<Group>]{};
        for_each_entry<Group>(water, block, [&](int k, int entry) {
            const Four<Lane> part = Group::gather(water.packed_zeroth_order, water.neighbour + entry);
            sum[k] += kernel.value(Group::get(water.distance + entry)) * Vec3<Lane>{part.x, part.y, part.z};
        });
        for_groups_of<Group>(block, [&](int k, int first) {
            const Lane scale = Group::get(water.inverse_mass + first) * Group::get(water.volume + first);
            put_velocity<Group>(water, first, get3<Group>(water.velocity, first) - scale * sum[k]);
        });
    });
}

template <class Group, class Real>
WaterKernels<Real> kernels_by() {
    return {&pack<Group>,
            &compute_moments<Group>,
            &compute_gradients<Group>,
            &add_viscosity<Group>,
            &compute_impulse<Group>,
            &apply_impulse<Group>,
            &apply_zeroth_order_correction<Group>,
            &lay_out_zeroth_order_correction<Group>,
            &return_zeroth_order_correction<Group>};
}

}  // namespace

template <class Real>
WaterKernels<Real> scalar_water_kernels() {
    return kernels_by<Single<Real>, Real>();
}
template <class Real>
WaterKernels<Real> water_kernels() {
    return kernels_by<Vector<Real>, Real>();
}

template WaterKernels<float> scalar_water_kernels();
template WaterKernels<double> scalar_water_kernels();
template WaterKernels<float> water_kernels();
template WaterKernels<double> water_kernels();

}  // namespace natator::cpu::NATATOR_ISA
