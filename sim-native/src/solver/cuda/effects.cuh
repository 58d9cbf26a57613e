#pragma once

// Forces and losses that the thesis leaves off: physics/effects.h has the formulas. What acts behind the velocities
// works on `new_velocity` and `end_position`, slot by slot; barriers or launches lie between two passes.
#include "contacts.cuh"
#include "physics/effects.h"

namespace natator::cuda {

template <class Real, class Block>
__device__ Vec3<Real> velocity_of(const Block& block, int s) {
    return xyz(block.new_velocity()[s]);
}
template <class Real, class Block>
__device__ void set_velocity(const Block& block, int s, const Vec3<Real>& v) {
    Quad<Real>& to = block.new_velocity()[s];
    to = quad(v, to.w);
}

/// Calls visit(slot, vector from it to s, r, q = r/R) for the fluid neighbours of fluid slot s with 0 < r < R.
template <class Real, class Block, class Visit>
__device__ void for_each_near_neighbour(const ModelView<Real>& model, const Block& block, int s,
                                        const Quad<Real>* places, const Visit& visit) {
    const Vec3<Real> x = xyz(places[s]);
    for_each_neighbour(model, block, s, [&](int other) {
        const Vec3<Real> difference = x - xyz(places[other]);
        const Real r = norm(difference);
        if (r > 0 && r < model.radius) visit(other, difference, r, r * model.inverse_radius);
    });
}

/// Would a contact overlap without the solver? At the predicted positions.
template <class Real>
__device__ bool overlaps(const ModelView<Real>& model, const Quad<Real>* predicted, int s, int other) {
    return norm(xyz(predicted[s]) - xyz(predicted[other])) < model.solid_rest_distance;
}

/// Number of contacts of slot s that would, while positions are the predicted ones.
template <class Real, class Block>
__device__ void count_overlaps(const ModelView<Real>& model, const Block& block, int s) {
    int count = 0;
    for_each_contact(model, block, s, [&](int other) { count += overlaps(model, block.position(), s, other); });
    block.overlaps()[s] = static_cast<Real>(count);
}

/// Dissipation of scheme flex.
template <class Real, class Block>
__device__ void damp(const ModelView<Real>& model, const Block& block, int s) {
    const Vec3<Real> v = velocity_of<Real>(block, s);
    if (block.position()[s].w > 0)
        set_velocity(block, s, v - physics::dissipated(block.overlaps()[s], block.h * model.dissipation) * v);
}

/// Dissipation of scheme conserving, into `change`.
template <class Real, class Block>
__device__ void measure_damping(const ModelView<Real>& model, const Block& block, int s) {
    const Real step = block.h * model.dissipation, n = block.overlaps()[s], inverse_mass = block.position()[s].w;
    const Vec3<Real> v = velocity_of<Real>(block, s);
    Vec3<Real> change{};
    if (inverse_mass > 0)
        for_each_contact(model, block, s, [&](int other) {
            if (!overlaps(model, block.base(), s, other)) return;
            const Real share = physics::impulse_share(inverse_mass, block.position()[other].w);
            change += share * physics::dissipated_by_pair(n + block.overlaps()[other], step) *
                      (velocity_of<Real>(block, other) - v);
        });
    block.change()[s] = quad(change, Real(0));
}

/// What `change` says.
template <class Real, class Block>
__device__ void apply_change(const ModelView<Real>&, const Block& block, int s) {
    set_velocity(block, s, velocity_of<Real>(block, s) + xyz(block.change()[s]));
}

/// Of fluid slots.
template <class Real, class Block>
__device__ void drag(const ModelView<Real>& model, const Block& block, int s) {
    if (!(block.position()[s].w > 0)) return;
    set_velocity(block, s, physics::dragged(velocity_of<Real>(block, s), block.density()[s],
                                            block.h * model.free_surface_drag));
}

/// Normals and curls of the fluid.
template <class Real, class Block>
__device__ void measure_fluid(const ModelView<Real>& model, const Block& block, int s) {
    Vec3<Real> normal{}, curl{};
    const Vec3<Real> v = velocity_of<Real>(block, s);
    for_each_near_neighbour(model, block, s, block.position(),
                            [&](int other, const Vec3<Real>& difference, Real r, Real q) {
                                if (model.plan.surface_tension)
                                    normal += physics::gradient_part(Real(1), difference, r, q);
                                if (model.plan.vorticity)
                                    curl += physics::curl_part(difference, r, q, velocity_of<Real>(block, other) - v);
                            });
    if (model.plan.surface_tension) block.normal()[s] = quad(model.gradient_estimate * normal, Real(0));
    if (model.plan.vorticity)
        block.curl()[s] = quad(model.gradient_estimate * model.inverse_radius * curl, Real(0));
}

/// Surface tension and vorticity confinement of fluid slot s.
template <class Real, class Block>
__device__ void push_fluid_by_forces(const ModelView<Real>& model, const Block& block, int s) {
    const Real w = block.position()[s].w;
    if (!(w > 0)) return;
    const Vec3<Real> n = model.plan.surface_tension ? xyz(block.normal()[s]) : Vec3<Real>{};
    const Vec3<Real> curl = model.plan.vorticity ? xyz(block.curl()[s]) : Vec3<Real>{};
    Vec3<Real> tension{}, towards_stronger{};
    for_each_near_neighbour(
        model, block, s, block.position(), [&](int other, const Vec3<Real>& difference, Real r, Real q) {
            const Real share = physics::impulse_share(w, block.position()[other].w);
            if (model.plan.surface_tension) tension += share * (n - xyz(block.normal()[other]));
            if (model.plan.vorticity)
                towards_stronger -=
                    physics::gradient_part(norm(xyz(block.curl()[other])) - norm(curl), difference, r, q);
        });
    Vec3<Real> v = velocity_of<Real>(block, s);
    v -= block.h * model.surface_tension * tension;
    v += physics::confinement(towards_stronger, curl, block.h * model.vorticity);
    set_velocity(block, s, model.plan.clamp_speed ? clamped(v, model.max_speed) : v);
}

/// Adhesion, restitution and sleep of slot s, in this order.
template <class Real, class Block>
__device__ void apply_adhesion(const ModelView<Real>& model, const Block& block, int s) {
    const Quad<Real> end = block.end_position()[s];
    if (!(end.w > 0)) return;
    Vec3<Real> x = xyz(end), v = velocity_of<Real>(block, s);
    const Real most = model.adhesion * block.h * block.h;
    for (int k = model.planes - 1; k >= 0; --k) {
        const physics::PlaneSurface<Real>& plane = model.plane[k].surface;
        if (distance_to(plane, xyz(block.start()[s])) > model.touching_distance) continue;
        const Real back = physics::taken_back(distance_to(plane, x) - model.collision_distance, most);
        x -= back * plane.normal;
        v -= back / block.h * plane.normal;
    }
    block.end_position()[s] = quad(x, end.w);
    set_velocity(block, s, v);
}

template <class Real, class Block>
__device__ void apply_restitution(const ModelView<Real>& model, const Block& block, int s) {
    const Quad<Real> end = block.end_position()[s];
    if (!(end.w > 0)) return;
    Vec3<Real> v = velocity_of<Real>(block, s);
    for_each_near_plane(model, block, s, xyz(end), [&](const physics::PlaneSurface<Real>& plane, Real distance) {
        if (distance > model.touching_distance) return;
        const Real missing = rebound_speed(plane.normal, xyz(block.predicted_velocity()[s]), v, model.restitution,
                                           block.h * model.slowest_impact);
        v += missing * plane.normal;
    });
    set_velocity(block, s, v);
}

template <class Real, class Block>
__device__ void apply_sleep(const ModelView<Real>& model, const Block& block, int s) {
    if (!(block.end_position()[s].w > 0) || !(norm(velocity_of<Real>(block, s)) < model.sleep_threshold)) return;
    set_velocity(block, s, Vec3<Real>{});
    block.end_position()[s] = block.start()[s];
}

/// Pull of the fluid around a slot of `next` in scheme flex, per inverse mass: cohesion.
template <class Real, class Block>
__device__ Vec3<Real> cohesion_push(const ModelView<Real>& model, const Block& block, int s) {
    Vec3<Real> sum{};
    for_each_near_neighbour(model, block, s, block.next(),
                            [&](int, const Vec3<Real>& difference, Real r, Real q) {
                                sum += physics::cohesion_pull(q, model.cohesion_slope) / r * difference;
                            });
    return -model.cohesion_strength * sum;
}

}  // namespace natator::cuda
