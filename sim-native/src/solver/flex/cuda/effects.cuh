#pragma once

// Forces and losses that the thesis leaves off: physics/effects.h has the formulas. What acts behind the velocities
// works on `new_velocity` and `end_position`, slot by slot; barriers or launches lie between two passes.
#include "physics/effects.h"
#include "solver/cuda/contacts.cuh"

namespace natator::cuda {

template <class Real, class Team>
__device__ Vec3<Real> velocity_of(const Team& team, int s) {
    return xyz(team.new_velocity()[s]);
}
template <class Real, class Team>
__device__ void set_velocity(const Team& team, int s, const Vec3<Real>& v) {
    Vec4<Real>& to = team.new_velocity()[s];
    to = quad(v, to.w);
}

/// Calls visit(slot, vector from it to s, r, q = r/R) for the fluid neighbours of fluid slot s with 0 < r < R.
template <class Real, class Team, class Visit>
__device__ void for_each_near_neighbour(const ModelView<Real>& model, const Team& team, int s, const Vec4<Real>* places,
                                        const Visit& visit) {
    const Vec3<Real> x = xyz(places[s]);
    for_each_neighbour(model, team, s, [&](int other) {
        const Vec3<Real> difference = x - xyz(places[other]);
        const Real r = norm(difference);
        if (r > 0 && r < model.radius) visit(other, difference, r, r * model.inverse_radius);
    });
}

/// Would a contact overlap without the solver? At the predicted positions.
template <class Real>
__device__ bool overlaps(const ModelView<Real>& model, const Vec4<Real>* predicted, int s, int other) {
    return norm(xyz(predicted[s]) - xyz(predicted[other])) < model.solid_rest_distance;
}

/// Number of contacts of slot s that would, while positions are the predicted ones.
template <class Real, class Team>
__device__ void count_overlaps(const ModelView<Real>& model, const Team& team, int s) {
    int count = 0;
    for_each_contact(model, team, s, [&](int other) { count += overlaps(model, team.position(), s, other); });
    team.overlaps()[s] = static_cast<Real>(count);
}

/// Dissipation of scheme flex.
template <class Real, class Team>
__device__ void damp(const ModelView<Real>& model, const Team& team, int s) {
    const Vec3<Real> v = velocity_of<Real>(team, s);
    if (team.position()[s].w > 0)
        set_velocity(team, s, v - physics::dissipated(team.overlaps()[s], team.h * model.dissipation) * v);
}

/// Dissipation of scheme conserving, into `change`.
template <class Real, class Team>
__device__ void measure_damping(const ModelView<Real>& model, const Team& team, int s) {
    const Real step = team.h * model.dissipation, n = team.overlaps()[s], inverse_mass = team.position()[s].w;
    const Vec3<Real> v = velocity_of<Real>(team, s);
    Vec3<Real> change{};
    if (inverse_mass > 0)
        for_each_contact(model, team, s, [&](int other) {
            if (!overlaps(model, team.predicted_position(), s, other)) return;
            const Real share = physics::impulse_share(inverse_mass, team.position()[other].w);
            change += share * physics::dissipated_by_pair(n + team.overlaps()[other], step) *
                      (velocity_of<Real>(team, other) - v);
        });
    team.change()[s] = quad(change, Real(0));
}

/// Applies `change`.
template <class Real, class Team>
__device__ void apply_change(const ModelView<Real>&, const Team& team, int s) {
    set_velocity(team, s, velocity_of<Real>(team, s) + xyz(team.change()[s]));
}

/// Of fluid slots.
template <class Real, class Team>
__device__ void drag(const ModelView<Real>& model, const Team& team, int s) {
    if (!(team.position()[s].w > 0)) return;
    set_velocity(team, s,
                 physics::dragged(velocity_of<Real>(team, s), team.density()[s], team.h * model.free_surface_drag));
}

/// Normals and curls of the fluid.
template <class Real, class Team>
__device__ void measure_fluid(const ModelView<Real>& model, const Team& team, int s) {
    Vec3<Real> normal{}, curl{};
    const Vec3<Real> v = velocity_of<Real>(team, s);
    for_each_near_neighbour(model, team, s, team.position(),
                            [&](int other, const Vec3<Real>& difference, Real r, Real q) {
                                if (model.plan.surface_tension)
                                    normal += physics::gradient_part(Real(1), difference, r, q);
                                if (model.plan.vorticity)
                                    curl += physics::curl_part(difference, r, q, velocity_of<Real>(team, other) - v);
                            });
    if (model.plan.surface_tension) team.normal()[s] = quad(model.gradient_estimate * normal, Real(0));
    if (model.plan.vorticity) team.curl()[s] = quad(model.gradient_estimate * model.inverse_radius * curl, Real(0));
}

/// Surface tension and vorticity confinement of fluid slot s.
template <class Real, class Team>
__device__ void push_fluid_by_forces(const ModelView<Real>& model, const Team& team, int s) {
    const Real w = team.position()[s].w;
    if (!(w > 0)) return;
    const Vec3<Real> n = model.plan.surface_tension ? xyz(team.normal()[s]) : Vec3<Real>{};
    const Vec3<Real> curl = model.plan.vorticity ? xyz(team.curl()[s]) : Vec3<Real>{};
    Vec3<Real> tension{}, towards_stronger{};
    for_each_near_neighbour(
        model, team, s, team.position(), [&](int other, const Vec3<Real>& difference, Real r, Real q) {
            const Real share = physics::impulse_share(w, team.position()[other].w);
            if (model.plan.surface_tension) tension += share * (n - xyz(team.normal()[other]));
            if (model.plan.vorticity)
                towards_stronger -=
                    physics::gradient_part(norm(xyz(team.curl()[other])) - norm(curl), difference, r, q);
        });
    Vec3<Real> v = velocity_of<Real>(team, s);
    v -= team.h * model.surface_tension * tension;
    v += physics::confinement(towards_stronger, curl, team.h * model.vorticity);
    set_velocity(team, s, model.plan.clamp_speed ? clamped(v, model.max_speed) : v);
}

/// Adhesion, restitution and sleep of slot s, in this order.
template <class Real, class Team>
__device__ void apply_adhesion(const ModelView<Real>& model, const Team& team, int s) {
    const Vec4<Real> end = team.end_position()[s];
    if (!(end.w > 0)) return;
    Vec3<Real> x = xyz(end), v = velocity_of<Real>(team, s);
    const Real limit = model.adhesion * team.h * team.h;
    for (int k = model.planes - 1; k >= 0; --k) {
        const physics::PlaneSurface<Real>& plane = model.plane[k].surface;
        if (distance_to(plane, xyz(team.start()[s])) > model.touching_distance) continue;
        const Real back = physics::taken_back(distance_to(plane, x) - model.collision_distance, limit);
        x -= back * plane.normal;
        v -= back / team.h * plane.normal;
    }
    team.end_position()[s] = quad(x, end.w);
    set_velocity(team, s, v);
}

template <class Real, class Team>
__device__ void apply_restitution(const ModelView<Real>& model, const Team& team, int s) {
    const Vec4<Real> end = team.end_position()[s];
    if (!(end.w > 0)) return;
    Vec3<Real> v = velocity_of<Real>(team, s);
    for_each_near_plane(model, team, s, xyz(end), [&](const physics::PlaneSurface<Real>& plane, Real distance) {
        if (distance > model.touching_distance) return;
        const Real missing = rebound_speed(plane.normal, xyz(team.predicted_velocity()[s]), v, model.restitution,
                                           team.h * model.min_impact_speed);
        v += missing * plane.normal;
    });
    set_velocity(team, s, v);
}

template <class Real, class Team>
__device__ void apply_sleep(const ModelView<Real>& model, const Team& team, int s) {
    if (!(team.end_position()[s].w > 0) || !(norm(velocity_of<Real>(team, s)) < model.sleep_threshold)) return;
    set_velocity(team, s, Vec3<Real>{});
    team.end_position()[s] = team.start()[s];
}

/// Pull of the fluid around a slot of `scratch_position` in scheme flex, per inverse mass: cohesion.
template <class Real, class Team>
__device__ Vec3<Real> cohesion_push(const ModelView<Real>& model, const Team& team, int s) {
    Vec3<Real> sum{};
    for_each_near_neighbour(model, team, s, team.scratch_position(),
                            [&](int, const Vec3<Real>& difference, Real r, Real q) {
                                sum += physics::cohesion_pull(q, model.cohesion_slope) / r * difference;
                            });
    return -model.cohesion_strength * sum;
}

}  // namespace natator::cuda
