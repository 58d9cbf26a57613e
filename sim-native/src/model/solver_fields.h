#pragma once

#include <vector>

#include "base/field.h"
#include "natator/scene.h"

/// What parameters of the solver may be, of a file or of a program.
namespace natator::fields {

/// Their keys and ranges: of those that the schemes share, and of those of one. A document has them all in one object.
const std::vector<Field<SolverParameters>>& solver_fields();
const std::vector<Field<FlexParameters>>& flex_fields();
const std::vector<Field<ConservingParameters>>& conserving_fields();

/// A limit that is beyond all numbers is none.
void limit_to_float(SolverParameters& solver);

/// Throws InputError unless the radius can see the rest distances.
void check_rest_distances(const SolverParameters& solver, const Place& place);

/// Throws InputError unless parameters that a program has made are some that read_solver could give; a limit on speed
/// or acceleration may be infinite.
void check_solver(SolverParameters solver, const Place& place);

}  // namespace natator::fields
