#pragma once

// The water of scheme conserving: a kernel per sum over neighbours, which several threads share. See
// water/cpu/water.h.
#include "pass_lists.cuh"
#include "solver/solids/cuda/body_momentum.cuh"
#include "water_cells.cuh"

namespace natator::cuda {

/// G_ij, the response, how fast neighbours pass, and the impulses of the divergence pass, as the sum of the substep so
/// far.
template <Pairs pairs, class Real>
__device__ void water_gradients(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const GradientsOf<Real> own(model, water, s);
    const Vec3<Real> v = xyz(water.velocity[s]);
    physics::ResponseSums<Real> sums;
    physics::PassingSpeed<Real> fastest;
    Real rate = 0;
    const auto add = [&](std::size_t place, int, unsigned boundaries, const Vec4<Real>& there,
                         const Vec4<Real>& correction, const Vec4<Real>& shear, const Vec4<Real>& velocity) {
        auto [gradient, slope] = own.with(boundaries, there, correction, shear);
        const Vec3<Real> relative = xyz(reflected(model, velocity, boundaries)) - v;
        const PairGradient<Real> kept = PairGradient<Real>::keep(gradient);
        if constexpr (pairs == Pairs::listed) water.pair[place] = kept;
        sums.add(gradient, shear.z);
        fastest.add(relative, there.w * slope);
        rate += along(gradient, relative);
    };
    for_each_water_neighbour<pairs, 1>(model, slots, s, model.particles, add, water.position, water.correction,
                                       water.shear, water.velocity);
    sums.gradient = sum_of_lanes(sums.gradient);
    sums.square = sum_of_lanes(sums.square);
    rate = sum_of_lanes(rate);
    fastest.square = max_of_lanes(fastest.square);
    if (own_lane() != 0) return;
    const Real response = sums.response(water.shear[s].z);
    water.max_speed_square[s] = fastest.square;
    water.response[s] = response;
    water.zeroth[s] = quad(sums.gradient, Real(0));
    water.impulse_sum[s] = physics::pressure_impulse(Real(0), rate, response, water.density[s]);
}

/// The passes of a substep, see water/cpu/water.cpp.
enum class Pass {
    first_separation,  ///< of overlaps, on velocities that begin at 0 and are forgotten; only where there are any
    separation,
    divergence,
    density,  ///< moves the solids, too
};
constexpr bool separates(Pass pass) {
    return pass == Pass::first_separation || pass == Pass::separation;
}

/// The impulses of a Jacobi pass. `lanes` threads share a slot.
template <Pass pass, Pairs pairs, int lanes, class Real>
__device__ void water_impulses(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Real density = water.density[s];
    ListSums<lanes, Real> rates;
    if constexpr (pass != Pass::first_separation) {
        const bool wet = density > Real(physics::wet_density);  // else it has no impulse
        const Vec4<Real>* const velocity = separates(pass) ? water.separation : water.velocity;
        const Vec3<Real> v = xyz(velocity[s]);
        const auto add = [&](int list, const Vec3<Real>& gradient, unsigned boundaries, const Vec4<Real>& u) {
            rates[list] += dot_unfused(xyz(reflected(model, u, boundaries)) - v, gradient);
        };
        for_each_pass_pair<pairs, lanes, rows_of_velocities<lanes>, velocities_at_once>(model, slots, s, wet, add,
                                                                                        velocity);
    }
    const Real rate = rates.total();
    if (!rates.first_lane()) return;
    const Real volume = water.volume[s];
    const Real limit = physics::velocity_limit(slots.h, model.water.max_expansion_rate);
    Real target = 0;
    if (separates(pass)) target = physics::separation_target(volume, density, limit, slots.h);
    if (pass == Pass::density) target = physics::density_target(volume, density, limit, slots.h);
    const Real impulse = physics::pressure_impulse(target, rate, water.response[s], density);
    water.impulse[s] = impulse;
    if (!separates(pass)) water.impulse_sum[s] += impulse;
}

/// Impulse that the zeroth_order_correction of slot s has grown by, see physics::zeroth_order_correction.
template <class Real>
__device__ Vec3<Real> apply_zeroth_order_correction(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Vec4<Real> zeroth = water.zeroth[s];
    const Real strength = physics::uncorrected_strength(slots.h, model.water.density);
    const Real now = physics::zeroth_order_correction(
        water.density[s], water.impulse_sum[s], physics::uncorrected_impulse(water.max_speed_square[s], strength),
        physics::own_response(water.velocity[s].w, xyz(zeroth), water.response[s]));
    water.zeroth[s].w = now;
    return (now - zeroth.w) * xyz(zeroth);
}

/// Moves the solid in slot s of the water's.
template <class Real>
__device__ void move_solid(const ModelView<Real>& model, const Slots<Real>& slots, int s, const Vec3<Real>& by) {
    move(slots, slots.slot_of_solid()[number_in(slots.arrays.state_velocity[s].w) - model.fluid], by);
}

/// v_i -= w_i sum (impulse_i + impulse_j) G_ij, and zeroth_order_correction. `lanes` threads share a slot.
template <Pass pass, Pairs pairs, int lanes, class Real>
__device__ void push_water_apart(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Real* const impulse = pass == Pass::divergence ? water.impulse_sum : water.impulse;
    const Real own = impulse[s];
    ListSums<lanes, Vec3<Real>> sums;
    const auto add = [&](int list, const Vec3<Real>& gradient, unsigned, Real its) {
        sums[list] += (own + its) * gradient;
    };
    for_each_pass_pair<pairs, lanes, rows_of_impulses<lanes>, impulses_at_once>(model, slots, s, true, add, impulse);
    const Vec3<Real> sum = sums.total();
    if (!sums.first_lane()) return;
    const bool fluid = s < model.fluid;
    const Vec4<Real> v = water.velocity[s];
    if constexpr (separates(pass)) {
        const Real w = fluid ? v.w : Real(0);  // to push a body's particles would bend it
        const Vec3<Real> before = pass == Pass::separation ? xyz(water.separation[s]) : Vec3<Real>{0, 0, 0};
        water.separation[s] = quad(before - w * sum, w);
        return;
    }
    Vec3<Real> push = -v.w * sum;
    if (v.w > 0) push += v.w * apply_zeroth_order_correction(model, slots, s);
    water.velocity[s] = quad(xyz(v) + push, v.w);
    if (pass == Pass::density && !fluid && v.w > 0) move_solid(model, slots, s, slots.h * push);
}

/// Viscous impulses on one slot by its neighbours, see physics::ViscousSums: what water_viscosity and
/// add_viscous_forces share.
template <class Real>
class ViscousPairs {
public:
    __device__ ViscousPairs(const ModelView<Real>& model, const WaterArrays<Real>& water, int s, Real strength)
        : model_(model),
          here_(water.position[s]),
          moves_(water.velocity[s]),
          shear_(water.shear[s]),
          most_(physics::viscous_limit(model.water.spacing, strength)) {}

