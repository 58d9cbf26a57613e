#include "level.h"

#include "base/text.h"
#include "model/water_box.h"
#include "natator/error.h"

namespace natator {
namespace {

using nlohmann::json;

/// The first cell's share of the block stays where it was: a lattice point is in the middle of its cell.
/// Water that is one cell deep remains so, with the mass that it had.
json refined_fluid(const FluidBlock& fluid, bool plane, int n) {
    const Eigen::Vector3i by(n, plane ? 1 : n, n);
    Eigen::Vector3d origin = fluid.origin - Eigen::Vector3d::Constant(fluid.spacing / 2 * (1 - 1.0 / n));
    if (plane) origin.y() = fluid.origin.y();
    const double parts = by.prod();
    return {{"count", {by.x() * fluid.count.x(), by.y() * fluid.count.y(), by.z() * fluid.count.z()}},
            {"spacing", fluid.spacing / n},
            {"origin", {origin.x(), origin.y(), origin.z()}},
            {"clearance", fluid.clearance / n},
            {"mass", {{"bottom", fluid.bottom_mass / parts}, {"top", fluid.top_mass / parts}}}};
}

json refined_distances(const SolverParameters& p, int n) {
    return {{"radius", p.radius / n},
            {"solidRestDistance", p.solid_rest_distance / n},
            {"fluidRestDistance", p.fluid_rest_distance / n},
            {"collisionDistance", p.collision_distance / n},
            {"particleCollisionMargin", p.particle_collision_margin / n},
            {"shapeCollisionMargin", p.shape_collision_margin / n}};
}

}  // namespace

Level Level::named(const std::string& name) {
    for (const Level& level : {Level{"base", 1, 1}, Level{"time/2", 2, 1}, Level{"time/4", 4, 1},
                               Level{"spacing/2", 1, 2}, Level{"both/2", 2, 2}})
        if (level.name == name) return level;
    throw InputError("level " + quoted(name) + ": must be time/2, time/4, spacing/2 or both/2");
}

json refined(const Scene& scene, const Level& level, int substeps) {
    json overrides = {{"solver", json::object()}};
    if (level.space > 1) {
        if (!scene.companions.empty() || !scene.obstacles.empty())
            throw InputError("level " + quoted(level.name) +
                             ": half the spacing is not known of companions and obstacles; "
                             "the levels of this scene are time/2 and time/4");
        overrides["solver"] = refined_distances(scene.solver, level.space);
        if (scene.fluid) overrides["fluid"] = refined_fluid(*scene.fluid, is_plane_flow(scene), level.space);
        if (scene.creature) overrides["creature"]["refinement"] = level.space * scene.creature->refinement;
    }
    const bool waves = scene.scheme == Scheme::lattice;  // go so many cells a substep, whatever their size
    overrides["solver"]["substeps"] = level.time * substeps * (waves ? level.space : 1);
    overrides["settling"]["substeps"] = level.time * scene.settling.substeps;
    return overrides;
}

}  // namespace natator
