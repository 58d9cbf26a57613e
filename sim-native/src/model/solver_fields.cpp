#include "solver_fields.h"

#include <algorithm>
#include <limits>

#include "natator/limits.h"

namespace natator::fields {
namespace {

constexpr double largest_float = std::numeric_limits<float>::max();
constexpr double no_limit = 3.5e38;  // values above the largest float mean it; 3.4028235e38 reads as slightly above

}  // namespace

const std::vector<Field<SolverParameters>>& solver_fields() {
    using P = SolverParameters;
    static const std::vector<Field<P>> fields = {
        {"substeps", &P::substeps, {1, 1000}},
        {"numIterations", &P::numIterations, {1, 1000}},
        {"solidIterations", &P::solidIterations, {1, 1000}},
        {"densityTolerance", &P::densityTolerance, {0, 1, false, "rest densities"}},
        {"maxIterations", &P::maxIterations, {1, 1000}},
        {"gravity", &P::gravity, {-1000, 1000, false, "length/s^2"}},
        {"radius", &P::radius, {0, 1000, true, "length"}},
        {"solidRestDistance", &P::solidRestDistance, {0, 1000, true, "length"}},
        {"fluidRestDistance", &P::fluidRestDistance, {0, 1000, true, "length"}},
        {"dynamicFriction", &P::dynamicFriction, {0, 100}},
        {"staticFriction", &P::staticFriction, {0, 100}},
        {"particleFriction", &P::particleFriction, {0, 100}},
        {"restitution", &P::restitution, {0, 1}},
        {"adhesion", &P::adhesion, {0, 10000, false, "length/s^2"}},
        {"sleepThreshold", &P::sleepThreshold, {0, 1000, false, "length/s"}},
        {"maxSpeed", &P::maxSpeed, {0, no_limit, true, "length/s"}},
        {"maxAcceleration", &P::maxAcceleration, {0, no_limit, true, "length/s^2"}},
        {"shockPropagation", &P::shockPropagation, {0, 1000, false, "1/length"}},
        {"dissipation", &P::dissipation, {0, 1000, false, "1/s"}},
        {"damping", &P::damping, {0, 1000, false, "1/s"}},
        {"cohesion", &P::cohesion, {0, 1000}},
        {"surfaceTension", &P::surfaceTension, {0, 10000, false, "length/s^2"}},
        {"viscosity", &P::viscosity, {0, 10000, false, "1/s"}},
        {"kernelSupport",
         &P::kernelSupport,
         {limits::min_kernel_support, limits::max_kernel_support, false, "rest distances of the fluid"}},
        {"modifiedPressure", &P::modifiedPressure},
        {"kinematicViscosity", &P::kinematicViscosity, {0, 1000, false, "length^2/s"}},
        {"vorticityConfinement", &P::vorticityConfinement, {0, 1000, false, "length/s"}},
        {"solidPressure", &P::solidPressure, {0, 100}},
        {"freeSurfaceDrag", &P::freeSurfaceDrag, {0, 1000, false, "1/s"}},
        {"buoyancy", &P::buoyancy, {-100, 100}},
        {"collisionDistance", &P::collisionDistance, {0, 1000, false, "length"}},
        {"particleCollisionMargin", &P::particleCollisionMargin, {0, 1000, false, "length"}},
        {"shapeCollisionMargin", &P::shapeCollisionMargin, {0, 1000, false, "length"}},
        {"relaxationFactor", &P::relaxationFactor, {0, 10}},
        {"maxNeighborsPerParticle", &P::maxNeighborsPerParticle, {1, 4096}},
    };
    return fields;
}

void limit_to_float(SolverParameters& solver) {
    solver.maxSpeed = std::min(solver.maxSpeed, largest_float);
    solver.maxAcceleration = std::min(solver.maxAcceleration, largest_float);
}

void check_rest_distances(const SolverParameters& solver, const Place& place) {
    const json radius = solver.radius;
    if (solver.solidRestDistance > solver.radius) {
        refuse(place.key("solidRestDistance"), solver.solidRestDistance, "at most radius = " + radius.dump());
    }
    if (solver.fluidRestDistance >= solver.radius) {
        refuse(place.key("fluidRestDistance"), solver.fluidRestDistance, "less than radius = " + radius.dump());
    }
    if (solver.radius > limits::radius_ratio * solver.fluidRestDistance) {
        refuse(place.key("fluidRestDistance"), solver.fluidRestDistance,
               "at least radius / " + std::to_string(limits::radius_ratio) + ", radius = " + radius.dump());
    }
}

void check_solver(SolverParameters solver, const Place& place) {
    limit_to_float(solver);
    check_object(solver, place, solver_fields());
    check_rest_distances(solver, place);
}

}  // namespace natator::fields
