#pragma once

#include <string>
#include <vector>

#include "natator/model.h"

namespace natator {

/// What a Model needs, decided once: a stage that is false here does not run and owns no memory.
struct Plan {
    bool fluid = false;           ///< density constraint of scheme `flex`, fluid neighbour lists
    bool water = false;           ///< pressure solves of scheme `conserving`
    bool contacts = false;        ///< pairs that are not both fluid; in scheme `conserving` of solids alone
    bool mutual_contacts = false; ///< a pair that one side feels is felt by both, so that momentum is kept
    bool solid_pressure = false;  ///< solids add to the fluid's density
    bool uniform_fluid = false;   ///< every fluid particle collides with every other: no test per pair
    bool springs = false;
    bool clusters = false;
    bool planes = false;
    bool particle_friction = false;
    bool plane_friction = false;
    bool viscosity = false;
    bool damping = false;
    bool clamp_acceleration = false;
    bool clamp_speed = false;

    // Off in the thesis.
    bool restitution = false;
    bool adhesion = false;
    bool sleep = false;
    bool shock_propagation = false;
    bool dissipation = false;
    bool cohesion = false;
    bool surface_tension = false;
    bool vorticity = false;
    bool free_surface_drag = false;
    bool fluid_forces = false;  ///< any of these that acts on velocities beside the others: all four in scheme `conserving`, tension and vorticity in `flex`

    /// Does anything act behind the velocities?
    constexpr bool effects() const {
        return dissipation || (fluid && (free_surface_drag || fluid_forces)) || adhesion || restitution || sleep;
    }
};

/// The plan for a model: the stages that it needs.
Plan make_plan(const Model& model);

/// The plan with, on top of what the model needs, all stages that change no bit where there is nothing for them to do,
/// such as forces of strength 0: for measuring what skipping them saves. Fluid stays out where there is none, and so do
/// restitution and the acceleration clamp, which act at any coefficient.
Plan make_unskipped_plan(const Model& model);

/// One line per stage in the order of a substep, as `natator-sim info` prints it.
std::vector<std::string> describe_plan(const Model& model);

}  // namespace natator
