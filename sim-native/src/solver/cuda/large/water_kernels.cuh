#pragma once

// The water of scheme conserving: a kernel per sum over neighbours, which pair_lanes threads share. See
// cpu/conserving/water.h.
#include "body_momentum.cuh"
#include "solids.cuh"

namespace natator::cuda {

inline constexpr unsigned slot_mask = (1u << most_slot_bits) - 1;

template <class Real>
__device__ Vec3<Real> turned(const Reflection<Real>& mirror, const Vec3<Real>& v) {
    return {dot(mirror.turn[0], v), dot(mirror.turn[1], v), dot(mirror.turn[2], v)};
}
/// H L H^T.
template <class Real>
__device__ physics::Symmetric3<Real> turned(const Reflection<Real>& mirror, const physics::Symmetric3<Real>& l) {
    const Vec3<Real> x = l * mirror.turn[0], y = l * mirror.turn[1], z = l * mirror.turn[2];
    return {dot(mirror.turn[0], x), dot(mirror.turn[1], y), dot(mirror.turn[2], z),
            dot(mirror.turn[0], y), dot(mirror.turn[0], z), dot(mirror.turn[1], z)};
}
template <class Real>
__device__ Vec3<Real> ghost_of(const WaterModel<Real>& water, const Vec3<Real>& x, unsigned planes) {
    return planes == 0 ? x : turned(water.reflection[planes], x) + water.reflection[planes].shift;
}

/// What a particle keeps from planes. Water does not touch them otherwise: its ghosts hold it.
template <class Real>
__device__ Real wall_distance(const ModelView<Real>& model, bool fluid) {
    return fluid ? Real(physics::least_wall_distance) * model.water.spacing : model.collision_distance;
}

/// Calls visit(planes, position) for a particle at x and for its ghosts.
template <class Real, class Visit>
__device__ void for_each_copy(const ModelView<Real>& model, const Vec3<Real>& x, const Visit& visit) {
    visit(0u, x);
    unsigned near = 0;
    for (int k = 0; k < model.planes; ++k) {
        const Real distance = distance_to(model.plane[k].surface, x);
        if (distance >= 0 && distance < model.water.radius) near |= 1u << k;
    }
    if (near == 0) return;
    // Each set of planes from the one without its last.
    for (unsigned planes = 1; planes < 1u << model.planes; ++planes) {
        const bool first_is_near = near & planes & ~(planes - 1);
        if (!first_is_near || __popc(planes) > 3) continue;
        bool before_all = true;
        unsigned so_far = 0;
        for (int k = 0; k < model.planes && before_all; ++k) {
            if (!(planes >> k & 1)) continue;
            const Real distance = distance_to(model.plane[k].surface, ghost_of(model.water, x, so_far));
            before_all = distance >= 0 && distance < model.water.radius;
            so_far |= 1u << k;
        }
        if (before_all) visit(planes, ghost_of(model.water, x, planes));
    }
}

/// Puts what is behind planes before them, and counts particles and ghosts by cell.
template <class Real>
__device__ void begin_water(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    if (s == 0) slots.shared().high = 0;
    const WaterArrays<Real>& water = slots.water;
    const Quad<Real> before = slots.at.state_velocity[s];
    const int number = number_in(before.w);
    const bool fluid = number < model.fluid;
    Quad<Real> x = slots.at.state_position[s];
    if (x.w > 0) {
        x = quad(put_before_planes(model, xyz(x), wall_distance(model, fluid)), x.w);
        slots.at.state_position[s] = x;
    }
    water.position[s] = quad(xyz(x), model.water.volume[number]);
    water.velocity[s] = quad(xyz(before), x.w);
    if (!fluid) water.slot_of_solid[number - model.fluid] = s;
    for_each_copy(model, xyz(x), [&](unsigned, const Vec3<Real>& at) {
        atomicAdd(water.table + model.water.grid.cell(at), 1);
    });
}

/// Puts the particles and ghosts of each cell together, in no order. Turns the cells' begins in the table into their ends.
template <class Real>
__device__ void scatter_water(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const auto number = static_cast<std::uint64_t>(number_in(slots.at.state_velocity[s].w));
    for_each_copy(model, xyz(water.position[s]), [&](unsigned planes, const Vec3<Real>& at) {
        water.keys[atomicAdd(water.table + model.water.grid.cell(at), 1)] =
            static_cast<std::uint64_t>(planes) << 58 | number << 32 | static_cast<unsigned>(s);
    });
}

/// Lays out what searches read, in each cell by set of planes and then by particle: the order depends on positions alone.
template <class Real>
__device__ void order_water(const ModelView<Real>& model, const Slots<Real>& slots) {
    const WaterArrays<Real>& water = slots.water;
    const int copies = water.table[model.water.grid.cells - 1];
    for (int k = own_index(); k < copies; k += static_cast<int>(gridDim.x * blockDim.x)) {
        const std::uint64_t key = water.keys[k];
        const auto planes = static_cast<unsigned>(key >> 58), slot = static_cast<unsigned>(key);
        const Vec3<Real> x = ghost_of(model.water, xyz(water.position[slot]), planes);
        const int cell = model.water.grid.cell(x);
        const int begin = cell > 0 ? water.table[cell - 1] : 0, end = water.table[cell];
        int rank = begin;
        for (int other = begin; other < end; ++other) rank += water.keys[other] < key;
        water.candidate[rank] = quad(x, as_number<Real>(static_cast<int>(planes << most_slot_bits | slot)));
    }
}

/// Of the threads that share a slot.
__device__ inline int own_lane() {
    return static_cast<int>(threadIdx.x) % pair_lanes;
}
template <class Real>
__device__ Vec3<Real> sum_of_lanes(const Vec3<Real>& v) {
    return {sum_of_lanes(v.x), sum_of_lanes(v.y), sum_of_lanes(v.z)};
}
template <class Real>
__device__ Real largest_of_lanes(Real value) {
    for (int step = pair_lanes / 2; step > 0; step /= 2) {
        const Real other = __shfl_xor_sync(0xffffffff, value, step);
        value = other > value ? other : value;
    }
    return value;
}

/// Lists what is within the kernel's support of each particle, solids and ghosts too, in the order of the cells.
template <class Real>
__device__ void find_water_neighbours_large(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const int lane = own_lane();
    const WaterArrays<Real>& water = slots.water;
    const Vec3<Real> x = xyz(water.position[s]);
    const Real distance_squared = model.water.radius * model.water.radius;
    const int first_lane = static_cast<int>(threadIdx.x) % 32 - lane;
    const unsigned lanes = ((1u << pair_lanes) - 1) << first_lane;
    unsigned* const list = water.neighbour + static_cast<std::size_t>(s) * slots.water_neighbours;
    int n = 0;
    model.water.grid.for_each_run(x, [&](int first, int last) {
        const int begin = first > 0 ? water.table[first - 1] : 0, end = water.table[last];
        for (int k = begin; k < end; k += pair_lanes) {
            Quad<Real> other{};
            bool near = k + lane < end;
            if (near) {
                other = water.candidate[k + lane];
                const Real r2 = physics::squared_length(x - xyz(other));
                near = r2 < distance_squared && r2 > 0;
            }
            const unsigned found = __ballot_sync(lanes, near) >> first_lane & ((1u << pair_lanes) - 1);
            const int at = n + __popc(found & ((1u << lane) - 1));
            if (near && at < slots.water_neighbours) list[at] = static_cast<unsigned>(number_in(other.w));
            n += __popc(found);
        }
    });
    if (lane != 0) return;
    if (n > slots.water_neighbours) atomicMax(&slots.shared().most_neighbours, n);
    water.count[s] = min(n, slots.water_neighbours);
    water.count_of[number_in(slots.at.state_velocity[s].w)] = n;
}

/// Calls visit(its place, slot, planes) for this thread's share of the neighbours of slot s.
template <class Real, class Visit>
__device__ void for_each_water_neighbour(const Slots<Real>& slots, int s, const Visit& visit) {
    const WaterArrays<Real>& water = slots.water;
    const std::size_t first = static_cast<std::size_t>(s) * slots.water_neighbours;
    const int count = water.count[s];
    for (int k = own_lane(); k < count; k += pair_lanes) {
        const unsigned entry = water.neighbour[first + k];
        visit(first + k, static_cast<int>(entry & slot_mask), entry >> most_slot_bits);
    }
}

/// Calls visit(G_ij, slot, planes) for the same, once gradients are known.
template <class Real, class Visit>
__device__ void for_each_water_pair(const Slots<Real>& slots, int s, const Visit& visit) {
    const Quad<Real>* const first = slots.water.pair + static_cast<std::size_t>(s) * slots.water_neighbours;
    const int count = slots.water.count[s];
#pragma unroll 4
    for (int k = own_lane(); k < count; k += pair_lanes) {
        const Quad<Real> pair = first[k];
        const auto entry = static_cast<unsigned>(number_in(pair.w));
        visit(xyz(pair), static_cast<int>(entry & slot_mask), entry >> most_slot_bits);
    }
}

/// A neighbour's velocity, or another vector by slot; of a ghost as its mirrors show it. w as it is there.
template <class Real>
__device__ Quad<Real> seen(const ModelView<Real>& model, const Quad<Real>* vector, int slot, unsigned planes) {
    const Quad<Real> v = vector[slot];
    return planes == 0 ? v : quad(turned(model.water.reflection[planes], xyz(v)), v.w);
}

/// Density, correction, crowding.
template <class Real>
__device__ void water_moments(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Quad<Real> here = water.position[s], moves = water.velocity[s];
    physics::MomentSums<Real> sums;
    for_each_water_neighbour(slots, s, [&](std::size_t, int other, unsigned planes) {
        const Quad<Real> there = water.position[other];
        const Vec3<Real> difference = xyz(here) - ghost_of(model.water, xyz(there), planes);
        const Quad<Real> v = seen(model, water.velocity, other, planes);
        sums.add(difference, model.water.kernel, model.water.at_spacing, there.w, xyz(v) - xyz(moves));
    });
    sums.density = sum_of_lanes(sums.density);
    physics::Symmetric3<Real>& m = sums.moments;
    m = {sum_of_lanes(m.xx), sum_of_lanes(m.yy), sum_of_lanes(m.zz),
         sum_of_lanes(m.xy), sum_of_lanes(m.xz), sum_of_lanes(m.yz)};
    sums.crowding = sum_of_lanes(sums.crowding);
    sums.fastest_square = largest_of_lanes(sums.fastest_square);
    if (own_lane() != 0) return;
    const Real density = sums.density + here.w * model.water.kernel.scale;
    const physics::Symmetric3<Real> l = sums.correction(density);
    water.density[s] = density;
    water.density_of[number_in(slots.at.state_velocity[s].w)] = density;
    water.correction[s] = {l.xx, l.yy, l.zz, l.xy};
    const Real solid = number_in(slots.at.state_velocity[s].w) < model.fluid ? Real(0) : Real(1);
    water.shear[s] = {l.xz, l.yz, physics::mobility(moves.w, here.w, model.water.density), solid};
    water.crowding[s] = quad(sums.crowding, sums.fastest_square);
    if (density - 1 > Real(physics::overlap_tolerance)) slots.shared().high = 1;
}

template <class Real>
__device__ physics::Symmetric3<Real> correction_of(const Quad<Real>& correction, const Quad<Real>& shear) {
    return {correction.x, correction.y, correction.z, correction.w, shear.x, shear.y};
}

/// G_ij and the response.
template <class Real>
__device__ void water_gradients(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Quad<Real> here = water.position[s], own_shear = water.shear[s];
    const physics::Symmetric3<Real> own = correction_of(water.correction[s], own_shear);
    physics::ResponseSums<Real> sums;
    for_each_water_neighbour(slots, s, [&](std::size_t place, int other, unsigned planes) {
        const Quad<Real> there = water.position[other], shear = water.shear[other];
        physics::Symmetric3<Real> its = correction_of(water.correction[other], shear);
        if (planes != 0) its = turned(model.water.reflection[planes], its);
        const Vec3<Real> difference = xyz(here) - ghost_of(model.water, xyz(there), planes);
        const Vec3<Real> gradient =
            physics::pair_gradient(difference, model.water.kernel, here.w * there.w, own + its);
        water.pair[place] = quad(gradient, as_number<Real>(static_cast<int>(water.neighbour[place])));
        sums.add(gradient, shear.z);
    });
    sums.gradient = sum_of_lanes(sums.gradient);
    sums.square = sum_of_lanes(sums.square);
    if (own_lane() != 0) return;
    water.response[s] = sums.response(own_shear.z);
    water.zeroth[s] = quad(sums.gradient, Real(0));
    water.impulse_sum[s] = 0;
}

/// What the passes of a substep are for, see cpu/conserving/water.cpp.
enum class Pass {
    first_parting,  ///< of overlaps, on velocities that begin at 0 and are forgotten; only where there are any
    parting,
    divergence,
    density,  ///< moves the solids, too
};
constexpr bool parts(Pass pass) {
    return pass == Pass::first_parting || pass == Pass::parting;
}

/// The impulses of a Jacobi pass.
template <Pass pass, class Real>
__device__ void water_impulses(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    if (parts(pass) && !slots.shared().high) return;
    const WaterArrays<Real>& water = slots.water;
    Real rate = 0;
    if (pass != Pass::first_parting) {
        const Quad<Real>* const velocity = parts(pass) ? water.parting : water.velocity;
        const Vec3<Real> v = xyz(velocity[s]);
        for_each_water_pair(slots, s, [&](const Vec3<Real>& gradient, int other, unsigned planes) {
            rate += dot(xyz(seen(model, velocity, other, planes)) - v, gradient);
        });
        rate = sum_of_lanes(rate);
    }
    if (own_lane() != 0) return;
    const Real volume = water.position[s].w, density = water.density[s];
    const Real most = physics::velocity_limit(slots.h, model.water.fastest_expansion);
    Real target = 0;
    if (parts(pass)) target = physics::parting_target(volume, density, most, slots.h);
    if (pass == Pass::density) target = physics::density_target(volume, density, most, slots.h);
    const Real impulse = physics::pressure_impulse(target, rate, water.response[s], density);
    water.impulse[s] = impulse;
    if (!parts(pass)) water.impulse_sum[s] += impulse;
}

/// Impulse that the relief of slot s has grown by, see physics::relief.
template <class Real>
__device__ Vec3<Real> relieve(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Quad<Real> zeroth = water.zeroth[s];
    const Real strength = physics::kept_strength(slots.h, model.water.density);
    const Real now = physics::relief(water.density[s], water.impulse_sum[s],
                                     physics::kept_impulse(water.crowding[s].w, strength));
    water.zeroth[s].w = now;
    return (now - zeroth.w) * xyz(zeroth);
}

/// v_i -= w_i sum (impulse_i + impulse_j) G_ij, and relief.
template <Pass pass, class Real>
__device__ void push_water_apart(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    if (parts(pass) && !slots.shared().high) return;
    const WaterArrays<Real>& water = slots.water;
    const Real own = water.impulse[s];
    Vec3<Real> sum{0, 0, 0};
    for_each_water_pair(slots, s, [&](const Vec3<Real>& gradient, int other, unsigned) {
        sum += (own + water.impulse[other]) * gradient;
    });
    sum = sum_of_lanes(sum);
    if (own_lane() != 0) return;
    const int number = number_in(slots.at.state_velocity[s].w);
    const Quad<Real> v = water.velocity[s];
    if constexpr (parts(pass)) {
        const Real w = number < model.fluid ? v.w : Real(0);  // to push a body's particles would bend it
        const Vec3<Real> before = pass == Pass::parting ? xyz(water.parting[s]) : Vec3<Real>{0, 0, 0};
        water.parting[s] = quad(before - w * sum, w);
        return;
    }
    Vec3<Real> push = -v.w * sum;
    if (v.w > 0) push += v.w * relieve(model, slots, s);
    water.velocity[s] = quad(xyz(v) + push, v.w);
    if (pass == Pass::density && number >= model.fluid && v.w > 0)
        move(slots, slots.slot_of_solid()[number - model.fluid], slots.h * push);
}

/// Viscosity; the velocities that neighbours see stay as they were.
template <class Real>
__device__ void water_viscosity(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Quad<Real> here = water.position[s], moves = water.velocity[s];
    const Real strength = 10 * slots.h * model.water.dynamic_viscosity;
    const Real most = physics::viscous_limit(model.water.spacing, strength);
    const Real solid = water.shear[s].w;
    physics::ViscousSums<Real> sums;
    for_each_water_pair(slots, s, [&](const Vec3<Real>& gradient, int other, unsigned planes) {
        const Quad<Real> there = water.position[other];
        const Vec3<Real> difference = xyz(here) - ghost_of(model.water, xyz(there), planes);
        const Quad<Real> u = seen(model, water.velocity, other, planes);
        const Real share = physics::viscous_share(here.w * moves.w, there.w * u.w, most);
        const Real grip = physics::viscous_grip(solid, water.shear[other].w);
        sums.add(difference, xyz(u) - xyz(moves), model.water.softening, share * grip, gradient);
    });
    const Vec3<Real> v = xyz(moves) + (strength * moves.w) * sum_of_lanes(sums.impulse);
    if (own_lane() == 0) water.pushed[s] = quad(v, moves.w);
}

/// What slot s moves with by the stages so far.
template <class Real>
__device__ Quad<Real> pushed_by_viscosity(const ModelView<Real>& model, const WaterArrays<Real>& water, int s) {
    return model.plan.viscosity ? water.pushed[s] : water.velocity[s];
}
template <class Real>
__device__ Quad<Real> pushed_by_forces(const ModelView<Real>& model, const WaterArrays<Real>& water, int s,
                                       bool fluid) {
    return model.plan.fluid_forces && fluid ? water.pushed[s] : pushed_by_viscosity(model, water, s);
}

/// Gravity; then x* = x + h v* + shift, v* without the density solve; counts the particles of each cell, the fluid's first.
template <class Real>
__device__ void predict_in_water(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Quad<Real> x = slots.at.state_position[s], crowding = water.crowding[s];
    const Real number = slots.at.state_velocity[s].w;
    const bool fluid = number_in(number) < model.fluid;
    const Quad<Real> pushed = pushed_by_forces(model, water, s, fluid);
    Vec3<Real> with_gravity = xyz(pushed);
    if (pushed.w > 0) with_gravity += slots.h * (fluid ? model.fluid_gravity : model.gravity);
    const Vec3<Real> v = model.plan.clamp_speed ? clamped(with_gravity, model.max_speed) : with_gravity;
    water.velocity[s] = quad(fluid ? with_gravity : v, pushed.w);
    Vec3<Real> there = xyz(x) + slots.h * v;
    if (fluid)
        there += physics::shift_of(water.density[s], xyz(crowding), crowding.w, model.water.radius,
                                   model.water.spacing, slots.h);
    if (slots.shared().high)
        there += clamped(slots.h * xyz(water.parting[s]), Real(physics::longest_parting) * model.water.spacing);
    const int cell = model.grid.cell(there) + (fluid ? 0 : model.grid.cells);
    slots.at.unsorted_position[s] = quad(there, x.w);
    slots.at.unsorted_velocity[s] = quad(v, number);
    slots.at.cell[s] = cell;
    atomicAdd(slots.at.table + cell, 1);
}

/// Lays E out for the neighbours.
template <class Real>
__device__ void lay_out_relief(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Quad<Real> zeroth = water.zeroth[s];
    const Real share = physics::relief_share(water.density[s], water.position[s].w, model.water.kernel);
    water.relief[s] = quad(zeroth.w * share * xyz(zeroth), Real(0));
}

/// Once all passes are done: gives it back.
template <class Real>
__device__ void return_relief(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Quad<Real> here = water.position[s];
    Vec3<Real> sum{};
    for_each_water_neighbour(slots, s, [&](std::size_t, int other, unsigned planes) {
        const Vec3<Real> difference = xyz(here) - ghost_of(model.water, xyz(water.position[other]), planes);
        sum += model.water.kernel.value(physics::length_of(difference)) * xyz(seen(model, water.relief, other, planes));
    });
    sum = sum_of_lanes(sum);
    if (own_lane() != 0) return;
    const Quad<Real> v = water.velocity[s];
    const Vec3<Real> push = (-v.w * here.w) * sum;
    water.velocity[s] = quad(xyz(v) + push, v.w);
    const int number = number_in(slots.at.state_velocity[s].w);
    if (number >= model.fluid && v.w > 0) move(slots, slots.slot_of_solid()[number - model.fluid], slots.h * push);
}

/// Once all passes are done: holds up what lies at walls. Ghosts are behind planes, so only what is nearer to a plane than
/// the kernel's support has any for neighbours.
template <class Real>
__device__ void hold_at_walls(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Vec3<Real> here = xyz(water.position[s]);
    bool near = false;
    for (int k = 0; k < model.planes; ++k) near |= distance_to(model.plane[k].surface, here) < model.water.radius;
    Vec3<Real> sum{};
    if (near)
        for_each_water_pair(slots, s, [&](const Vec3<Real>& gradient, int owner, unsigned planes) {
            if (planes == 0 || owner >= model.fluid) return;
            const Quad<Real> x = water.position[owner];
            sum += physics::weight_to_ghost(slots.at.state_position[owner].w, x.w, slots.h, model.fluid_gravity,
                                            ghost_of(model.water, xyz(x), planes) - xyz(x), water.impulse_sum[owner]) *
                   gradient;
        });
    sum = sum_of_lanes(sum);
    if (!near || own_lane() != 0) return;
    const Quad<Real> v = water.velocity[s];
    water.velocity[s] = quad(xyz(v) - v.w * sum, v.w);
}

/// The fluid goes where its velocities take it.
template <class Real>
__device__ void move_water(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const Quad<Real> base = slots.base()[s];
    if (!(base.w > 0)) return;
    Vec3<Real> v = xyz(slots.water.velocity[slots.water.slot_before[s]]);
    if (model.plan.clamp_speed) v = clamped(v, model.max_speed);
    const Vec3<Real> displacement = slots.h * (v - xyz(slots.predicted_velocity()[s]));
    slots.displacement()[s] = quad(displacement, Real(0));
    slots.position()[s] =
        quad(put_before_planes(model, xyz(base) + displacement, wall_distance(model, true)), base.w);
}

}  // namespace natator::cuda
