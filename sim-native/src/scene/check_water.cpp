#include <algorithm>
#include <cmath>
#include <sstream>

#include "io/strict_json.h"
#include "model/borders.h"
#include "model/carried_weight.h"
#include "physics/dfsph.h"
#include "readers.h"

namespace natator::fields {
namespace {

json as_json(const Plane& plane) { return {plane.normal.x(), plane.normal.y(), plane.normal.z(), plane.offset}; }

/// The water's viscosity is explicit, and settling has its own substeps.
void check_viscosity(const Scene& scene, const Place& place) {
    double h = scene.time_step / scene.solver.substeps;
    if (scene.settling.updates > 0) h = std::max(h, scene.settling.time_step / scene.settling.substeps);
    const double most = physics::most_viscosity(scene.solver.fluidRestDistance, h);
    if (!(scene.solver.kinematicViscosity > most)) return;
    refuse(place.key("solver").key("kinematicViscosity"), scene.solver.kinematicViscosity,
           "at most " + computed_text(most) + " (0.1 fluidRestDistance^2 / longest substep, settling included)");
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
    if (!scene.solver.modifiedPressure || weight.isZero(0)) return;
    if (const auto reason = no_tank(weight, scene.planes, scene.periodic))
        refuse(place.key("solver").key("modifiedPressure"), true, "false here: it " + *reason);
}

}  // namespace

void check_water(const Scene& scene, const Place& place) {
    if (scene.scheme != Scheme::conserving) return;
    check_viscosity(scene, place);
    check_mirrors(scene, place);
    check_modified_pressure(scene, place);
}

void check_plane(const Plane& plane, const Place& place) {
    constexpr double tolerance = 1e-4;
    if (!(std::abs(plane.normal.norm() - 1) <= tolerance)) refuse(place, as_json(plane), "[a, b, c, d] with (a, b, c) of length 1");
    if (!std::isfinite(plane.offset)) refuse(place.item(3), plane.offset, "a finite number (length)");
}

}  // namespace natator::fields
