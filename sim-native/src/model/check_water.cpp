#include <algorithm>
#include <cmath>
#include <sstream>

#include "background_pressure.h"
#include "base/text.h"
#include "boundaries.h"
#include "check_scene.h"
#include "physics/constants.h"
#include "physics/dfsph.h"

namespace natator::fields {
namespace {

json as_json(const Plane& plane) {
    return {plane.normal.x(), plane.normal.y(), plane.normal.z(), plane.offset};
}

/// What acts on the water by explicit steps, which bear so much of it; settling has its own substeps. Of cohesion and
/// tension that goes with the square of the step, as of a spring; of confinement, which makes a vortex grow, with the
/// step.
void check_explicit_forces(const Scene& scene, const Place& place) {
    const SolverParameters& p = scene.solver;
    double h = scene.time_step / p.substeps;
    if (scene.settling.updates > 0) h = std::max(h, scene.settling.time_step / scene.settling.substeps);
    const double spacing = p.fluid_rest_distance,
                 reach = std::min(p.radius, p.conserving.kernel_support * spacing) / spacing;
    const auto check = [&](const char* key, double value, double most, const char* why) {
        if (value > most)
            refuse(place.key("solver").key(key), value,
                   "at most " + computed_text(most) + " (" + why + ", settling included)");
    };
    check("kinematicViscosity", p.conserving.kinematic_viscosity, physics::max_viscosity(spacing, h),
          "0.1 fluidRestDistance^2 / longest substep");
    check("cohesion", p.cohesion, 0.4 * std::pow(physics::thesis_substep / h, 2) * std::pow(1.5 / reach, 3),
          "0.4 (1/240 s / longest substep)^2 (1.5 fluidRestDistance / radius)^3");
    check("surfaceTension", p.surface_tension, 0.02 * spacing / (h * h), "0.02 fluidRestDistance / longest substep^2");
    check("vorticityConfinement", p.vorticity_confinement, 0.5 * spacing / h,
          "0.5 fluidRestDistance / longest substep");
    check("relaxationFactor", p.relaxation_factor, 2, "beyond it corrections grow from one iteration to the next");
}

/// Mirrors fill space only where they meet at right angles, or face each other.
void check_mirrors(const Scene& scene, const Place& place) {
    constexpr double tolerance = 1e-3;
    for (std::size_t i = 0; i < scene.planes.size(); ++i)
        for (std::size_t k = 0; k < i; ++k) {
            const double cosine = scene.planes[i].normal.dot(scene.planes[k].normal);
            if (std::abs(cosine) < tolerance || cosine < tolerance - 1) continue;
            std::ostringstream text;
            text << "at a right angle to planes[" << k << "] or facing it, in scheme conserving";
            refuse(place.key("planes").item(i), as_json(scene.planes[i]), text.str());
        }
}

/// What water weighs along periodic axes is not carried.
void check_modified_pressure(const Scene& scene, const Place& place) {
    const Eigen::Vector3d weight = scene.solver.buoyancy * gravity_on_walls(scene.solver, scene.periodic);
    if (!scene.solver.conserving.modified_pressure || weight.isZero(0)) return;
    if (const auto reason = no_tank(weight, scene.planes, scene.periodic))
        refuse(place.key("solver").key("modifiedPressure"), true, "false here: it " + *reason);
}

}  // namespace

void check_water(const Scene& scene, const Place& place) {
    if (scene.scheme != Scheme::conserving) return;
    check_explicit_forces(scene, place);
    check_mirrors(scene, place);
    check_modified_pressure(scene, place);
}

void check_plane(const Plane& plane, const Place& place) {
    constexpr double tolerance = 1e-4;
    if (!(std::abs(plane.normal.norm() - 1) <= tolerance))
        refuse(place, as_json(plane), "[a, b, c, d] with (a, b, c) of length 1");
    if (!std::isfinite(plane.offset)) refuse(place.item(3), plane.offset, "a finite number (length)");
}

}  // namespace natator::fields
