#include "solver_fields.h"

#include <algorithm>
#include <limits>

#include "natator/limits.h"

namespace natator::fields {
namespace {

constexpr double max_float = std::numeric_limits<float>::max();
constexpr double no_limit = 3.5e38;  // values above the largest float mean it; 3.4028235e38 reads as slightly above

}  // namespace

const std::vector<Field<SolverParameters>>& solver_fields() {
    using P = SolverParameters;
    static const std::vector<Field<P>> fields = {
        {"substeps", &P::substeps, {1, 1000}},
        {"numIterations", &P::iterations, {1, 1000}},
        {"gravity", &P::gravity, {-1000, 1000, false, "length/s^2"}},
        {"radius", &P::radius, {0, 1000, true, "length"}},
        {"solidRestDistance", &P::solid_rest_distance, {0, 1000, true, "length"}},
        {"fluidRestDistance", &P::fluid_rest_distance, {0, 1000, true, "length"}},
        {"dynamicFriction", &P::dynamic_friction, {0, 100}},
        {"staticFriction", &P::static_friction, {0, 100}},
        {"particleFriction", &P::particle_friction, {0, 100}},
        {"restitution", &P::restitution, {0, 1}},
        {"adhesion", &P::adhesion, {0, 10000, false, "length/s^2"}},
        {"sleepThreshold", &P::sleep_threshold, {0, 1000, false, "length/s"}},
        {"maxSpeed", &P::max_speed, {0, no_limit, true, "length/s"}},
        {"maxAcceleration", &P::max_acceleration, {0, no_limit, true, "length/s^2"}},
        {"shockPropagation", &P::shock_propagation, {0, 1000, false, "1/length"}},
        {"dissipation", &P::dissipation, {0, 1000, false, "1/s"}},
        {"damping", &P::damping, {0, 1000, false, "1/s"}},
        {"cohesion", &P::cohesion, {0, 1000}},
        {"surfaceTension", &P::surface_tension, {0, 10000, false, "length/s^2"}},
        {"vorticityConfinement", &P::vorticity_confinement, {0, 1000, false, "length/s"}},
        {"freeSurfaceDrag", &P::free_surface_drag, {0, 1000, false, "1/s"}},
        {"buoyancy", &P::buoyancy, {-100, 100}},
        {"collisionDistance", &P::collision_distance, {0, 1000, false, "length"}},
        {"particleCollisionMargin", &P::particle_collision_margin, {0, 1000, false, "length"}},
        {"shapeCollisionMargin", &P::shape_collision_margin, {0, 1000, false, "length"}},
        {"relaxationFactor", &P::relaxation_factor, {0, 10}},
    };
    return fields;
}

const std::vector<Field<FlexParameters>>& flex_fields() {
    using P = FlexParameters;
    static const std::vector<Field<P>> fields = {
        {"viscosity", &P::viscosity, {0, 10000, false, "1/s"}},
        {"solidPressure", &P::solidPressure, {0, 100}},
        {"maxNeighborsPerParticle", &P::maxNeighborsPerParticle, {1, 4096}},
    };
    return fields;
}

const std::vector<Field<ConservingParameters>>& conserving_fields() {
    using P = ConservingParameters;
    static const std::vector<Field<P>> fields = {
        {"solidIterations", &P::solid_iterations, {1, 1000}},
        {"densityTolerance", &P::density_tolerance, {0, 1, false, "rest densities"}},
        {"maxIterations", &P::max_iterations, {1, 1000}},
        {"kernelSupport",
         &P::kernel_support,
         {limits::min_kernel_support, limits::max_kernel_support, false, "rest distances of the fluid"}},
        {"modifiedPressure", &P::modified_pressure},
        {"kinematicViscosity", &P::kinematic_viscosity, {0, 1000, false, "length^2/s"}},
    };
    return fields;
}

void limit_to_float(SolverParameters& solver) {
    solver.max_speed = std::min(solver.max_speed, max_float);
    solver.max_acceleration = std::min(solver.max_acceleration, max_float);
}

void check_rest_distances(const SolverParameters& solver, const Place& place) {
    const json radius = solver.radius;
    if (solver.solid_rest_distance > solver.radius) {
        refuse(place.key("solidRestDistance"), solver.solid_rest_distance, "at most radius = " + radius.dump());
    }
    if (solver.fluid_rest_distance >= solver.radius) {
        refuse(place.key("fluidRestDistance"), solver.fluid_rest_distance, "less than radius = " + radius.dump());
    }
    if (solver.radius > limits::radius_ratio * solver.fluid_rest_distance) {
        refuse(place.key("fluidRestDistance"), solver.fluid_rest_distance,
               "at least radius / " + std::to_string(limits::radius_ratio) + ", radius = " + radius.dump());
    }
}

void check_solver(SolverParameters solver, const Place& place) {
    limit_to_float(solver);
    check_object(solver, place, solver_fields());
    check_object(solver.flex, place, flex_fields());
    check_object(solver.conserving, place, conserving_fields());
    check_rest_distances(solver, place);
}

}  // namespace natator::fields
