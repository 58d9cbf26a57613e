#pragma once

#include <cstdint>

#include "natator/solver.h"
#include "physics/background_pressure.h"
#include "physics/boundary.h"
#include "physics/dfsph.h"
#include "physics/spring.h"
#include "physics/velocity.h"
#include "vec3.cuh"

namespace natator::cuda {

/// Cells one behind the other; none if the last is before the first.
struct CellRun {
    int first, last;
};

/// Cells as in the CPU's CellGrid, laid once over the scene's box: positions outside belong to its border cells.
template <class Real>
struct GridView {
    Real low[3], size[3], inverse_size[3];  ///< of a cell
    int count[3];
    int cells;

    static constexpr int reach_x = 4;

    /// Size of a table with two counts a word, of the fluid and of the solids, for every cell; full chunks of four.
    __host__ __device__ int words() const { return (cells + 3) / 4 * 4; }

    __device__ int coordinate(Real value, int axis) const {
        const Real cells_from_low = (value - low[axis]) * inverse_size[axis];
        if (!(cells_from_low > 0)) return 0;  // also for NaN
        const Real last = static_cast<Real>(count[axis] - 1);
        return cells_from_low < last ? static_cast<int>(cells_from_low) : count[axis] - 1;
    }
    __device__ int cell(const Vec3<Real>& x) const {
        return (coordinate(x.z, 2) * count[1] + coordinate(x.y, 1)) * count[0] + coordinate(x.x, 0);
    }
    /// Distance of a value from the row of cells `step` beside its own, -1, 0 or 1.
    __device__ Real distance_to_row(Real value, int axis, int step) const {
        if (step == 0) return 0;
        const Real in_cell = (value - low[axis]) * inverse_size[axis] - static_cast<Real>(coordinate(value, axis));
        return physics::positive_part(step > 0 ? 1 - in_cell : in_cell) * size[axis];
    }

    /// Calls visit(run) for the runs of cells that may hold particles within the search distance of x. To cut them to
    /// the sphere saves a third of the candidates and costs more: runs of the lanes then differ.
    template <class Visit>
    __device__ void for_each_run(const Vec3<Real>& x, const Visit& visit) const {
        const int cx = coordinate(x.x, 0), cy = coordinate(x.y, 1), cz = coordinate(x.z, 2);
        for (int iz = max(cz - 1, 0); iz <= min(cz + 1, count[2] - 1); ++iz)
            for (int iy = max(cy - 1, 0); iy <= min(cy + 1, count[1] - 1); ++iy) visit(around(cx, iy, iz));
    }
    /// Run k of them, in the same order; one that is outside has no cells.
    __device__ CellRun run(const Vec3<Real>& x, int k) const {
        const int iy = coordinate(x.y, 1) + k % 3 - 1, iz = coordinate(x.z, 2) + k / 3 - 1;
        if (iy < 0 || iy >= count[1] || iz < 0 || iz >= count[2]) return {0, -1};
        return around(coordinate(x.x, 0), iy, iz);
    }
    static constexpr int runs = 9;

private:
    __device__ CellRun around(int cx, int iy, int iz) const {
        const int row = (iz * count[1] + iy) * count[0];
        return {row + max(cx - reach_x, 0), row + min(cx + reach_x, count[0] - 1)};
    }
};

template <class Real>
struct DevicePlane {
    physics::PlaneSurface<Real> surface;
    physics::PlaneSurface<double> exact;  ///< for the measurement
};

template <class Real>
struct SpringView {
    int a, b;  ///< solid ids
    Real rest_length;
    physics::SpringRule<Real> rule;
};

struct MuscleView {
    int spring, actuator;
    double rest_length, lateral;
};

template <class Real>
struct ClusterView {
    int begin, end;  ///< of its members
    Real stiffness;
    double softness;  ///< see physics::softness
};

/// One entry of what acts on a solid particle: a spring with its other end, or a cluster with a member's rest offset.
struct Incidence {
    int constraint;
    int other;  ///< spring: solid id of the other end; cluster: index of the member
};

inline constexpr int max_planes = 16;

/// x -> H x + shift: takes a place to that of its ghost through one or more boundaries. H is a product of reflections,
/// and turns vectors into those of the ghost.
template <class Real>
struct GhostTransform {
    Vec4<Real> row[3];  ///< of H; w: of the shift
};

inline constexpr int max_boundaries = 6;
inline constexpr int max_slot_bits = 26;  ///< the rest of 32 bits is a set of boundaries

/// The water of scheme `conserving`. A ghost is known by its particle and the set of boundaries that it went through,
/// in their order: bit k for boundary k.
template <class Real>
struct WaterModel {
    Real radius, spacing, at_spacing, softening, dynamic_viscosity;
    Real density;                                           ///< mass/length^3 at rest
    Real max_expansion_rate;                                ///< 1/s, see physics::velocity_excess
    Real effect_radius, cohesion_strength, cohesion_slope;  ///< of physics/water_effects.h
    physics::WendlandKernel<Real> kernel;
    GridView<Real> grid;
    Real fluid_volume;           ///< of any particle of the fluid
    const Real* volume;          ///< by particle
    Vec3<Real> weight_on_walls;  ///< gravity of the fluid along axes that have ends, length/s^2
    physics::CarriedWeight<Real> carried;
    int periodic_axes, boundaries;
    physics::PeriodicAxis<Real> periodic_axis[2];
    physics::Boundary<Real> boundary[max_boundaries];  ///< see boundaries_of
    const GhostTransform<Real>* ghost_transform;       ///< by set of boundaries
    int max_copies;                                    ///< of a particle: itself and its ghosts
};

/// A Model in device memory. Particles are numbered anew: first the fluid, then the solids, each in the Model's order.
template <class Real>
struct ModelView {
    Plan plan;
    Scheme scheme;
    int particles, fluid, solids;

