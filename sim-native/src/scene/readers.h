#pragma once

#include "field.h"
#include "natator/scene.h"

/// One reader per part of a scene. Each throws InputError and leaves what is absent at its default.
namespace natator::fields {

SolverParameters read_solver(const json& value, const Place& place);
FluidBlock read_fluid(const json& value, const Place& place);
Creature read_creature(const json& value, const Place& place);
MovingTank read_moving_tank(const json& value, const Place& place);
std::vector<Goal> read_goals(const json& value, const Place& place);

/// Gives a creature whose spacing is known the slices and joints of a profile.
void read_profile(const json& value, const Place& place, Creature& creature);

}  // namespace natator::fields