    /// `there`, `velocity` and `shear`: the other's, as they are laid out.
    __device__ void add(const Vec3<Real>& gradient, unsigned boundaries, const Vec4<Real>& there,
                        const Vec4<Real>& velocity, const Vec4<Real>& shear) {
        const Vec3<Real> difference = xyz(here_) - ghost_position(model_.water, xyz(there), boundaries);
        const Vec3<Real> moves = xyz(reflected(model_, velocity, boundaries)) - xyz(moves_);
        const Real share = physics::viscous_share(here_.w * shear_.z, there.w * shear.z, most_) *
                           physics::wall_viscosity_factor(shear_.w, shear.w);
        sums_.add(difference, moves, model_.water.softening, share, gradient);
    }

    __device__ Vec3<Real> impulse() const { return sum_of_lanes(sums_.impulse); }

private:
    const ModelView<Real>& model_;
    const Vec4<Real> here_, moves_, shear_;
    const Real most_;
    physics::ViscousSums<Real> sums_;
};

template <class Real>
__device__ Real viscous_strength(const ModelView<Real>& model, const Slots<Real>& slots) {
    return physics::viscous_strength(slots.h, model.water.dynamic_viscosity);
}

/// Viscosity; the velocities that neighbours see stay as they were.
template <Pairs pairs, class Real>
__device__ void water_viscosity(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Real strength = viscous_strength(model, slots);
    ViscousPairs<Real> sums(model, water, s, strength);
    const auto add = [&](const Vec3<Real>& gradient, int, unsigned boundaries, const Vec4<Real>& there,
                         const Vec4<Real>& velocity,
                         const Vec4<Real>& shear) { sums.add(gradient, boundaries, there, velocity, shear); };
    for_each_water_pair<pairs, 2>(model, slots, s, model.particles, add, water.position, water.velocity, water.shear);
    const Vec4<Real> moves = water.velocity[s];
    const Vec3<Real> v = xyz(moves) + (strength * moves.w) * sums.impulse();
    if (own_lane() == 0) water.pushed[s] = quad(v, moves.w);
}

/// The velocity of slot s after the stages so far.
template <class Real>
__device__ Vec4<Real> pushed_by_viscosity(const ModelView<Real>& model, const WaterArrays<Real>& water, int s) {
    return model.plan.viscosity ? water.pushed[s] : water.velocity[s];
}
template <class Real>
__device__ Vec4<Real> pushed_by_forces(const ModelView<Real>& model, const WaterArrays<Real>& water, int s,
                                       bool fluid) {
    return model.plan.fluid_forces && fluid ? water.pushed[s] : pushed_by_viscosity(model, water, s);
}

/// Gravity; then x* = x + h v* + shift, v* without the density solve; counts the particles of each cell, the fluid's
/// first.
template <class Real>
__device__ void predict_in_water(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Vec4<Real> x = slots.arrays.state_position[s];
    const Real number = slots.arrays.state_velocity[s].w;
    const bool fluid = number_in(number) < model.fluid;
    const Vec4<Real> pushed = pushed_by_forces(model, water, s, fluid);
    Vec3<Real> with_gravity = xyz(pushed);
    if (pushed.w > 0) {
        Vec3<Real> gravity = fluid ? model.fluid_gravity : model.gravity;
        if (const auto& carried = model.water.carried; carried.any()) {
            const Vec4<Real> here = water.position[s];
            gravity = gravity - carried.acceleration(xyz(here), fluid, model.water.density, here.w, pushed.w);
        }
        with_gravity += slots.h * gravity;
    }
    const Vec3<Real> v = model.plan.clamp_speed ? clamped(with_gravity, model.max_speed) : with_gravity;
    water.velocity[s] = quad(fluid ? with_gravity : v, pushed.w);
    Vec3<Real> there = xyz(x) + slots.h * v;
    if (fluid)
        there += physics::shift_of(water.density[s], xyz(water.crowding[s]), water.max_speed_square[s],
                                   model.water.radius, model.water.spacing, slots.h);
    if (slots.shared().high)
        there += clamped(slots.h * xyz(water.separation[s]), Real(physics::max_separation) * model.water.spacing);
    const int cell = model.grid.cell(there) + (fluid ? 0 : model.grid.cells);
    slots.arrays.unsorted_position[s] = quad(there, x.w);
    slots.arrays.unsorted_velocity[s] = quad(v, number);
    slots.arrays.cell[s] = cell;
    atomicAdd(slots.arrays.table + cell, 1);
}

/// Lays E out for the neighbours.
template <class Real>
__device__ void lay_out_zeroth_order_correction(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const WaterArrays<Real>& water = slots.water;
    const Vec4<Real> zeroth = water.zeroth[s];
    const Real share = physics::zeroth_order_share(water.density[s], water.position[s].w, model.water.kernel);
    water.zeroth_order_correction[s] = quad(zeroth.w * share * xyz(zeroth), water.impulse_sum[s]);
}

/// Once all passes are done: gives it back, and where `walls` hold up water, holds up what lies at them. Ghosts are
/// behind boundaries, so only what is nearer to a plane than the kernel's support has any for neighbours.
template <Pairs pairs, class Real>
__device__ void end_water_passes(const ModelView<Real>& model, const Slots<Real>& slots, int s, bool walls) {
    const WaterArrays<Real>& water = slots.water;
    const Vec4<Real> here = water.position[s];
    Vec3<Real> given_back{}, weight{};
    const auto gradient_at = [&](std::size_t place, int other, unsigned boundaries, const Vec4<Real>& there) {
        if constexpr (pairs == Pairs::listed)
            return water.pair[place].value();
        else
            return GradientsOf<Real>(model, water, s)
                .kept(boundaries, there, water.correction[other], water.shear[other]);
    };
    const auto add = [&](std::size_t place, int other, unsigned boundaries, const Vec4<Real>& x,
                         const Vec4<Real>& zeroth_order_correction) {
        Vec3<Real> there = xyz(x), its = xyz(zeroth_order_correction);
        if (boundaries != 0) {  // all at once: few warps have ghosts
            there = ghost_position(model.water, there, boundaries);
            its = reflected(model.water.ghost_transform[boundaries], its);
            if (walls && other < model.fluid) {
                Vec3<Real> gravity = model.water.weight_on_walls;
                if (const auto& carried = model.water.carried; carried.any())
                    gravity = gravity - carried.part(xyz(x)) * carried.gravity;
                weight += physics::hydrostatic_ghost_impulse(slots.arrays.state_position[other].w, x.w, slots.h,
                                                             gravity, there - xyz(x), zeroth_order_correction.w) *
                          gradient_at(place, other, boundaries, x);
            }
        }
        given_back += model.water.kernel.value(physics::length_of(xyz(here) - there)) * its;
    };
    for_each_water_neighbour<pairs, 1>(model, slots, s, model.particles, add, water.position,
                                       water.zeroth_order_correction);
    given_back = sum_of_lanes(given_back);
    weight = sum_of_lanes(weight);
    if (own_lane() != 0) return;
    const Vec4<Real> v = water.velocity[s];
    const Vec3<Real> push = (-v.w * here.w) * given_back;
    water.velocity[s] = quad(xyz(v) + push - v.w * weight, v.w);
    if (s >= model.fluid && v.w > 0) move_solid(model, slots, s, slots.h * push);
}

/// The fluid goes where its velocities take it.
template <class Real>
__device__ void move_water(const ModelView<Real>& model, const Slots<Real>& slots, int s) {
    const Vec4<Real> predicted = slots.predicted_position()[s];
    if (!(predicted.w > 0)) return;
    Vec3<Real> v = xyz(slots.water.velocity[slots.water.slot_before[s]]);
    if (model.plan.clamp_speed) v = clamped(v, model.max_speed);
    const auto displaced = [&] { return slots.h * (v - xyz(slots.predicted_velocity()[s])); };
    Vec3<Real> x = xyz(predicted) + displaced();
    for (int k = 0; k < model.planes; ++k) hold_before(model.plane[k].surface, wall_distance(model, true), x, v);
    slots.displacement()[s] = quad(displaced(), Real(0));  // what velocities are made of
    slots.position()[s] = quad(x, predicted.w);
}

}  // namespace natator::cuda