    Real radius, inverse_radius, search_distance, solid_rest_distance, density_scale;
    Real dynamic_friction, static_friction, particle_friction, collision_distance, plane_search_distance;
    Real viscosity, damping, max_acceleration, max_speed, relaxation_factor, solid_pressure;
    bool local_relaxation;
    Vec3<Real> gravity, fluid_gravity;
    Vec3<Real> bounded_gravity, bounded_fluid_gravity;  ///< gravity_on_walls, and what buoyancy leaves of it
    int iterations, solid_iterations, max_neighbours;

    // Off in the thesis, see physics/effects.h.
    Real restitution, touching_distance, min_impact_speed;  ///< the last per substep length
    Real dissipation, cohesion_strength, cohesion_slope, gradient_estimate;
    Real adhesion, sleep_threshold, surface_tension, vorticity, free_surface_drag, shock_propagation;
    Vec3<Real> up;  ///< against gravity

    // Scheme conserving.
    Real overlap_acceleration;  ///< see cpu::overlap_acceleration
    WaterModel<Real> water;

    GridView<Real> grid;
    int planes;
    DevicePlane<Real> plane[max_planes];

    const Real* inverse_mass;         ///< by particle
    const std::uint32_t* phase;       ///< by particle
    const Vec3<Real>* rest_position;  ///< by particle; null if no particle filters its collisions

    int springs, clusters, members, muscles, actuators;
    int own_springs;  ///< of the swimmer, the first ones
    const SpringView<Real>* spring;
    const MuscleView* muscle;
    const ClusterView<Real>* cluster;
    const int* member;                   ///< solid ids, cluster by cluster
    const Vec3<Real>* offset;            ///< rest position minus the mean of the rest positions, by member
    const Real* member_mass;             ///< by member, see cpu::SplitCluster; null in scheme flex
    const int* spring_incidences_begin;  ///< by solid, one more at the end
    const Incidence* spring_incidence;
    const int* cluster_incidences_begin;  ///< by solid, one more at the end
    const Incidence* cluster_incidence;

    int free_bodies;
    const int* free_body_begin;     ///< one more at the end
    const int* free_body_particle;  ///< solid ids

    int body;                  ///< particles of the swimmer
    const int* body_particle;  ///< solid ids
    int tail;                  ///< particles of its last slice, the last of body_particle
};

}  // namespace natator::cuda
