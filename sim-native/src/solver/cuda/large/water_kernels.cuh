#pragma once

// The water of scheme conserving: a kernel per sum over neighbours, which pair_lanes threads share. See
// cpu/conserving/water.h.
#include <cuda/std/tuple>

#include "body_momentum.cuh"
#include "pair_gradient.cuh"
#include "solids.cuh"

namespace natator::cuda {

inline constexpr unsigned slot_mask = (1u << most_slot_bits) - 1;

template <class Real>
__device__ Vec3<Real> turned(const GhostMap<Real>& map, const Vec3<Real>& v) {
    return {dot(xyz(map.row[0]), v), dot(xyz(map.row[1]), v), dot(xyz(map.row[2]), v)};
}
/// H L H^T.
template <class Real>
__device__ physics::Symmetric3<Real> turned(const GhostMap<Real>& map, const physics::Symmetric3<Real>& l) {
    const Vec3<Real> a = xyz(map.row[0]), b = xyz(map.row[1]), c = xyz(map.row[2]);
    const Vec3<Real> x = l * a, y = l * b, z = l * c;
    return {dot(a, x), dot(b, y), dot(c, z), dot(a, y), dot(a, z), dot(b, z)};
}
template <class Real>
__device__ Vec3<Real> ghost_of(const WaterModel<Real>& water, const Vec3<Real>& x, unsigned borders) {
    if (borders == 0) return x;
    const GhostMap<Real> map = water.ghost_map[borders];
    return turned(map, x) + Vec3<Real>{map.row[0].w, map.row[1].w, map.row[2].w};
}

/// What a particle keeps from planes. Water does not touch them otherwise: its ghosts hold it.
template <class Real>
__device__ Real wall_distance(const ModelView<Real>& model, bool fluid) {
    return fluid ? Real(physics::least_wall_distance) * model.water.spacing : model.collision_distance;
}

/// Calls visit(borders, position) for the ghosts of what is at x, itself a ghost of `borders` or none, in up to `most` more
/// borders from number `first` on: in those that it is before, nearer than the kernel's support.
template <int most, class Real, class Visit>
__device__ void for_each_ghost(const ModelView<Real>& model, const Vec3<Real>& x, const Vec3<Real>& of, unsigned borders,
                               int first, const Visit& visit) {
    for (int k = first; k < model.water.borders; ++k) {
        const Real distance = distance_to(model.water.border[k].surface, x);
        if (!(distance >= 0 && distance < model.water.radius)) continue;
        const unsigned with_this = borders | 1u << k;
        const Vec3<Real> ghost = ghost_of(model.water, of, with_this);
        visit(with_this, ghost);
        if constexpr (most > 1) for_each_ghost<most - 1>(model, ghost, of, with_this, k + 1, visit);
    }
}

/// The same for a particle at x, which has no borders, and for its ghosts.
template <class Real, class Visit>
__device__ void for_each_copy(const ModelView<Real>& model, const Vec3<Real>& x, const Visit& visit) {
    visit(0u, x);
    for_each_ghost<most_borders_at_once>(model, x, x, 0, 0, visit);
}

/// Where the water has what is at x: in a periodic tank within its ends.
template <class Real>
__device__ Vec3<Real> place_in_tank(const WaterModel<Real>& water, Vec3<Real> x) {
    for (int k = 0; k < water.seams; ++k) x = to_tank(water.seam[k], x);
    return x;
}
template <class Real>
__device__ Vec3<Real> wrapped_water(const WaterModel<Real>& water, Vec3<Real> x) {
    for (int k = 0; k < water.seams; ++k) x = wrapped(water.seam[k], x);
    return x;
}

/// Wraps water that has left a periodic tank, puts what is behind planes before them, and counts particles and ghosts by cell.
template <class Real>
__device__ void begin_water(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    if (s == 0) slots.shared().high = 0;
    const WaterArrays<Real>& water = slots.water;
    const Quad<Real> before = slots.at.state_velocity[s];
    const int number = number_in(before.w);
    const bool fluid = number < model.fluid;
    Quad<Real> x = slots.at.state_position[s];
    if (x.w > 0) {
        const Vec3<Real> there = fluid ? wrapped_water(model.water, xyz(x)) : xyz(x);
        x = quad(put_before_planes(model, there, wall_distance(model, fluid)), x.w);
        slots.at.state_position[s] = x;
    }
    const Vec3<Real> in_tank = place_in_tank(model.water, xyz(x));
    water.position[s] = quad(in_tank, model.water.volume[number]);
    water.velocity[s] = quad(xyz(before), x.w);
    if (!fluid) water.slot_of_solid[number - model.fluid] = s;
    for_each_copy(model, in_tank, [&](unsigned, const Vec3<Real>& at) {
        atomicAdd(water.table + model.water.grid.cell(at), 1);
    });
}

/// Puts the particles and ghosts of each cell together, in no order. Turns the cells' begins in the table into their ends.
template <class Real>
__device__ void scatter_water(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const auto number = static_cast<std::uint64_t>(number_in(slots.at.state_velocity[s].w));
    for_each_copy(model, xyz(water.position[s]), [&](unsigned borders, const Vec3<Real>& at) {
        water.keys[atomicAdd(water.table + model.water.grid.cell(at), 1)] =
            static_cast<std::uint64_t>(borders) << 58 | number << 32 | static_cast<unsigned>(s);
    });
}

/// Lays out what searches read, in each cell by set of borders and then by particle: the order depends on positions alone.
template <class Real>
__device__ void order_water(const ModelView<Real>& model, const Slots<Real>& slots) {
    const WaterArrays<Real>& water = slots.water;
    const int copies = water.table[model.water.grid.cells - 1];
    for (int k = own_index(); k < copies; k += static_cast<int>(gridDim.x * blockDim.x)) {
        const std::uint64_t key = water.keys[k];
        const auto borders = static_cast<unsigned>(key >> 58), slot = static_cast<unsigned>(key);
        const Vec3<Real> x = ghost_of(model.water, xyz(water.position[slot]), borders);
        const int cell = model.water.grid.cell(x);
        const int begin = cell > 0 ? water.table[cell - 1] : 0, end = water.table[cell];
        int rank = begin;
        for (int other = begin; other < end; ++other) rank += water.keys[other] < key;
        water.candidate[rank] = quad(x, as_number<Real>(static_cast<int>(borders << most_slot_bits | slot)));
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

/// Lists what is within the kernel's support of each particle, solids and ghosts too, in the order of the cells. The
/// lanes of a warp stay together, those that have no candidate left as well.
template <class Real>
__device__ void find_water_neighbours_large(const ModelView<Real>& model, const Slots<Real>& slots) {
    const int slot = own_index() / pair_lanes, lane = own_lane(), first_lane = static_cast<int>(threadIdx.x) % 32 - lane;
    if (slot - first_lane / pair_lanes >= model.particles) return;  // the whole warp
    const int s = min(slot, model.particles - 1);
    const WaterArrays<Real>& water = slots.water;
    const GridView<Real>& grid = model.water.grid;
    const Vec3<Real> x = xyz(water.position[s]);
    const Real distance_squared = model.water.radius * model.water.radius;
    const int room = slots.water_neighbours;
    unsigned* const list = water.neighbour + slots.water_place(s, 0);
    const unsigned lanes_before = (1u << lane) - 1;
    const int cx = grid.coordinate(x.x, 0), cy = grid.coordinate(x.y, 1), cz = grid.coordinate(x.z, 2);
    const int low = max(cx - grid.reach_x, 0), high = min(cx + grid.reach_x, grid.count[0] - 1);
    int n = 0;
    for (int around = 0; around < 9; ++around) {
        const int iy = cy + around % 3 - 1, iz = cz + around / 3 - 1;
        int from = 0, to = 0;
        if (slot == s && iy >= 0 && iy < grid.count[1] && iz >= 0 && iz < grid.count[2]) {
            const int row = (iz * grid.count[1] + iy) * grid.count[0];
            from = row + low > 0 ? water.table[row + low - 1] : 0;
            to = water.table[row + high];
        }
        int most = to - from;
        for (int step = pair_lanes; step < 32; step *= 2) most = max(most, __shfl_xor_sync(0xffffffff, most, step));
        for (int k = from + lane; most > 0; most -= pair_lanes, k += pair_lanes) {
            Quad<Real> other{};
            bool near = k < to;
            if (near) {
                other = water.candidate[k];
                const Real r2 = physics::squared_length(x - xyz(other));
                near = r2 < distance_squared && r2 > 0;
            }
            const unsigned found = __ballot_sync(0xffffffff, near) >> first_lane & ((1u << pair_lanes) - 1);
            const int at = n + __popc(found & lanes_before);
            if (near && at < room) list[at / pair_lanes * 32 + at % pair_lanes] = static_cast<unsigned>(number_in(other.w));
            n += __popc(found);
        }
    }
    if (lane != 0 || slot != s) return;
    if (n > room) atomicMax(&slots.shared().most_neighbours, n);
    water.count[s] = min(n, room);
    water.count_of[number_in(slots.at.state_velocity[s].w)] = n;
}

/// How many of the neighbours of slot s are this thread's share.
template <class Real>
__device__ int own_neighbours(const Slots<Real>& slots, int s) {
    return (slots.water.count[s] - own_lane() + pair_lanes - 1) / pair_lanes;
}

/// What is in each of the arrays at the slot of an entry.
template <class... Value>
__device__ ::cuda::std::tuple<Value...> values_at(unsigned entry, const Value*... array) {
    return ::cuda::std::tuple<Value...>(array[entry & slot_mask]...);
}

/// Calls visit(slot, borders, values...) for an entry.
template <class Visit, class... Value>
__device__ void visit_entry(unsigned entry, const ::cuda::std::tuple<Value...>& there, const Visit& visit) {
    const int slot = static_cast<int>(entry & slot_mask);
    const unsigned borders = entry >> most_slot_bits;
    ::cuda::std::apply([&](const Value&... value) { visit(slot, borders, value...); }, there);
}

/// Calls visit(its place, slot, borders, values...) for this thread's share of the neighbours of slot s, with what is at the
/// neighbour's slot in each of the arrays. Those of `batch` neighbours are under way at a time.
template <int batch, class Real, class Visit, class... Value>
__device__ void for_each_water_neighbour(const Slots<Real>& slots, int s, const Visit& visit, const Value*... array) {
    const std::size_t first = slots.water_place(s, own_lane());
    const int count = own_neighbours(slots, s);
    for (int begin = 0; begin < count; begin += batch) {
        unsigned entry[batch];
        ::cuda::std::tuple<Value...> there[batch];
#pragma unroll
        for (int k = 0; k < batch; ++k)
            entry[k] = read_once(slots.water.neighbour + first + 32 * min(begin + k, count - 1));
#pragma unroll
        for (int k = 0; k < batch; ++k) there[k] = values_at(entry[k], array...);
#pragma unroll
        for (int k = 0; k < batch; ++k) {
            if (begin + k >= count) break;
            visit_entry(entry[k], there[k], [&](int slot, unsigned borders, const Value&... value) {
                visit(first + 32 * (begin + k), slot, borders, value...);
            });
        }
    }
}

/// The same with G_ij instead of the place, once gradients are known.
template <int batch = 4, class Real, class Visit, class... Value>
__device__ void for_each_water_pair(const Slots<Real>& slots, int s, const Visit& visit, const Value*... array) {
    const std::size_t first = slots.water_place(s, own_lane());
    const int count = own_neighbours(slots, s);
    for (int begin = 0; begin < count; begin += batch) {
        unsigned entry[batch];
        PairGradient<Real> gradient[batch];
        ::cuda::std::tuple<Value...> there[batch];
#pragma unroll
        for (int k = 0; k < batch; ++k) {
            const std::size_t place = first + 32 * min(begin + k, count - 1);
            entry[k] = read_once(slots.water.neighbour + place);
            gradient[k] = read_once(slots.water.pair + place);
        }
#pragma unroll
        for (int k = 0; k < batch; ++k) there[k] = values_at(entry[k], array...);
#pragma unroll
        for (int k = 0; k < batch; ++k) {
            if (begin + k >= count) break;
            visit_entry(entry[k], there[k], [&](int slot, unsigned borders, const Value&... value) {
                visit(gradient[k].value(), slot, borders, value...);
            });
        }
    }
}

/// A vector of a neighbour; of a ghost as it is beyond the borders. w as it is.
template <class Real>
__device__ Quad<Real> seen(const ModelView<Real>& model, const Quad<Real>& v, unsigned borders) {
    return borders == 0 ? v : quad(turned(model.water.ghost_map[borders], xyz(v)), v.w);
}

/// Density, correction, crowding.
template <class Real>
__device__ void water_moments(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Quad<Real> here = water.position[s], moves = water.velocity[s];
    physics::MomentSums<Real> sums;
    const auto add = [&](std::size_t, int, unsigned borders, const Quad<Real>& there, const Quad<Real>& velocity) {
        const Vec3<Real> difference = xyz(here) - ghost_of(model.water, xyz(there), borders);
        const Quad<Real> v = seen(model, velocity, borders);
        sums.add(difference, model.water.kernel, model.water.at_spacing, there.w, xyz(v) - xyz(moves));
    };
    for_each_water_neighbour<2>(slots, s, add, water.position, water.velocity);
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

static_assert(physics::divergence_passes == 1, "its impulses are those of water_gradients");

/// G_ij, the response, and the impulses of the divergence pass, as the sum of the substep so far.
template <class Real>
__device__ void water_gradients(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Quad<Real> here = water.position[s], own_shear = water.shear[s];
    const physics::Symmetric3<Real> own = correction_of(water.correction[s], own_shear);
    const Vec3<Real> v = xyz(water.velocity[s]);
    physics::ResponseSums<Real> sums;
    Real rate = 0;
    const auto add = [&](std::size_t place, int, unsigned borders, const Quad<Real>& there, const Quad<Real>& correction,
                         const Quad<Real>& shear, const Quad<Real>& velocity) {
        physics::Symmetric3<Real> its = correction_of(correction, shear);
        if (borders != 0) its = turned(model.water.ghost_map[borders], its);
        const Vec3<Real> difference = xyz(here) - ghost_of(model.water, xyz(there), borders);
        const Vec3<Real> gradient =
            physics::pair_gradient(difference, model.water.kernel, here.w * there.w, own + its);
        const PairGradient<Real> kept(gradient);
        water.pair[place] = kept;
        sums.add(kept.value(), shear.z);
        rate += dot(xyz(seen(model, velocity, borders)) - v, kept.value());
    };
    for_each_water_neighbour<1>(slots, s, add, water.position, water.correction, water.shear, water.velocity);
    sums.gradient = sum_of_lanes(sums.gradient);
    sums.square = sum_of_lanes(sums.square);
    rate = sum_of_lanes(rate);
    if (own_lane() != 0) return;
    const Real response = sums.response(own_shear.z);
    water.response[s] = response;
    water.zeroth[s] = quad(sums.gradient, Real(0));
    water.impulse_sum[s] = physics::pressure_impulse(Real(0), rate, response, water.density[s]);
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
        const auto add = [&](const Vec3<Real>& gradient, int, unsigned borders, const Quad<Real>& u) {
            rate += dot(xyz(seen(model, u, borders)) - v, gradient);
        };
        for_each_water_pair<2>(slots, s, add, velocity);
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
    const Real* const impulse = pass == Pass::divergence ? water.impulse_sum : water.impulse;
    const Real own = impulse[s];
    Vec3<Real> sum{0, 0, 0};
    const auto add = [&](const Vec3<Real>& gradient, int, unsigned, Real its) { sum += (own + its) * gradient; };
    for_each_water_pair(slots, s, add, impulse);
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
    const auto add = [&](const Vec3<Real>& gradient, int, unsigned borders, const Quad<Real>& there,
                         const Quad<Real>& velocity, const Quad<Real>& shear) {
        const Vec3<Real> difference = xyz(here) - ghost_of(model.water, xyz(there), borders);
        const Quad<Real> u = seen(model, velocity, borders);
        const Real share = physics::viscous_share(here.w * moves.w, there.w * u.w, most);
        const Real grip = physics::viscous_grip(solid, shear.w);
        sums.add(difference, xyz(u) - xyz(moves), model.water.softening, share * grip, gradient);
    };
    for_each_water_pair<2>(slots, s, add, water.position, water.velocity, water.shear);
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
    water.relief[s] = quad(zeroth.w * share * xyz(zeroth), water.impulse_sum[s]);
}

/// Once all passes are done: gives it back, and where `walls` hold up water, holds up what lies at them. Ghosts are behind
/// borders, so only what is nearer to a plane than the kernel's support has any for neighbours.
template <class Real>
__device__ void end_water_passes(const ModelView<Real>& model, const Slots<Real>& slots, int s, bool walls) {
    const WaterArrays<Real>& water = slots.water;
    const Quad<Real> here = water.position[s];
    Vec3<Real> given_back{}, weight{};
    const auto add = [&](std::size_t place, int other, unsigned borders, const Quad<Real>& x, const Quad<Real>& relief) {
        const Vec3<Real> there = ghost_of(model.water, xyz(x), borders);
        given_back += model.water.kernel.value(physics::length_of(xyz(here) - there)) * xyz(seen(model, relief, borders));
        if (!walls || borders == 0 || other >= model.fluid) return;
        weight += physics::weight_to_ghost(slots.at.state_position[other].w, x.w, slots.h, model.water.weight_on_walls,
                                           there - xyz(x), relief.w) *
                  water.pair[place].value();
    };
    for_each_water_neighbour<1>(slots, s, add, water.position, water.relief);
    given_back = sum_of_lanes(given_back);
    weight = sum_of_lanes(weight);
    if (own_lane() != 0) return;
    const Quad<Real> v = water.velocity[s];
    const Vec3<Real> push = (-v.w * here.w) * given_back;
    water.velocity[s] = quad(xyz(v) + push - v.w * weight, v.w);
    const int number = number_in(slots.at.state_velocity[s].w);
    if (number >= model.fluid && v.w > 0) move(slots, slots.slot_of_solid()[number - model.fluid], slots.h * push);
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
