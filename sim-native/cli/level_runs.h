#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "job.h"
#include "options.h"
#include "run/converge/estimate.h"
#include "run/converge/level.h"
#include "run_record.h"

namespace natator::cli {

/// A level of `natator-sim converge`: its scene, and what its runs gave.
struct LevelRuns {
    Level level;
    nlohmann::json request;  ///< without a start
    Job job;
    int substeps = 0, particles = 0;
    double body_length = 0;
    std::vector<nlohmann::json> results;

    Sample distance() const;  ///< of the runs that were stable
    Sample speed() const;     ///< likewise
    int unstable_runs() const;
};

/// The base and the finer levels of a request, refused where they would cost too much.
/// \param document what messages call the request
/// \throws InputError in one line
std::vector<LevelRuns> read_levels(nlohmann::json request, const std::string& document,
                                   const std::vector<std::string>& names, const BackendChoice& backend);

/// Does the runs of a level that are not recorded, from starts 1 to `starts`, and records them.
void run_level(LevelRuns& runs, int starts, const Execution& execution, RunRecord& record);

/// What the speed goes to; none if no run as asked for was stable.
std::optional<Estimate> estimate_speed(const std::vector<LevelRuns>& levels);

}  // namespace natator::cli
