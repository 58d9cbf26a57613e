#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "natator/scene.h"

namespace natator {

/// How much finer than asked for a scene is computed.
struct Level {
    std::string name;
    int time = 1;   ///< time steps are divided by it
    int space = 1;  ///< distances of particles are divided by it

    /// "base", "time/2", "time/4", "spacing/2" or "both/2". Throws InputError.
    static Level named(const std::string& name);
};

/// Overrides, to be merged behind a scene's own, that make it as fine as `level` says. `scene` is the one they are for,
/// `substeps` those of its frames once the model is built, which can be more than it asks for.
///
/// - Time: substeps of frames and of the settling, times `level.time`.
/// - Spacing, all divided by `level.space`, here n: the lattice of the fluid, which fills the same cells; radius,
///   solid_rest_distance, fluid_rest_distance, collision_distance and both margins; fluid.clearance. A particle of the
///   fluid has 1/n^3 of the mass. The body's particles are divided by creature.refinement (model/refine_body.h).
/// Duration, gait, tank, gravity, kinematic_viscosity and all that has no length stay as they are.
/// Throws InputError for half the spacing of a scene with companions or obstacles, whose particles nothing makes finer.
nlohmann::json refined(const Scene& scene, const Level& level, int substeps);

}  // namespace natator
