#pragma once

#include <functional>
#include <string>
#include <vector>

#include "path_run.h"
#include "result_table.h"

namespace natator::bench {

/// Work against precision: each scene with each setting, compared with a fine reference of the same scheme.
struct PrecisionStudy {
    std::vector<std::string> scenes;  ///< subject_names()
    std::vector<Scheme> schemes;
    std::vector<Precision> precisions;
    std::vector<int> substeps;
    std::vector<int> iterations;
    int repeats = 3;  ///< of the time measurement
};

/// Setting of the reference: 1024 substeps x 4 iterations in double. Scheme `conserving` converges to the same path
/// with any number of iterations; `flex` has no limit, since its stiffness grows with substeps and iterations.
Setting reference_setting(Scheme scheme);

/// Columns scene, scheme, precision, substeps, iterations (these are the key); status (ok, unstable); repeats;
/// run_time (s, median); path_error_0.1, path_error_0.25 (length, see path_error); density_error_mean,
/// density_error_max; linear_momentum_error, angular_momentum_error (only of isolated bodies); energy_change,
/// spring_residual, cluster_residual; hash. See PathRun.
Row precision_columns();
inline constexpr std::size_t precision_key_columns = 5;

/// Runs what `table` does not hold yet. The repeats of one scene, scheme and precision take turns, so that a slow spell
/// of the machine hits all settings alike; their rows are written together. `report` gets a line per row.
void run_precision_study(const PrecisionStudy& study, ResultTable& table,
                         const std::function<void(const std::string&)>& report);

/// Observed order of convergence in the number of substeps, from the rows in double with at least 4 of them. Columns
/// scene, scheme, iterations, points, order_0.1, order_0.25.
ResultTable convergence_orders(const std::vector<Row>& rows);

/// The settings that no other one beats in run time and path error at 0.25 s, as text, one line each, by scene and
/// scheme.
std::string pareto_text(const std::vector<Row>& rows);

}  // namespace natator::bench
