#pragma once

#include <optional>
#include <string>

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// What a Model takes, an estimate that is rather too high: neighbours are counted at the start and in fluid at rest, whichever is
/// more. Those of the work are counted in the cells that the solver sorts particles into.
struct Cost {
    double candidates = 0;  ///< pairs that the search for neighbours looks at in a substep
    double neighbours = 0;  ///< entries of the neighbour lists, fluid and contacts
    double per_substep = 0;  ///< pair visits in a substep, with all its iterations; other work is counted as if it were
    double bytes = 0;  ///< of memory on the CPU: what such runs were measured to take at most is not less, and mostly no fifth less
};

/// What memory depends on beside the Model; as it is the most that it may take.
struct Computing {
    bool doubles = true;          ///< Precision::double_precision
    bool several_threads = true;  ///< which put together lists of their own
};

Cost cost_of(const Model& model, const Computing& computing = {});

/// What may be spent on one evaluation: those of limits.h, or what the environment says instead.
struct Budget {
    double work = 0;   ///< pair visits
    double bytes = 0;  ///< of memory

    /// Throws InputError when $NATATOR_MOST_WORK or $NATATOR_MOST_MEMORY is no decimal number above 0.
    static Budget of_user();
};

/// Throws InputError, one line that begins with `where`, if so many substeps of the model, or its memory and
/// `more_bytes`, are beyond the user's budget.
void check_cost(const Model& model, double substeps, double more_bytes, const std::string& where, const Computing& computing = {});

/// The same for an evaluation of a scene, from settling to its duration, and if that is too many time steps.
void check_evaluation_cost(const Scene& scene, const Model& model, const Computing& computing = {});

/// The same for a stream: settling and the time steps until then, s, of one without an end some.
void check_live_cost(const Scene& scene, const Model& model, std::optional<double> until = {}, const Computing& computing = {});

}  // namespace natator
