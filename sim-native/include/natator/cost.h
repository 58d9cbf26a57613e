#pragma once

#include <optional>
#include <string>

#include "natator/model.h"
#include "natator/scene.h"

namespace natator {

/// What a Model takes, an estimate that is rather too high: neighbours are counted at the start and in fluid at rest,
/// whichever is more. Those of the work are counted in the cells that the solver sorts particles into.
struct Cost {
    double candidates = 0;   ///< pairs that the search for neighbours looks at in a substep
    double neighbours = 0;   ///< entries of the neighbour lists, fluid and contacts
    double cells = 0;        ///< of water on a lattice
    double per_substep = 0;  ///< pair visits in a substep, with all its iterations; other work is counted as if it were
    double bytes = 0;        ///< memory on the CPU at most; most runs were measured to take four fifths of it or more
};

/// What memory depends on beside the Model; as it is the most that it may take.
struct Computing {
    bool doubles = true;          ///< Precision::double_precision
    bool several_threads = true;  ///< which put together lists of their own
};

/// Estimates what a run of the model takes on the CPU.
Cost cost_of(const Model& model, const Computing& computing = {});

/// What may be spent on one evaluation: those of limits.h, or what the environment says instead.
struct Budget {
    double work = 0;   ///< pair visits
    double bytes = 0;  ///< bytes of memory

    /// Throws InputError when $NATATOR_MOST_WORK or $NATATOR_MOST_MEMORY is no decimal number above 0.
    static Budget of_user();
};

/// Throws InputError, one line that begins with `where`, if so many substeps of the model, or its memory and
/// `more_bytes`, are beyond the user's budget.
void check_cost(const Model& model, double substeps, double more_bytes, const std::string& where,
                const Computing& computing = {});

/// Throws InputError, one line that names the scene, if an evaluation of it, from settling to its duration, is beyond
/// the user's budget, or has too many time steps (limits.h).
void check_evaluation_cost(const Scene& scene, const Model& model, const Computing& computing = {});

/// Throws InputError, one line that names the scene, if settling and the time steps until `until` (s) are beyond the
/// user's budget, or are too many (limits.h). Without `until`, limits::live_frames time steps count.
void check_live_cost(const Scene& scene, const Model& model, std::optional<double> until = {},
                     const Computing& computing = {});

}  // namespace natator
