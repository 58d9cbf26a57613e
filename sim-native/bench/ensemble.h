#pragma once

#include <functional>
#include <string>
#include <vector>

#include "path_run.h"
#include "result_table.h"

namespace natator::bench {

/// Distances over the thesis' 4 s. Single paths are chaotic, so each is an ensemble of starts that differ a little.
struct EnsembleStudy {
    std::vector<int> creatures{1, 2};  ///< with the thesis' gaits
    std::vector<Setting> settings;
    int runs = 5;                ///< per setting, with the seeds 1, 2, ...
    double perturbation = 1e-6;  ///< of all starting positions, length
    double duration = 4;         ///< s; early stops are switched off
};

/// Columns creature, scheme, precision, substeps, iterations, seed (these are the key), status, distance (length),
/// hash.
Row ensemble_columns();
inline constexpr std::size_t ensemble_key_columns = 6;

/// Runs what `table` does not hold yet. `report` gets a line per run.
void run_ensemble_study(const EnsembleStudy& study, ResultTable& table,
                        const std::function<void(const std::string&)>& report);

/// Columns creature, scheme, precision, substeps, iterations, runs, mean, deviation (of the sample) of the runs that
/// are ok.
ResultTable ensemble_summary(const std::vector<Row>& rows);

}  // namespace natator::bench
