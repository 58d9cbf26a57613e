#pragma once

#include <string>

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// What a Model takes, an estimate that is rather too high: neighbours are counted at the start, in the cells that the
/// solver sorts particles into, and in fluid at rest, whichever is more.
struct Cost {
    double candidates = 0;  ///< pairs that the search for neighbours looks at in a substep
    double neighbours = 0;  ///< entries of the neighbour lists, fluid and contacts
    double per_substep = 0;  ///< pair visits in a substep, with all its iterations; other work is counted as if it were
    double bytes = 0;
};

Cost cost_of(const Model& model);

/// What may be spent on one evaluation: those of limits.h, or what the environment says instead.
struct Budget {
    double work = 0;   ///< pair visits
    double bytes = 0;  ///< of memory

    /// Throws InputError when $NATATOR_MOST_WORK or $NATATOR_MOST_MEMORY is no decimal number above 0.
    static Budget of_user();
};

/// Throws InputError, one line that begins with `where`, if so many substeps of the model, or its memory and
/// `more_bytes`, are beyond the user's budget.
void check_cost(const Model& model, double substeps, double more_bytes, const std::string& where);

/// The same for an evaluation of a scene, from settling to its duration.
void check_evaluation_cost(const Scene& scene, const Model& model);

/// The same for a stream, which has no duration: settling and some frames.
void check_live_cost(const Scene& scene, const Model& model);

}  // namespace natator
